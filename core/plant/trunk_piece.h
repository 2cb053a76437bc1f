// A dead trunk, lying or standing: a tapered surface along a path, with the images of wood.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>

#include "core/mesh/mesh.h"

namespace sporeprint {

/// A cross-section of a trunk.
struct TrunkSection {
    glm::dvec3 middle{0.0};  ///< metres
    double radius = 0.1;     ///< metres
};

/// How an end of a trunk looks.
enum class TrunkEnd { cut, broken };

struct TrunkPieceParams {
    double length = 1.0;     ///< metres
    double start = 0.0;      ///< of the images of its bark, metres from its foot
    std::uint32_t seed = 1;  ///< of its broken ends
    TrunkEnd foot = TrunkEnd::broken, top = TrunkEnd::broken;
    int sides = 12;     ///< even, at least 6
    int rings = 160;    ///< at most, at least 4: fewer ones stretch the images along the trunk
    double lost = 0.0;  ///< share of its mass that is lost, 0..1: rotten wood is darker
    double moss = 0.0;  ///< share of its upper side that is green, 0..1
};

/// Returns the closed surface of a trunk.
///
/// section  of the trunk at a distance from its foot, 0..length, along a path without sharp bends
/// returns  a mesh with tangents, texture coordinates for wood_images() and tints
/// throws   InvalidInput for a length that is not positive (path "/length"), or for a number of sides that
///          is odd or less than 6 (path "/sides"), or fewer than 4 rings (path "/rings")
[[nodiscard]] Mesh trunk_piece(const TrunkPieceParams& params,
                               const std::function<TrunkSection(double)>& section);

}  // namespace sporeprint
