// Geometry, morph targets and attributes of primitives.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/gltf/glb.h"
#include "core/gltf/tables.h"
#include "core/images.h"

namespace sporeprint::gltf {

/// What a primitive has of each vertex for its images: nothing, texture coordinates, or also
/// tangents, which a normal map in the same file needs.
enum class TextureData { none, coordinates, all };

/// A primitive and what is written of it.
struct PrimitivePart {
    const GlbPrimitive* primitive = nullptr;
    TextureData data = TextureData::none;
    float step = 1.0F;  ///< of the positions; 1 for floats
};

/// JSON members of a primitive.
struct PrimitiveJson {
    std::string geometry;  ///< attributes and indices
    std::string targets;   ///< with a leading comma; empty for none
};

/// Writes the geometry and the targets of primitives: appends their bytes to the body and their
/// accessors to the tables, in the order of the parts. Triangles and vertices of compressed
/// primitives without targets have another order than those of their meshes.
///
/// sway    where that of a mesh is written, if it has one
/// body    null for floats whose bytes are elsewhere: only the tables are filled
/// throws  GenerationError for a mesh that is empty or lacks what its material needs, and for a
///         target with another number of vertices
[[nodiscard]] std::vector<PrimitiveJson> write_primitives(std::span<const PrimitivePart> parts,
                                                          GlbSway sway, GlbGeometry storage,
                                                          const Parallel& parallel, Tables& tables,
                                                          Body* body);

/// Returns the weights and names of the targets of a mesh as JSON members, with a leading comma.
///
/// throws  GenerationError if its primitives have different numbers of targets
[[nodiscard]] std::string target_weights_json(const GlbMesh& mesh);

/// Returns the step of the positions of a mesh and its targets, by which its nodes are scaled: 1 for
/// floats, and its own if it has one.
///
/// throws  GenerationError for one that is too fine
[[nodiscard]] float step_of(const GlbMesh& mesh, GlbGeometry storage);

}  // namespace sporeprint::gltf
