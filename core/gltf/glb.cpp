#include "core/gltf/glb.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "core/problems.h"
#include "core/version.h"

namespace sporeprint {

namespace {

constexpr int float_component = 5126, u16_component = 5123, u32_component = 5125;
constexpr int vertex_target = 34962, index_target = 34963;

void append(std::string& out, float value) {
    char text[32];
    out.append(text, std::to_chars(text, text + sizeof text, value + 0.0F).ptr);  // -0 + 0 is 0
}

void append(std::string& out, std::size_t value) { out += std::to_string(value); }

void append_quoted(std::string& out, const std::string& text) {
    constexpr char hex[] = "0123456789abcdef";
    out += '"';
    for (const char c : text) {
        if (c == '"' || c == '\\')
            (out += '\\') += c;
        else if (static_cast<unsigned char>(c) < 0x20)
            ((out += "\\u00") += hex[c >> 4]) += hex[c & 15];
        else
            out += c;
    }
    out += '"';
}

template <class T>
void put(std::uint8_t*& at, const T& value) {
    std::memcpy(at, &value, sizeof value);
    at += sizeof value;
}

std::size_t padded(std::size_t size) { return (size + 3) & ~std::size_t{3}; }

/// Appends a vector of three components as a JSON array.
void append_triple(std::string& out, const glm::vec3& corner) {
    append(out += '[', corner.x);
    append(out += ',', corner.y);
    append(out += ',', corner.z);
    out += ']';
}

/// The tables of buffer views and accessors, as JSON. Every accessor has a view of its own, and the
/// views of accessors precede all others, so that an accessor and its view have the same index.
struct Tables {
    std::string views, accessors;
    std::size_t count = 0, binary = 0;  ///< number of views; bytes of the BIN chunk so far, padded

    std::size_t view(std::size_t length, int target = 0) {
        views += count == 0 ? "" : ",";
        append(views += "{\"buffer\":0,\"byteOffset\":", binary);
        append(views += ",\"byteLength\":", length);
        if (target != 0) views += ",\"target\":" + std::to_string(target);
        views += '}';
        binary += padded(length);
        return count++;
    }

    /// Adds an accessor. `more` holds further members of its JSON object, with a leading comma.
    std::size_t accessor(std::size_t items, int component, const char* type, std::size_t length,
                         int target = 0, const std::string& more = {}) {
        accessors += count == 0 ? "" : ",";
        append(accessors += "{\"bufferView\":", count);
        accessors += ",\"componentType\":" + std::to_string(component) + ",\"count\":";
        append(accessors, items);
        ((((accessors += ",\"type\":\"") += type) += '"') += more) += '}';
        return view(length, target);
    }

    std::size_t vectors(std::span<const glm::vec3> values, const std::string& more = {}) {
        return accessor(values.size(), float_component, "VEC3", values.size() * 12, vertex_target,
                        more);
    }

    /// Adds vectors with their bounds, which the specification requires for positions.
    std::size_t positions(std::span<const glm::vec3> values) {
        glm::vec3 low = values.front(), high = low;
        for (const glm::vec3& p : values) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        std::string box = ",\"min\":";
        append_triple(box, low);
        append_triple(box += ",\"max\":", high);
        return vectors(values, box);
    }
};

/// A part of the BIN chunk.
struct Chunk {
    explicit Chunk(std::size_t size) : bytes(std::make_shared<Bytes>(size)), at(bytes->data()) {}

    template <class T>
    void append(std::span<const T> values) {
        if (values.empty()) return;
        std::memcpy(at, values.data(), values.size_bytes());
        at += values.size_bytes();
    }

