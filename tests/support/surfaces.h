// Distances between surfaces, for tests of continuity and convergence.
#pragma once

#include "core/mesh/mesh.h"

namespace sporeprint {

/// Returns the Hausdorff distance of two surfaces, metres: the greatest distance of the vertices,
/// edge midpoints and triangle centres of either from the triangles of the other; exact for these
/// samples.
///
/// cost  O(n) for meshes of similar resolution, by a grid of triangles
[[nodiscard]] double hausdorff(const Mesh& a, const Mesh& b);

/// Returns the visible jump between two frames of an animation, metres: the largest move of a
/// vertex shown in both, or the mean width (area over length) of a part shown in one only, as a
/// ring appears thin, not short. For frames with different numbers of vertices it is hausdorff().
[[nodiscard]] double jump(const Mesh& a, const Mesh& b);

/// Returns the triangles of `mesh` that `other` lacks (by their three indices), as a mesh with all
/// vertices.
///
/// pre  both have the same number of vertices
[[nodiscard]] Mesh only_in(const Mesh& mesh, const Mesh& other);

}  // namespace sporeprint
