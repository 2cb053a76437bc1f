#include "tests/support/glb_reader.h"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <glm/geometric.hpp>

#include "tests/support/meshes.h"

namespace sporeprint {

namespace {

std::uint32_t word(const Bytes& file, std::size_t at) {
    std::uint32_t value = 0;
    if (at + 4 <= file.size()) std::memcpy(&value, file.data() + at, 4);
    return value;
}

/// Returns the content of an accessor as T, component by component.
template <class T>
std::vector<T> values(const tinygltf::Model& model, int index) {
    const auto& accessor = model.accessors.at(static_cast<std::size_t>(index));
    const auto& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
    const auto& data = model.buffers.at(static_cast<std::size_t>(view.buffer)).data;
    const auto count = accessor.count * static_cast<std::size_t>(tinygltf::GetNumComponentsInType(
                                            static_cast<std::uint32_t>(accessor.type)));
    EXPECT_EQ(view.byteLength, count * sizeof(T));
    std::vector<T> found(count);
    if (view.byteOffset + count * sizeof(T) > data.size()) {
        ADD_FAILURE() << "accessor " << index << " runs over the end of its buffer";
        return found;
    }
    std::memcpy(found.data(), data.data() + view.byteOffset, count * sizeof(T));
    return found;
}

template <class V>
std::vector<V> vectors(const tinygltf::Model& model, int index) {
    const std::vector<float> flat = values<float>(model, index);
    std::vector<V> found(flat.size() / static_cast<std::size_t>(V::length()));
    std::memcpy(found.data(), flat.data(), flat.size() * sizeof(float));
    return found;
}

glm::vec3 corner(const std::vector<double>& numbers) {
    EXPECT_EQ(numbers.size(), 3u);
    if (numbers.size() != 3) return glm::vec3(0.0f);
    return {static_cast<float>(numbers[0]), static_cast<float>(numbers[1]),
            static_cast<float>(numbers[2])};
}

void read_targets(const tinygltf::Model& model, ReadBack& found) {
    const auto& mesh = model.meshes[0];
    const auto& targets = mesh.primitives[0].targets;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        ReadTarget target;
        EXPECT_EQ(targets[i].size(), 2u);
        const auto position = targets[i].find("POSITION"), normal = targets[i].find("NORMAL");
        if (position == targets[i].end() || normal == targets[i].end()) {
            ADD_FAILURE() << "target " << i << " moves no positions or no normals";
            continue;
        }
        target.positions = vectors<glm::vec3>(model, position->second);
        target.normals = vectors<glm::vec3>(model, normal->second);
        const auto& accessor = model.accessors[static_cast<std::size_t>(position->second)];
        target.stated = {corner(accessor.minValues), corner(accessor.maxValues)};
        if (mesh.extras.Has("targetNames"))
            target.name =
                mesh.extras.Get("targetNames").Get(static_cast<int>(i)).Get<std::string>();
        found.targets.push_back(std::move(target));
    }
    found.weights = mesh.weights;
    for (const auto& animation : model.animations) {
        ReadClip clip;
        clip.name = animation.name;
        if (animation.channels.size() != 1 || animation.samplers.size() != 1) {
            ADD_FAILURE() << animation.name << " is no clip of one channel";
            continue;
        }
        const auto& channel = animation.channels[0];
        EXPECT_EQ(channel.sampler, 0);
        EXPECT_EQ(channel.target_node, 0);
        EXPECT_EQ(channel.target_path, "weights");
        const auto& sampler = animation.samplers[0];
        clip.interpolation = sampler.interpolation;
        clip.times = values<float>(model, sampler.input);
        clip.weights = values<float>(model, sampler.output);
        const auto& input = model.accessors[static_cast<std::size_t>(sampler.input)];
        if (input.minValues.size() == 1 && input.maxValues.size() == 1) {
            clip.first = static_cast<float>(input.minValues[0]);
            clip.last = static_cast<float>(input.maxValues[0]);
        } else {
            ADD_FAILURE() << "the times of " << animation.name << " have no bounds";
        }
        found.clips.push_back(std::move(clip));
    }
}

ReadPrimitive read_primitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
    ReadPrimitive found;
    for (const auto& [name, index] : primitive.attributes) {
        found.attributes.push_back(name);
        if (name == "POSITION") {
            found.mesh.positions = vectors<glm::vec3>(model, index);
            const auto& accessor = model.accessors[static_cast<std::size_t>(index)];
            found.stated = {corner(accessor.minValues), corner(accessor.maxValues)};
        } else if (name == "NORMAL") {
            found.mesh.normals = vectors<glm::vec3>(model, index);
        } else if (name == "TANGENT") {
            found.mesh.tangents = vectors<glm::vec4>(model, index);
        } else if (name == "TEXCOORD_0") {
            EXPECT_TRUE(model.accessors[static_cast<std::size_t>(index)].normalized);
            const auto flat = values<std::uint16_t>(model, index);
            for (std::size_t i = 0; i + 1 < flat.size(); i += 2)
                found.mesh.texture_coordinates.emplace_back(flat[i] / 65535.0f,
                                                            flat[i + 1] / 65535.0f);
        }
    }
    std::sort(found.attributes.begin(), found.attributes.end());
    const auto& indices = model.accessors.at(static_cast<std::size_t>(primitive.indices));
    found.index_component = indices.componentType;
    if (indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) {
        for (const std::uint16_t i : values<std::uint16_t>(model, primitive.indices))
            found.mesh.indices.push_back(i);
    } else {
        found.mesh.indices = values<std::uint32_t>(model, primitive.indices);
    }
    found.material = primitive.material;
    return found;
}

