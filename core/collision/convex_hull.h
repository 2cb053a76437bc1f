// The convex hull of points, by exact integer arithmetic.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"

namespace sporeprint {

/// Returns the convex hull of points as a closed mesh without texture coordinates, whose corners
/// are some of the points. Points are compared on a grid of 65,536 steps along the longest side of
/// their bounding box, so that the hull is the same on every machine; a point may therefore lie
/// outside by a step.
///
/// returns  an empty mesh for points in one plane
/// cost     O(points * triangles)
/// source   [Preparata1985] section 3.4, the beneath-beyond method
[[nodiscard]] Mesh convex_hull(std::span<const glm::vec3> points);

/// Returns evenly spread unit vectors: +y, -y, and `azimuths` of each of `latitudes` between them.
[[nodiscard]] std::vector<glm::dvec3> directions(int azimuths, int latitudes);

/// Returns those points that are farthest along one of the directions; each once.
[[nodiscard]] std::vector<glm::vec3> farthest_points(std::span<const glm::vec3> points,
                                                     std::span<const glm::dvec3> directions);

}  // namespace sporeprint
