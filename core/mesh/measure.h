// Measurement and validation of meshes.
#pragma once

#include <string>
#include <vector>

#include "core/mesh/mesh.h"

namespace sporeprint {

/// Returns the enclosed volume in cubic metres, positive when triangles face outwards. It is exact
/// for closed meshes.
[[nodiscard]] double volume(const Mesh& mesh);

/// Returns the area in square metres.
[[nodiscard]] double area(const Mesh& mesh);

/// Returns descriptions of all violations of the contract of a mesh, empty if it is valid: finite
/// numbers, indices in range, no index twice in a triangle, unit normals (1e-3), unit tangents
/// perpendicular to them, texture coordinates in 0..1, equal attribute counts, every edge closed
/// once equal positions are welded.
///
/// cost  O(n log n)
[[nodiscard]] std::vector<std::string> defects(const Mesh& mesh);

}  // namespace sporeprint
