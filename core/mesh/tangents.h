// Tangents of a mesh from its texture coordinates.
#pragma once

#include "core/mesh/mesh.h"

namespace sporeprint {

/// Gives every vertex the direction in which u increases, perpendicular to its normal; w is the
/// handedness of the bitangent (v increases downwards, as in glTF). Where the triangles at a vertex
/// have no area in texture space, it is any direction perpendicular to the normal.
///
/// pre   as many normals and texture coordinates as positions; vertices are split at texture seams
/// cost  O(vertices + triangles)
void add_tangents(Mesh& mesh);

}  // namespace sporeprint
