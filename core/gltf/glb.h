// Writes meshes and their images as a GLB of shared slices: nothing is copied twice.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
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

/// What a surface wears.
struct GlbMaterial {
    std::string name;
    const ImageSet* images = nullptr;                 ///< embedded when given
    std::array<std::string, 3> image_addresses = {};  ///< linked when not empty
    MaterialLook look = {};
    bool goes_round = false;  ///< the left border of its images goes on at the right one
};

/// A piece of a mesh in one material: one draw call.
struct GlbPrimitive {
    const Mesh* mesh = nullptr;
    std::size_t material = 0;                   ///< of the scene's
    std::span<const MorphTarget> targets = {};  ///< weigh nothing until a viewer plays or sets them
};

struct GlbMesh {
    std::string name;
    std::vector<GlbPrimitive> primitives;  ///< with as many targets each
};

/// Where a mesh stands.
struct GlbPlace {
    glm::dvec3 translation{0.0};
    glm::dvec4 rotation{0.0, 0.0, 0.0, 1.0};  ///< unit quaternion x, y, z, w
    glm::dvec3 scale{1.0};
};

/// A mesh at a place; many nodes may show the same one.
struct GlbNode {
    std::string name;
    std::size_t mesh = 0;  ///< of the scene's
    glm::dvec3 translation{0.0};
    glm::dvec4 rotation{0.0, 0.0, 0.0, 1.0};  ///< unit quaternion x, y, z, w
    glm::dvec3 scale{1.0};
    /// EXT_mesh_gpu_instancing: the mesh stands at each of these places of the node instead, and readers must know how.
    std::vector<GlbPlace> instances = {};
};

/// What a file shows.
struct GlbScene {
    std::vector<GlbMaterial> materials;
    std::vector<GlbMesh> meshes;
    std::vector<GlbNode> nodes;
    std::string extras_json;           ///< a JSON object for asset.extras; empty for none
    const WeightClip* clip = nullptr;  ///< of the first node's targets
};

/// Core glTF 2.0 with optional extensions of the materials; positions and normals as floats, texture coordinates as normalised u16,
/// u16 indices while they fit. Texture coordinates and tangents are written exactly where the material has images; materials with
/// the same images share their textures. Of a node what is the identity is left out.
/// Targets are dense: positions and normals move nearly everywhere, so a sparse accessor would be the larger one.
///
/// returns  slices: head (GLB header, JSON, BIN header), the geometry of each primitive with its targets, the instances of each node
///          that has some, the clip, then each image with its padding
/// throws   GenerationError for a scene without nodes, an empty mesh, one that lacks what its material needs, a number that names no
///          mesh or material, a rotation that is no unit quaternion, a scale of nothing, targets or a clip that do not fit, or a file
///          of more than 2^32 - 1 bytes
[[nodiscard]] Body glb(const GlbScene& scene);

/// A file of one mesh, one primitive, one material and one node.
struct GlbParts {
    std::string name;                            ///< of node, mesh and material
    const ImageSet* images = nullptr;            ///< embedded when given
    std::array<std::string, 3> image_addresses;  ///< linked when not empty
    std::string extras_json;                     ///< a JSON object for asset.extras; empty for none
    MaterialLook look = {};
    std::span<const MorphTarget> targets = {};  ///< weigh nothing until a viewer plays or sets them
    const WeightClip* clip = nullptr;           ///< of the targets
};

/// The same for a scene that is one mesh.
[[nodiscard]] Body glb(const Mesh& mesh, const GlbParts& parts);

}  // namespace sporeprint
