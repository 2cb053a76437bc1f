// Counts the meshes of a glTF document with tinygltf: the one place in core that calls it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/params/value.h"

namespace sporeprint {

struct MeshCounts {
    std::uint64_t meshes = 0, vertices = 0, triangles = 0, morph_targets = 0;
};

/// Largest number of JSON values in the accessors and meshes of a document that are handed to
/// tinygltf. It takes up to 600 bytes for one, so 24 MB for all; a colony of ours has some thousand.
inline constexpr std::size_t most_counted_values = 40'000;

/// Returns the counts of the meshes of a glTF document. tinygltf reads the members `accessors` and
/// `meshes` alone, so it opens no file, decodes no image and follows no offset. It wants a buffer view
/// behind every accessor; compressed files have accessors without one, and our caller has no buffers,
/// so each accessor is given the same empty view.
///
/// throws  InvalidInput (path "") when tinygltf refuses the document, or it has more than
///         most_counted_values
/// cost    O(size of the document)
[[nodiscard]] MeshCounts mesh_counts(const Value& document);

}  // namespace sporeprint
