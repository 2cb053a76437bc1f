// Measurement and validation of meshes.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "core/mesh/mesh.h"

namespace sporeprint {

/// Returns the enclosed volume in cubic metres, positive when triangles face outwards. It is exact
/// for closed meshes.
[[nodiscard]] double volume(const Mesh& mesh);

/// Returns the area in square metres.
[[nodiscard]] double area(const Mesh& mesh);

/// The area of a surface, the mean of its points, and their covariance.
struct SurfaceMoments {
    double area = 0.0;
    glm::dvec3 middle{0.0};
    glm::dmat3 covariance{0.0};
};

/// Returns the moments of all triangles, in metres and square metres: zeros for no area.
[[nodiscard]] SurfaceMoments surface_moments(const Mesh& mesh);

/// Returns descriptions of the first violations (at most 20) of the contract of a mesh; empty if it
/// is valid. A valid mesh has at least one triangle, finite positions, indices in range, no index
/// twice in a triangle, unit normals (to 1e-3), unit tangents perpendicular to them, texture
/// coordinates in 0..1, attributes of equal count, and, once equal positions are welded, no open
/// edge.
///
/// cost  O(n log n)
[[nodiscard]] std::vector<std::string> defects(const Mesh& mesh);

}  // namespace sporeprint
