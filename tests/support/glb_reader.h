// Reads a GLB as a stranger would: with tinygltf, images decoded.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/bytes.h"
#include "core/mesh/mesh.h"
#include "core/params/value.h"

namespace sporeprint {

/// One morph target: what its whole weight adds.
struct ReadTarget {
    std::string name;
    std::vector<glm::vec3> positions, normals;
    Bounds stated;  ///< min and max of its POSITION accessor
};

/// One animation of morph weights.
struct ReadClip {
    std::string name, interpolation;
    std::vector<float> times, weights;  ///< weights by [key][target]
    float first = 0.0f, last = 0.0f;    ///< min and max of the times' accessor
};

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
    bool has_foreign_extensions = false;
    std::vector<ReadTarget> targets;
    std::vector<double> weights;  ///< of the mesh, before any clip plays
    std::vector<ReadClip> clips;
};

/// A piece of a mesh in one material.
struct ReadPrimitive {
    Mesh mesh;
    Bounds stated;                        ///< min and max of its POSITION accessor
    std::vector<std::string> attributes;  ///< sorted
    int index_component = 0;
    int material = -1;
};

struct ReadMaterial {
    std::string name;
    std::array<int, 3> images{-1, -1, -1};  ///< base colour, normal, occlusion-roughness-metalness
    int wrap_s = 0;
};

/// Where EXT_mesh_gpu_instancing stands a mesh.
struct ReadInstance {
    glm::vec3 translation{0.0f};
    glm::vec4 rotation{0.0f};
    glm::vec3 scale{0.0f};
};

struct ReadNode {
    std::string name;
    int mesh = -1;
    std::vector<double> translation, rotation, scale;  ///< empty where nothing is said
    std::vector<ReadInstance> instances;
};

/// A file of any number of meshes, as tinygltf reads it.
struct ReadScene {
    std::vector<std::vector<ReadPrimitive>> meshes;
    std::vector<ReadMaterial> materials;
    std::vector<ReadNode> nodes;             ///< those of the scene, in its order
    std::vector<std::array<int, 2>> images;  ///< width and height of each; -1 of linked ones
    std::vector<std::string> uris;
    std::vector<std::string> required;  ///< extensions that readers must know
};

/// Reads a file of many meshes and expects what expect_glb() expects of one: layout, bounds, valid closed meshes, indices of
/// materials and meshes in range, no extension but those of materials, and that of instances where nodes have some.
ReadScene expect_scene(const Bytes& file);

/// Reads `file`. What went wrong stands in `trouble`.
[[nodiscard]] ReadBack read_back(const Bytes& file);

/// Reads `file` and expects it to be a whole, valid GLB in the layout of the glTF specification: header and
/// chunk lengths, padding, aligned buffer views, bounds that are those of the vertices, indices in range, targets and
/// clips that fit the mesh.
ReadBack expect_glb(const Bytes& file);

/// The JSON of a GLB; null, and a failure, when it is none.
[[nodiscard]] Value json_chunk(const Bytes& file);

/// The mesh as a viewer shows it with these weights, one for each target; normals are made unit.
[[nodiscard]] Mesh posed(const ReadBack& file, const std::vector<float>& weights);

}  // namespace sporeprint