bool has_foreign_extensions(const tinygltf::Model& model) {
    // Only extensions of the material, and none required.
    const std::vector<std::string> optional = {
        "KHR_materials_clearcoat", "KHR_materials_emissive_strength", "KHR_materials_sheen"};
    return !model.extensionsRequired.empty() ||
           std::any_of(model.extensionsUsed.begin(), model.extensionsUsed.end(),
                       [&](const std::string& name) {
                           return std::find(optional.begin(), optional.end(), name) ==
                                  optional.end();
                       });
}

constexpr const char* instancing = "EXT_mesh_gpu_instancing";

std::vector<ReadInstance> read_instances(const tinygltf::Model& model,
                                         const tinygltf::Value& extension) {
    const auto read = [&]<class V>(const char* name, const V&) {
        const tinygltf::Value& attributes = extension.Get("attributes");
        if (!attributes.Has(name)) {
            ADD_FAILURE() << "instances have no " << name;
            return std::vector<V>();
        }
        return vectors<V>(model, attributes.Get(name).GetNumberAsInt());
    };
    const auto translations = read("TRANSLATION", glm::vec3());
    const auto rotations = read("ROTATION", glm::vec4());
    const auto scales = read("SCALE", glm::vec3());
    EXPECT_EQ(translations.size(), rotations.size());
    EXPECT_EQ(translations.size(), scales.size());
    std::vector<ReadInstance> found;
    for (std::size_t i = 0; i < std::min({translations.size(), rotations.size(), scales.size()});
         ++i)
        found.push_back({translations[i], rotations[i], scales[i]});
    return found;
}

void expect_layout(const Bytes& file) {
    EXPECT_EQ(word(file, 0), 0x46546C67u) << "glTF";
    EXPECT_EQ(word(file, 4), 2u);
    EXPECT_EQ(word(file, 8), file.size());
    const std::size_t json = word(file, 12);
    EXPECT_EQ(word(file, 16), 0x4E4F534Au) << "JSON";
    EXPECT_EQ(json % 4, 0u);
    EXPECT_EQ(word(file, 24 + json), 0x004E4942u) << "BIN";
    EXPECT_EQ(word(file, 20 + json) + 28 + json, file.size());
    EXPECT_EQ(file.size() % 4, 0u);
}

}  // namespace

