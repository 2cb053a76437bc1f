// Writes a mesh and its images as a GLB of shared slices: nothing is copied twice.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/bytes.h"
#include "core/mesh/mesh.h"
#include "core/surface/paint.h"

namespace sporeprint {

/// A shape that the mesh can take: what its whole weight adds to each vertex.
struct MorphTarget {
    std::string name;
    std::vector<glm::vec3> positions, normals;  ///< one per vertex; a normal here is no unit vector
};

/// How the weights of all targets change with time; linear between keys.
struct WeightClip {
    std::string name;
    std::vector<float> times;    ///< seconds, ascending
    std::vector<float> weights;  ///< [key][target]
};

/// What optional material extensions say; those of which nothing is said are left out, and loaders may ignore each.
struct MaterialLook {
    double coat = 0.0;      ///< KHR_materials_clearcoat, 0..1; as rough as the image says
    glm::dvec3 sheen{0.0};  ///< KHR_materials_sheen, linear
    glm::dvec3 glow{0.0};   ///< emission, linear, 0..1; stronger by KHR_materials_emissive_strength
};

struct GlbParts {
    std::string name;                            ///< of node, mesh and material
    const ImageSet* images = nullptr;            ///< embedded when given
    std::array<std::string, 3> image_addresses;  ///< linked when not empty
    std::string extras_json;                     ///< a JSON object for asset.extras; empty for none
    MaterialLook look = {};
    std::span<const MorphTarget> targets = {};  ///< weigh nothing until a viewer plays or sets them
    const WeightClip* clip = nullptr;           ///< of the targets
};

/// Core glTF 2.0 with optional extensions of the material, one mesh, one primitive, one material; positions and normals as floats, texture coordinates as normalised u16,
/// u16 indices while they fit. Texture coordinates and tangents are written exactly when there are images.
/// Targets are dense: positions and normals move nearly everywhere, so a sparse accessor would be the larger one.
///
/// returns  slices: head (GLB header, JSON, BIN header), geometry, targets and clip, then each image with its padding
/// throws   GenerationError if the mesh is empty, a target or the clip does not fit it, or the file would exceed 2^32 - 1 bytes
[[nodiscard]] Body glb(const Mesh& mesh, const GlbParts& parts);

}  // namespace sporeprint