    std::shared_ptr<Bytes> bytes;
    std::uint8_t* at;
};

struct Geometry {
    std::shared_ptr<const Bytes> bytes;
    std::string attributes;
    std::size_t indices_accessor = 0;
};

Geometry geometry(const Mesh& mesh, bool textured, Tables& tables) {
    const std::size_t n = mesh.positions.size();
    if (n == 0 || mesh.indices.empty()) throw GenerationError("an empty mesh cannot be written");
    if (mesh.normals.size() != n ||
        (textured && (mesh.tangents.size() != n || mesh.texture_coordinates.size() != n)))
        throw GenerationError("a mesh lacks what its material needs of each vertex");
    const bool small = n <= 65535;
    const std::size_t index_bytes = mesh.indices.size() * (small ? 2 : 4);
    Chunk chunk(n * (12 + 12 + (textured ? 16 + 4 : 0)) + padded(index_bytes));
    Geometry out;
    const auto attribute = [&](const char* name, std::size_t accessor) {
        out.attributes += out.attributes.empty() ? "\"" : ",\"";
        append((out.attributes += name) += "\":", accessor);
    };
    chunk.append(std::span<const glm::vec3>(mesh.positions));
    attribute("POSITION", tables.positions(mesh.positions));
    chunk.append(std::span<const glm::vec3>(mesh.normals));
    attribute("NORMAL", tables.vectors(mesh.normals));
    if (textured) {
        chunk.append(std::span<const glm::vec4>(mesh.tangents));
        attribute("TANGENT", tables.accessor(n, float_component, "VEC4", n * 16, vertex_target));
        for (const glm::vec2& uv : mesh.texture_coordinates) {
            put(chunk.at, static_cast<std::uint16_t>(std::floor(uv.x * 65535.0F + 0.5F)));
            put(chunk.at, static_cast<std::uint16_t>(std::floor(uv.y * 65535.0F + 0.5F)));
        }
        attribute("TEXCOORD_0", tables.accessor(n, u16_component, "VEC2", n * 4, vertex_target,
                                                ",\"normalized\":true"));
    }
    if (small)
        for (const std::uint32_t i : mesh.indices) put(chunk.at, static_cast<std::uint16_t>(i));
    else
        chunk.append(std::span<const std::uint32_t>(mesh.indices));
    out.indices_accessor =
        tables.accessor(mesh.indices.size(), small ? u16_component : u32_component, "SCALAR",
                        index_bytes, index_target);
    out.bytes = std::move(chunk.bytes);
    return out;
}

/// The morph targets of a primitive.
struct TargetData {
    std::shared_ptr<const Bytes> bytes;
    std::string targets;  ///< JSON member of the primitive, with a leading comma
};

TargetData target_data(std::span<const MorphTarget> targets, std::size_t vertices, Tables& tables) {
    for (const MorphTarget& target : targets)
        if (target.positions.size() != vertices || target.normals.size() != vertices)
            throw GenerationError("a morph target has another number of vertices than its mesh");
    TargetData out;
    if (targets.empty()) return out;
    Chunk chunk(targets.size() * vertices * 24);
    for (const MorphTarget& target : targets) {
        chunk.append(std::span<const glm::vec3>(target.positions));
        chunk.append(std::span<const glm::vec3>(target.normals));
        out.targets += out.targets.empty() ? ",\"targets\":[" : ",";
        append(out.targets += "{\"POSITION\":", tables.positions(target.positions));
        append(out.targets += ",\"NORMAL\":", tables.vectors(target.normals));
        out.targets += '}';
    }
    out.targets += ']';
    out.bytes = std::move(chunk.bytes);
    return out;
}

/// Returns the weights and names of the targets of a mesh as JSON members, with a leading comma.
std::string target_weights_json(const GlbMesh& mesh) {
    const auto& targets = mesh.primitives.front().targets;
    for (const GlbPrimitive& other : mesh.primitives)
        if (other.targets.size() != targets.size())
            throw GenerationError("the primitives of a mesh have as many targets each");
    if (targets.empty()) return {};
    std::string names, zeros;
    for (const MorphTarget& target : targets) {
        append_quoted(names += names.empty() ? "" : ",", target.name);
        zeros += zeros.empty() ? "0" : ",0";
    }
    return ",\"weights\":[" + zeros + "],\"extras\":{\"targetNames\":[" + names + "]}";
}

/// The animation of the first node.
struct AnimationData {
    std::shared_ptr<const Bytes> bytes;
    std::string animations;  ///< JSON member, with a leading comma
};

AnimationData animation_data(const WeightClip& clip, std::size_t targets, Tables& tables) {
    if (targets == 0 || clip.times.empty() || clip.weights.size() != clip.times.size() * targets)
        throw GenerationError("a clip needs targets, and a weight for each of them at each key");
    Chunk chunk((clip.times.size() + clip.weights.size()) * 4);
    chunk.append(std::span<const float>(clip.times));
    chunk.append(std::span<const float>(clip.weights));
    std::string span = ",\"min\":[";
    append(span, clip.times.front());
    append(span += "],\"max\":[", clip.times.back());
    const std::size_t input = tables.accessor(clip.times.size(), float_component, "SCALAR",
                                              clip.times.size() * 4, 0, span + ']');
    const std::size_t output =
        tables.accessor(clip.weights.size(), float_component, "SCALAR", clip.weights.size() * 4);
    AnimationData out;
    append_quoted(out.animations += ",\"animations\":[{\"name\":", clip.name);
    append(out.animations += ",\"samplers\":[{\"input\":", input);
    append(out.animations += ",\"output\":", output);
    out.animations +=
        ",\"interpolation\":\"LINEAR\"}],\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,"
        "\"path\":\"weights\"}}]}]";
    out.bytes = std::move(chunk.bytes);
    return out;
}

/// Returns the separator before the next item of a list of JSON objects.
const char* separator(const std::string& list) { return list.empty() ? "" : ","; }

/// The tables of textures, images and samplers.
struct TextureTables {
    std::string textures, images, samplers;
    std::vector<const GlbMaterial*> sources;  ///< materials that added images, three textures each
    std::vector<bool> sampler_repeats;        ///< by sampler

