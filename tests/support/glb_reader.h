// Reads GLB files by an independent library, tinygltf, with decoded images.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/bytes.h"
#include "core/mesh/mesh.h"
#include "core/params/value.h"

namespace sporeprint {

/// One morph target: displacements at weight 1.
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

/// A GLB of one mesh as read by tinygltf.
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

/// A part of a mesh with one material.
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

/// An instance of EXT_mesh_gpu_instancing.
struct ReadInstance {
    glm::vec3 translation{0.0f};
    glm::vec4 rotation{0.0f};
    glm::vec3 scale{0.0f};
};

struct ReadNode {
    std::string name;
    int mesh = -1;
    std::vector<double> translation, rotation, scale;  ///< empty if absent
    std::vector<ReadInstance> instances;
};

/// A GLB of any number of meshes as read by tinygltf.
struct ReadScene {
    std::vector<std::vector<ReadPrimitive>> meshes;
    std::vector<ReadMaterial> materials;
    std::vector<ReadNode> nodes;             ///< roots of the scene, then children
    std::vector<std::array<int, 2>> images;  ///< width and height of each; -1 of linked ones
    std::vector<std::string> uris;
    std::vector<std::string> required;  ///< extensionsRequired
};

/// Reads a file of many meshes and expects what expect_glb() does: layout, bounds, valid closed
/// meshes, indices of materials and meshes in range, and no extensions except those of materials,
/// and that of instances if nodes have any.
ReadScene expect_scene(const Bytes& file);

/// Reads `file`; errors are in `trouble`.
[[nodiscard]] ReadBack read_back(const Bytes& file);

/// Reads `file` and expects a complete, valid GLB in the layout of the glTF specification: header
/// and chunk lengths, padding, aligned buffer views, bounds equal to those of the vertices, indices
/// in range, morph targets and animations that fit the mesh.
ReadBack expect_glb(const Bytes& file);

/// Returns the JSON of a GLB; null, and a test failure, if it is not one.
[[nodiscard]] Value json_chunk(const Bytes& file);

/// Returns the mesh with these weights, one per target, and normalised normals.
[[nodiscard]] Mesh posed(const ReadBack& file, const std::vector<float>& weights);

}  // namespace sporeprint
