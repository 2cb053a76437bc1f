// Counts of the meshes of a glTF document, by tinygltf: the only place in core that calls it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/params/value.h"

namespace sporeprint {

struct MeshCounts {
    std::uint64_t meshes = 0, vertices = 0, triangles = 0, morph_targets = 0;
};

/// The largest number of JSON values in the accessors and meshes of a document that are passed to
/// tinygltf. It takes up to 600 bytes for each, so 24 MB for all; a colony of ours has a few
/// thousand.
inline constexpr std::size_t most_counted_values = 40'000;

/// Returns the counts of the meshes of a glTF document. tinygltf reads the members `accessors` and
/// `meshes` alone, so it opens no file, decodes no image and follows no offset. It requires a
/// buffer view behind every accessor; compressed files have accessors without one, and our caller
/// has no buffers, so each accessor is given the same empty view.
///
/// throws  InvalidInput (path "") if tinygltf refuses the document, or it has more than
///         most_counted_values
/// cost    O(size of the document)
[[nodiscard]] MeshCounts mesh_counts(const Value& document);

}  // namespace sporeprint
