// The collar of a bracket: flesh that spreads over the bark round the place where it grows out.
#pragma once

#include <vector>

#include "core/geometry/hymenium.h"
#include "core/geometry/weathering.h"
#include "core/individual/individual.h"
#include "core/mesh/detail.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// Returns how far the collar of an individual spreads over the bark below it, metres; 0 for what
/// has none.
[[nodiscard]] double collar_size(const Individual& individual);

/// Returns the exact count of add_collar(): none from half-way between LOD 2 and 3 on.
[[nodiscard]] MeshCount collar_count(const Individual& individual, DetailLevel level);

/// Appends the collar, a closed solid: thin at its uneven rim, which goes into the wood behind the
/// wall z = 0, and thickest at the bracket. A collar of size 0 lies inside the bracket.
///
/// mesh   the bracket on a flat wall
/// body   its grids; the collar follows the columns aside
/// face   what the grid of the lower face was sunk for, nullptr where it carries no solids
/// turns  positions of the columns
void add_collar(Mesh& mesh, const SweptBody& body, const LowerFace* face,
                const std::vector<double>& turns, const Individual& individual, DetailLevel level,
                bool textured);

}  // namespace sporeprint
