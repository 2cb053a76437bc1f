// How far one surface lies from another: what continuity and convergence are measured with.
#pragma once

#include "core/mesh/mesh.h"

namespace sporeprint {

/// Distance from a point to a triangle, metres; degenerate triangles are segments or points.
/// source [Ericson2005] sec. 5.1.5: the closest point by Voronoi regions
[[nodiscard]] double distance_to_triangle(const glm::dvec3& point, const glm::dvec3& a,
                                          const glm::dvec3& b, const glm::dvec3& c);

/// Hausdorff distance of two surfaces, metres: how far the vertices, edge middles and triangle centres of each lie from
/// the triangles of the other, exact for these samples, the larger of the two ways.
///
/// cost  O(n) for meshes of like resolution: triangles are found through a grid
[[nodiscard]] double hausdorff(const Mesh& a, const Mesh& b);

/// What the eye would see jump between two frames of one film, metres: the largest move of a vertex that both show, or the
/// largest extent of a piece that only one of them shows, or how far it stands out from what the other shows if that is less
/// (a ring is born all round the stem, but without width). Frames with different numbers of vertices: hausdorff().
[[nodiscard]] double jump(const Mesh& a, const Mesh& b);

/// The triangles of `mesh` that `other` lacks (by their three indices), as a mesh of their own with all vertices.
/// pre: as many vertices in both
[[nodiscard]] Mesh only_in(const Mesh& mesh, const Mesh& other);

}  // namespace sporeprint