ReadBack read_back(const Bytes& file) {
    ReadBack found;
    tinygltf::TinyGLTF reader;
    tinygltf::Model model;
    std::string error, warning;
    found.read = reader.LoadBinaryFromMemory(&model, &error, &warning, file.data(),
                                             static_cast<unsigned>(file.size()));
    found.trouble = error + warning;
    if (!found.read || model.meshes.size() != 1 || model.meshes[0].primitives.size() != 1)
        return found;
    ReadPrimitive whole = read_primitive(model, model.meshes[0].primitives[0]);
    found.mesh = std::move(whole.mesh);
    found.stated = whole.stated;
    found.attributes = std::move(whole.attributes);
    found.index_component = whole.index_component;
    for (const auto& image : model.images) {
        if (image.uri.empty())
            found.images.push_back({image.width, image.height});
        else
            found.uris.push_back(image.uri);
    }
    found.textures = model.textures.size();
    if (!model.nodes.empty()) found.node = model.nodes[0].name;
    found.generator = model.asset.generator;
    if (model.asset.extras.Has("canonical"))
        found.canonical = model.asset.extras.Get("canonical").Get<std::string>();
    found.has_foreign_extensions = has_foreign_extensions(model);
    read_targets(model, found);
    for (const auto& view : model.bufferViews) EXPECT_EQ(view.byteOffset % 4, 0u);
    EXPECT_EQ(model.scenes.size(), 1u);
    EXPECT_EQ(model.materials.size(), 1u);
    return found;
}

ReadBack expect_glb(const Bytes& file) {
    expect_layout(file);
    ReadBack found = read_back(file);
    EXPECT_TRUE(found.read) << found.trouble;
    const bool linked = !found.uris.empty();  // tinygltf reports that linked images are missing
    EXPECT_TRUE(linked || found.trouble.empty()) << found.trouble;
    if (found.mesh.positions.empty()) {
        ADD_FAILURE() << "no vertices";
        return found;
    }
    expect_valid(found.mesh);
    EXPECT_EQ(found.stated.min, bounds(found.mesh).min);
    EXPECT_EQ(found.stated.max, bounds(found.mesh).max);
    EXPECT_FALSE(found.has_foreign_extensions);
    for (const ReadTarget& target : found.targets) {
        EXPECT_EQ(target.positions.size(), found.mesh.positions.size()) << target.name;
        EXPECT_EQ(target.normals.size(), found.mesh.positions.size()) << target.name;
        Mesh moves;
        moves.positions = target.positions;
        EXPECT_EQ(target.stated.min, bounds(moves).min) << target.name;
        EXPECT_EQ(target.stated.max, bounds(moves).max) << target.name;
    }
    EXPECT_EQ(found.weights, std::vector<double>(found.targets.size(), 0.0))
        << "who plays nothing sees the mesh itself";
    for (const ReadClip& clip : found.clips) {
        EXPECT_EQ(clip.interpolation, "LINEAR");
        EXPECT_EQ(clip.weights.size(), clip.times.size() * found.targets.size());
        EXPECT_TRUE(std::is_sorted(clip.times.begin(), clip.times.end(), std::less_equal<>()))
            << "times ascend strictly";
        EXPECT_EQ(clip.first, clip.times.front());
        EXPECT_EQ(clip.last, clip.times.back());
    }
    return found;
}

