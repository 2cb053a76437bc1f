// Tangents of a mesh from its texture coordinates.
#pragma once

#include "core/mesh/mesh.h"

namespace sporeprint {

/// Gives every vertex the direction in which u grows, square to its normal; w tells on which side of it the image goes up (v goes
/// down, as in glTF). Where triangles about a vertex have no area on the image, any direction square to the normal.
///
/// pre   as many normals and texture coordinates as positions; vertices are split where the image is
/// cost  O(vertices + triangles)
void add_tangents(Mesh& mesh);

}  // namespace sporeprint
