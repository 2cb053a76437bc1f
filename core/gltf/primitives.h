// Geometry, morph targets and attributes of primitives.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "core/gltf/glb.h"
#include "core/gltf/json_text.h"
#include "core/gltf/tables.h"

namespace sporeprint::gltf {

/// The geometry of a primitive in a file.
struct Geometry {
    std::shared_ptr<const Bytes> bytes;  ///< its part of the BIN chunk
    std::string attributes;              ///< JSON members
    std::size_t indices_accessor = 0;

    void attribute(const char* name, std::size_t accessor) {
        attributes += attributes.empty() ? "\"" : ",\"";
        append((attributes += name) += "\":", accessor);
    }
};

/// What a primitive has of each vertex for its images: nothing, texture coordinates, or also
/// tangents, which a normal map in the same file needs.
enum class TextureData { none, coordinates, all };

/// Writes the geometry of a mesh.
///
/// data      of its images
/// sway      where that of the mesh is written, if it has one
/// step      of the positions; 1 for floats
/// renumber  whether compressed vertices may have another order, which those of targets have not
/// throws    GenerationError for a mesh that is empty or lacks what its material needs
[[nodiscard]] Geometry geometry_of(const Mesh& mesh, TextureData data, GlbSway sway,
                                   GlbGeometry storage, float step, bool renumber, Tables& tables);

/// The morph targets of a primitive.
struct TargetData {
    std::shared_ptr<const Bytes> bytes;
    std::string targets;  ///< JSON member of the primitive, with a leading comma
};

/// Writes morph targets.
///
/// step    of the positions; 1 for floats
/// throws  GenerationError for a target with another number of vertices
[[nodiscard]] TargetData target_data(std::span<const MorphTarget> targets, std::size_t vertices,
                                     GlbGeometry storage, float step, Tables& tables);

/// Returns the weights and names of the targets of a mesh as JSON members, with a leading comma.
///
/// throws  GenerationError if its primitives have different numbers of targets
[[nodiscard]] std::string target_weights_json(const GlbMesh& mesh);

/// Returns the step of the positions of a mesh and its targets, by which its nodes are scaled: 1 for
/// floats.
[[nodiscard]] float step_of(const GlbMesh& mesh, GlbGeometry storage);

}  // namespace sporeprint::gltf
