// How thick a solid is at each vertex of its surface, found by short rays.
#pragma once

#include <vector>

#include "core/images.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// Returns the thickness of a solid at each vertex, metres: the diameter of the largest ball inside
/// that touches the surface there, as rays in a cone around the inward normal find it. Between two
/// parallel faces it is their distance. Of closed meshes that overlap, what is inside of any is
/// inside.
///
/// most      larger values are cut off at it; > 0
/// parallel  casts the rays of independent vertices
/// cost      O(vertices * (1 + most / length of an edge) + triangles)
[[nodiscard]] std::vector<float> thickness(const Mesh& mesh, double most,
                                           const Parallel& parallel = in_turn);

}  // namespace sporeprint
