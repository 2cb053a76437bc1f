// Snow on a trunk that lies: a cushion along its upper side.
#pragma once

#include <cstdint>
#include <functional>

#include "core/mesh/mesh.h"
#include "core/plant/trunk_piece.h"

namespace sporeprint {

struct SnowCapParams {
    double length = 1.0;     ///< of the trunk, metres
    double depth = 0.05;     ///< of snow on level ground, metres; less lies on a thin trunk
    double cover = 1.0;      ///< share of the trunk on which some lies, 0..1
    std::uint32_t seed = 1;  ///< of its humps and gaps
    double step = 0.1;       ///< between its vertices along the trunk, about, metres
    int columns = 6;         ///< across the trunk, at least 3
};

/// Returns the snow as closed pieces, whose borders and lower sides are in the trunk, with tints. It is as deep as the depth on level ground,
/// but no deeper than most of the radius of the trunk, and lies as far down its sides as bark is not steep.
///
/// section  of the trunk at a distance from its foot, 0..length
/// returns  a mesh with normals and tints; empty if nothing lies there
/// throws   InvalidInput for a length or a step that is not positive (paths "/length", "/step"), or for fewer columns
///          (path "/columns")
[[nodiscard]] Mesh snow_cap(const SnowCapParams& params,
                            const std::function<TrunkSection(double)>& section);

}  // namespace sporeprint