    /// Returns the index of the first texture of a material; adds its textures unless an earlier
    /// material has the same images.
    std::size_t textures_of(const GlbMaterial& material, Tables& tables) {
        for (std::size_t k = 0; k < sources.size(); ++k)
            if (sources[k]->images == material.images &&
                sources[k]->image_urls == material.image_urls &&
                sources[k]->repeats_u == material.repeats_u)
                return 3 * k;
        const std::size_t sampler = sampler_of(material.repeats_u);
        const std::size_t first = 3 * sources.size();
        sources.push_back(&material);
        for (std::size_t i = 0; i < 3; ++i) {
            append((textures += separator(textures)) += "{\"sampler\":", sampler);
            append(textures += ",\"source\":", first + i);
            textures += '}';
            if (material.images)
                append(
                    (images += separator(images)) += "{\"mimeType\":\"image/jpeg\",\"bufferView\":",
                    tables.view(material.images->files[i].size));
            else
                append_quoted((images += separator(images)) += "{\"uri\":", material.image_urls[i]);
            images += '}';
        }
        return first;
    }

  private:
    std::size_t sampler_of(bool repeats_u) {
        const auto found = std::find(sampler_repeats.begin(), sampler_repeats.end(), repeats_u);
        if (found != sampler_repeats.end())
            return static_cast<std::size_t>(found - sampler_repeats.begin());
        sampler_repeats.push_back(repeats_u);
        (samplers += separator(samplers)) += "{\"magFilter\":9729,\"minFilter\":9987,\"wrapS\":";
        (samplers += repeats_u ? "10497" : "33071") += ",\"wrapT\":33071}";
        return sampler_repeats.size() - 1;
    }
};

constexpr const char* instancing = "EXT_mesh_gpu_instancing";

/// The names of the extensions in use, each once.
struct Extensions {
    std::vector<std::string> names;

