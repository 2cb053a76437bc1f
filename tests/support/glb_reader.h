// Reads a GLB as a stranger would: with tinygltf, images decoded.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/bytes.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// What tinygltf makes of a GLB.
struct ReadBack {
    bool read = false;
    std::string trouble;                  ///< tinygltf's errors and warnings
    Mesh mesh;                            ///< texture coordinates widened from normalised u16
    Bounds stated;                        ///< min and max of the POSITION accessor
    std::vector<std::string> attributes;  ///< sorted
    int index_component = 0;
    std::vector<std::array<int, 2>> images;  ///< width and height of each embedded image
    std::vector<std::string> uris;           ///< of each linked image
    std::size_t textures = 0;
    std::string node, generator, canonical;
    bool has_extensions = false;
};

/// Reads `file`. What went wrong stands in `trouble`.
[[nodiscard]] ReadBack read_back(const Bytes& file);

/// Reads `file` and expects it to be a whole, valid GLB in the layout of the glTF specification: header and
/// chunk lengths, padding, aligned buffer views, bounds that are those of the vertices, indices in range.
ReadBack expect_glb(const Bytes& file);

}  // namespace sporeprint
