// Writes a mesh and its images as a GLB of shared slices: nothing is copied twice.
#pragma once

#include <string>

#include "core/bytes.h"
#include "core/mesh/mesh.h"
#include "core/surface/paint.h"

namespace sporeprint {

struct GlbParts {
    std::string name;                            ///< of node, mesh and material
    const ImageSet* images = nullptr;            ///< embedded when given
    std::array<std::string, 3> image_addresses;  ///< linked when not empty
    std::string extras_json;                     ///< a JSON object for asset.extras; empty for none
};

/// Core glTF 2.0, one mesh, one primitive, one material; positions and normals as floats, texture coordinates as normalised u16,
/// u16 indices while they fit. Texture coordinates and tangents are written exactly when there are images.
///
/// returns  slices: head (GLB header, JSON, BIN header), geometry, then each image with its padding
/// throws   GenerationError if the mesh is empty or the file would exceed 2^32 - 1 bytes
[[nodiscard]] Body glb(const Mesh& mesh, const GlbParts& parts);

}  // namespace sporeprint