    void use(const std::string& name) {
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    /// Returns the JSON members, with a leading comma. Required extensions are in both lists.
    [[nodiscard]] std::string json() const {
        if (names.empty()) return {};
        std::string list, required;
        for (const std::string& name : names) append_quoted(list += separator(list), name);
        if (std::find(names.begin(), names.end(), instancing) != names.end())
            required = std::string(",\"extensionsRequired\":[\"") + instancing + "\"]";
        return ",\"extensionsUsed\":[" + list + "]" + required;
    }
};

/// Returns the material members of optional extensions, with a leading comma.
///
/// textures  index of the first of its own; none for a material without images
std::string material_extensions_json(const MaterialLook& look, std::optional<std::size_t> textures,
                                     Extensions& used) {
    const auto is_visible = [](const glm::dvec3& light) {
        return light.x > 0.0 || light.y > 0.0 || light.z > 0.0;
    };
    std::string extensions, emission;
    const auto extension = [&](const std::string& name, const std::string& members) {
        extensions += (extensions.empty() ? "\"" : ",\"") + name + "\":{" + members + "}";
        used.use(name);
    };
    const auto texture = [&](std::string& out, std::size_t which) {
        append(out += "{\"index\":", *textures + which);
        out += '}';
    };
    if (look.coat > 0.0) {
        std::string coat = "\"clearcoatFactor\":";
        append(coat, static_cast<float>(look.coat));
        // The coat's roughness is that of the skin, so that one material coats the cap alone:
        // smooth skin is glossy, and on matt skin the coat is invisible.
        if (textures)
            texture(coat += ",\"clearcoatRoughnessFactor\":1,\"clearcoatRoughnessTexture\":", 2);
        else
            coat += ",\"clearcoatRoughnessFactor\":0.25";
        extension("KHR_materials_clearcoat", coat);
    }
    if (is_visible(look.glow)) {
        append_triple(emission += ",\"emissiveFactor\":", glm::vec3(look.glow));
        if (textures) texture(emission += ",\"emissiveTexture\":", 0);
        extension("KHR_materials_emissive_strength", "\"emissiveStrength\":4");
    }
    if (is_visible(look.sheen)) {
        std::string sheen = "\"sheenColorFactor\":";
        append_triple(sheen, glm::vec3(look.sheen));
        extension("KHR_materials_sheen", sheen + ",\"sheenRoughnessFactor\":0.45");
    }
    if (extensions.empty()) return {};
    return emission + ",\"extensions\":{" + extensions + "}";
}

bool is_textured(const GlbMaterial& material) {
    return material.images != nullptr || !material.image_urls[0].empty();
}

std::string material_json(const GlbMaterial& material, TextureTables& texture_tables,
                          Tables& tables, Extensions& used) {
    std::string json = "{\"name\":";
    append_quoted(json, material.name);
    if (!is_textured(material))
        return json + ",\"pbrMetallicRoughness\":{\"metallicFactor\":0}" +
               material_extensions_json(material.look, std::nullopt, used) + "}";
    const std::size_t first = texture_tables.textures_of(material, tables);
    append(json += ",\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":", first);
    append(json += "},\"metallicFactor\":0,\"metallicRoughnessTexture\":{\"index\":", first + 2);
    append(json += "}},\"normalTexture\":{\"index\":", first + 1);
    append(json += "},\"occlusionTexture\":{\"index\":", first + 2);
    return json + "}" + material_extensions_json(material.look, first, used) + "}";
}

void check_transform(const glm::dvec4& rotation, const glm::vec3& scale) {
    if (!(std::abs(glm::dot(rotation, rotation) - 1.0) < 1e-6))
        throw GenerationError("the rotation of a node is no unit quaternion");
    if (!(std::abs(scale.x * scale.y * scale.z) > 0.0F))
        throw GenerationError("a node has a scale of nothing");
}

/// The transforms of a node's instances.
struct InstanceData {
    std::shared_ptr<const Bytes> bytes;
    std::string attributes;  ///< JSON members
};

InstanceData instance_data(const std::vector<GlbTransform>& places, Tables& tables) {
    const std::size_t n = places.size();
    Chunk chunk(n * (12 + 16 + 12));
    InstanceData out;
    for (const GlbTransform& place : places) {
        check_transform(place.rotation, glm::vec3(place.scale));
        put(chunk.at, glm::vec3(place.translation));
    }
    for (const GlbTransform& place : places) put(chunk.at, glm::vec4(place.rotation));
    for (const GlbTransform& place : places) put(chunk.at, glm::vec3(place.scale));
    append(out.attributes += "\"TRANSLATION\":",
           tables.accessor(n, float_component, "VEC3", n * 12));
    append(out.attributes += ",\"ROTATION\":", tables.accessor(n, float_component, "VEC4", n * 16));
    append(out.attributes += ",\"SCALE\":", tables.accessor(n, float_component, "VEC3", n * 12));
    out.bytes = std::move(chunk.bytes);
    return out;
}

/// Returns the JSON object of a node.
///
/// instances  attributes of its instances, if it has any
std::string node_json(const GlbNode& node, std::size_t meshes, const std::string& instances) {
    const glm::vec3 translation(node.translation), scale(node.scale);
    const glm::vec4 rotation(node.rotation);
    if (node.mesh >= meshes) throw GenerationError("a node shows a mesh that there is not");
    check_transform(node.rotation, scale);
    std::string json = "{\"name\":";
    append_quoted(json, node.name);
    append(json += ",\"mesh\":", node.mesh);
    if (translation != glm::vec3(0.0F)) append_triple(json += ",\"translation\":", translation);
    if (rotation != glm::vec4(0.0F, 0.0F, 0.0F, 1.0F)) {
        append_triple(json += ",\"rotation\":", glm::vec3(rotation));
        json.back() = ',';
        append(json, rotation.w);
        json += ']';
    }
    if (scale != glm::vec3(1.0F)) append_triple(json += ",\"scale\":", scale);
    if (!instances.empty())
        json += std::string(",\"extensions\":{\"") + instancing + "\":{\"attributes\":{" +
                instances + "}}}";
    return json + "}";
}

const std::shared_ptr<const Bytes>& zeros() {
    static const auto bytes = std::make_shared<const Bytes>(4, std::uint8_t{0});
    return bytes;
}

/// Returns the header, the JSON chunk and the start of the BIN chunk.
Slice head_of(std::string json, std::size_t binary) {
    json.append(padded(json.size()) - json.size(), ' ');
    const std::size_t total = 12 + 8 + json.size() + 8 + binary;
    if (total > 0xFFFFFFFFULL) throw GenerationError("the file would exceed 4 GB");
    auto head = std::make_shared<Bytes>(12 + 8 + json.size() + 8);
    std::uint8_t* at = head->data();
    put(at, std::uint32_t{0x46546C67});  // "glTF"
    put(at, std::uint32_t{2});
    put(at, static_cast<std::uint32_t>(total));
    put(at, static_cast<std::uint32_t>(json.size()));
    put(at, std::uint32_t{0x4E4F534A});  // "JSON"
    std::memcpy(at, json.data(), json.size());
    at += json.size();
    put(at, static_cast<std::uint32_t>(binary));
    put(at, std::uint32_t{0x004E4942});  // "BIN"
    return Slice(std::move(head));
}

/// Returns the JSON of all meshes, and appends their buffers to `geometries`.
std::string meshes_json(const GlbScene& scene, Tables& tables, Body& geometries) {
    std::string meshes;
    for (const GlbMesh& mesh : scene.meshes) {
        std::string primitives;
        for (const GlbPrimitive& primitive : mesh.primitives) {
            if (primitive.material >= scene.materials.size())
                throw GenerationError("a primitive wears a material that there is not");
            Geometry shape =
                geometry(*primitive.mesh, is_textured(scene.materials[primitive.material]), tables);
            geometries.emplace_back(std::move(shape.bytes));
            TargetData morph =
                target_data(primitive.targets, primitive.mesh->positions.size(), tables);
            if (morph.bytes) geometries.emplace_back(std::move(morph.bytes));
            (primitives += separator(primitives)) += "{\"attributes\":{" + shape.attributes + "},";
            append(primitives += "\"indices\":", shape.indices_accessor);
            append(primitives += ",\"material\":", primitive.material);
            primitives += morph.targets + "}";
        }
        if (primitives.empty()) throw GenerationError("a mesh has no primitives");
        append_quoted((meshes += separator(meshes)) += "{\"name\":", mesh.name);
        meshes += ",\"primitives\":[" + primitives + "]" + target_weights_json(mesh) + "}";
    }
    return meshes;
}

/// JSON of all nodes, and their indices, all of which are roots of the scene.
struct NodeData {
    std::string nodes, roots;
};

NodeData node_data(const GlbScene& scene, Tables& tables, Extensions& used, Body& geometries) {
    NodeData data;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        InstanceData instances;
        if (!scene.nodes[i].instances.empty()) {
            instances = instance_data(scene.nodes[i].instances, tables);
            geometries.emplace_back(std::move(instances.bytes));
            used.use(instancing);
        }
        (data.nodes += separator(data.nodes)) +=
            node_json(scene.nodes[i], scene.meshes.size(), instances.attributes);
        append(data.roots += separator(data.roots), i);
    }
    return data;
}

/// Appends the image files of all textures, padded.
void append_images(const TextureTables& texture_tables, Body& body) {
    for (const GlbMaterial* material : texture_tables.sources)
        if (material->images)
            for (const Slice& file : material->images->files) {
                body.push_back(file);
                if (const std::size_t pad = padded(file.size) - file.size)
                    body.push_back(Slice(zeros(), 0, pad));
            }
}

}  // namespace

Body glb(const GlbScene& scene) {
    if (scene.nodes.empty()) throw GenerationError("a scene without nodes shows nothing");
    Tables tables;
    Body geometries;
    Extensions used;
    const std::string meshes = meshes_json(scene, tables, geometries);
    const NodeData nodes = node_data(scene, tables, used, geometries);
    AnimationData clip;
    if (scene.clip) {
        const GlbMesh& shown = scene.meshes[scene.nodes.front().mesh];
        clip = animation_data(*scene.clip, shown.primitives.front().targets.size(), tables);
        geometries.emplace_back(std::move(clip.bytes));
    }
    // The views of images come after those of all accessors.
    TextureTables texture_tables;
    std::string materials;
    for (const GlbMaterial& material : scene.materials)
        (materials += separator(materials)) +=
            material_json(material, texture_tables, tables, used);

    std::string json = "{\"asset\":{\"version\":\"2.0\",\"generator\":\"Sporeprint " +
                       std::to_string(generator_version) + "\"";
    if (!scene.extras_json.empty()) (json += ",\"extras\":") += scene.extras_json;
    json += "}" + used.json() + ",\"scene\":0,\"scenes\":[{\"nodes\":[" + nodes.roots +
            "]}],\"nodes\":[" + nodes.nodes + "],\"meshes\":[" + meshes + "],\"materials\":[" +
            materials + "]";
    if (!texture_tables.textures.empty())
        json += ",\"textures\":[" + texture_tables.textures + "],\"samplers\":[" +
                texture_tables.samplers + "],\"images\":[" + texture_tables.images + "]";
    append(json += ",\"buffers\":[{\"byteLength\":", tables.binary);
    json += "}],\"bufferViews\":[" + tables.views + "],\"accessors\":[" + tables.accessors + "]" +
            clip.animations + "}";

    Body body{head_of(std::move(json), tables.binary)};
    body.insert(body.end(), geometries.begin(), geometries.end());
    append_images(texture_tables, body);
    return body;
}

Body glb(const Mesh& mesh, const GlbParts& parts) {
    GlbScene scene;
    scene.materials.push_back({parts.name, parts.images, parts.image_urls, parts.look, false});
    scene.meshes.push_back({parts.name, {{&mesh, 0, parts.targets}}});
    scene.nodes.push_back({.name = parts.name});
    scene.extras_json = parts.extras_json;
    scene.clip = parts.clip;
    return glb(scene);
}

}  // namespace sporeprint
