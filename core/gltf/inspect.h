// Reads a GLB that somebody sends back, and gives the request that made it.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace sporeprint {

struct Inspection {
    std::string generator;
    std::string canonical;       ///< canonical address in asset.extras
    std::string effective_json;  ///< the effective parameters in asset.extras, as JSON
    std::uint64_t vertices = 0, triangles = 0, meshes = 0, materials = 0, images = 0, bytes = 0;
    std::uint64_t morph_targets = 0, animations = 0;
};

/// Reads the JSON chunk with tinygltf; buffers and images are not decoded.
///
/// throws  InvalidInput (path "") when it is no GLB, is cut short, or was not made by Sporeprint
[[nodiscard]] Inspection inspect_glb(std::span<const std::uint8_t> file);

}  // namespace sporeprint
