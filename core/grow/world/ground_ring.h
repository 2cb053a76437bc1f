// A square of ground round a smaller one: pictures have ground that is finer the nearer it is.
#pragma once

#include <optional>

#include "core/mesh/mesh.h"
#include "core/world/plot_ground.h"

namespace sporeprint {

/// A square of ground.
struct GroundRingParams {
    WorldBox box;
    std::optional<WorldBox> hole = {};  ///< within the box, whose ground is another mesh
    double finest = 0.1;  ///< distance of vertices at the hole, or at the middle of the box, metres
    double growth = 0.0;  ///< by which it grows with each metre from there
    int texture_side = 1024;  ///< of its images: the outermost texels are on the borders
    double height = 0.0;      ///< in the world of what is at y = 0
    double skirt = 0.3;       ///< depth of the walls at its borders, which hide cracks, metres
};

/// Returns the ground of a square without its hole, seen from above, and the walls round it and round the hole. The middle of the box is at
/// the origin, x to the east, z to the south.
///
/// returns  positions, normals, tangents and texture coordinates, which are those of slab_mesh()
/// throws   InvalidInput (path "/hole") for a hole that reaches beyond the box
/// cost     O(vertices)
[[nodiscard]] Mesh ground_ring(const GroundRingParams& params, const GridHeights& heights);

}  // namespace sporeprint
