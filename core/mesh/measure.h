// Measures a mesh, and says what is wrong with it.
#pragma once

#include <string>
#include <vector>

#include "core/mesh/mesh.h"

namespace sporeprint {

/// Enclosed volume in cubic metres; positive when triangles face outwards. Exact for closed meshes.
[[nodiscard]] double volume(const Mesh& mesh);

/// Area in square metres.
[[nodiscard]] double area(const Mesh& mesh);

/// Everything that breaks the contract of a mesh, in words; empty when all is well:
/// finite numbers, indices in range, no index twice in a triangle, unit normals (1e-3), unit tangents square to them,
/// texture coordinates in 0..1, attribute counts equal, every edge closed once equal positions are welded.
/// cost O(n log n)
[[nodiscard]] std::vector<std::string> defects(const Mesh& mesh);

}  // namespace sporeprint