ReadScene expect_scene(const Bytes& file) {
    expect_layout(file);
    ReadScene found;
    tinygltf::TinyGLTF reader;
    tinygltf::Model model;
    std::string error, warning;
    EXPECT_TRUE(reader.LoadBinaryFromMemory(&model, &error, &warning, file.data(),
                                            static_cast<unsigned>(file.size())))
        << error << warning;
    found.required = model.extensionsRequired;
    if (found.required == std::vector<std::string>{instancing}) {
        model.extensionsRequired.clear();
        std::erase(model.extensionsUsed, instancing);
    }
    EXPECT_FALSE(has_foreign_extensions(model));
    for (const auto& view : model.bufferViews) EXPECT_EQ(view.byteOffset % 4, 0u);
    for (const auto& mesh : model.meshes) {
        auto& primitives = found.meshes.emplace_back();
        for (const auto& primitive : mesh.primitives) {
            primitives.push_back(read_primitive(model, primitive));
            const ReadPrimitive& one = primitives.back();
            expect_valid(one.mesh);
            EXPECT_EQ(one.stated.min, bounds(one.mesh).min);
            EXPECT_EQ(one.stated.max, bounds(one.mesh).max);
            EXPECT_GE(one.material, 0);
            EXPECT_LT(one.material, static_cast<int>(model.materials.size()));
        }
    }
    const auto image_of = [&](int texture) {
        return texture < 0 ? -1 : model.textures.at(static_cast<std::size_t>(texture)).source;
    };
    for (const auto& material : model.materials) {
        const auto& surface = material.pbrMetallicRoughness;
        EXPECT_EQ(surface.metallicRoughnessTexture.index, material.occlusionTexture.index);
        ReadMaterial one{.name = material.name};
        one.images = {image_of(surface.baseColorTexture.index),
                      image_of(material.normalTexture.index),
                      image_of(material.occlusionTexture.index)};
        if (const int texture = surface.baseColorTexture.index; texture >= 0) {
            const int sampler = model.textures.at(static_cast<std::size_t>(texture)).sampler;
            one.wrap_s = model.samplers.at(static_cast<std::size_t>(sampler)).wrapS;
        }
        found.materials.push_back(std::move(one));
    }
    EXPECT_EQ(model.scenes.size(), 1u);
    std::vector<int> nodes = model.scenes.at(0).nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto& node = model.nodes.at(static_cast<std::size_t>(nodes[i]));
        nodes.insert(nodes.end(), node.children.begin(), node.children.end());
        EXPECT_LT(node.mesh, static_cast<int>(model.meshes.size())) << node.name;
        found.nodes.push_back(
            {node.name, node.mesh, node.translation, node.rotation, node.scale, {}});
        if (const auto many = node.extensions.find(instancing); many != node.extensions.end()) {
            EXPECT_EQ(found.required.size(), 1u);
            found.nodes.back().instances = read_instances(model, many->second);
        }
    }
    EXPECT_EQ(found.nodes.size(), model.nodes.size());
    for (const auto& image : model.images) {
        found.images.push_back({image.width, image.height});
        if (!image.uri.empty()) found.uris.push_back(image.uri);
    }
    return found;
}

Value json_chunk(const Bytes& file) {
    const std::uint32_t length = word(file, 12);
    if (file.size() < 20 + std::size_t{length}) {
        ADD_FAILURE() << "too short for a GLB";
        return {};
    }
    const std::string text(file.begin() + 20, file.begin() + 20 + length);
    std::vector<Problem> problems;
    Value json = parse(text, problems);
    EXPECT_EQ(problems, std::vector<Problem>{});
    return json;
}

Mesh posed(const ReadBack& file, const std::vector<float>& weights) {
    EXPECT_EQ(weights.size(), file.targets.size());
    Mesh mesh = file.mesh;
    for (std::size_t k = 0; k < std::min(weights.size(), file.targets.size()); ++k)
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            mesh.positions[i] += weights[k] * file.targets[k].positions.at(i);
            mesh.normals[i] += weights[k] * file.targets[k].normals.at(i);
        }
    for (glm::vec3& normal : mesh.normals) normal = glm::normalize(normal);
    return mesh;
}

}  // namespace sporeprint
