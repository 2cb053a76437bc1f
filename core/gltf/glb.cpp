#include "core/gltf/glb.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>

#include "core/grow/mushroom.h"
#include "core/params/problems.h"

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

/// A triple in JSON; of any type with x, y and z.
void append_corner(std::string& out, const glm::vec3& corner) {
    append(out += '[', corner.x);
    append(out += ',', corner.y);
    append(out += ',', corner.z);
    out += ']';
}

/// The tables of buffer views and accessors, as JSON. Every accessor has a view of its own, and the views of accessors
/// come before all others, so that both have one number.
struct Tables {
    std::string views, accessors;
    std::size_t count = 0, binary = 0;  ///< of views; bytes of the BIN chunk so far, padded

    std::size_t view(std::size_t length, int target = 0) {
        views += count == 0 ? "" : ",";
        append(views += "{\"buffer\":0,\"byteOffset\":", binary);
        append(views += ",\"byteLength\":", length);
        if (target != 0) views += ",\"target\":" + std::to_string(target);
        views += '}';
        binary += padded(length);
        return count++;
    }

    /// `more` is the rest of the object, from a comma on.
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

    /// Vectors with their bounds, as the specification wants positions.
    std::size_t positions(std::span<const glm::vec3> values) {
        glm::vec3 low = values.front(), high = low;
        for (const glm::vec3& p : values) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        std::string box = ",\"min\":";
        append_corner(box, low);
        append_corner(box += ",\"max\":", high);
        return vectors(values, box);
    }
};

/// A piece of the BIN chunk.
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

/// The targets and their clip.
struct Motion {
    std::shared_ptr<const Bytes> bytes;
    std::string targets;     ///< of the primitive, from a comma on
    std::string mesh;        ///< weights and names, from a comma on
    std::string animations;  ///< from a comma on
};

Motion motion(const GlbParts& parts, std::size_t vertices, Tables& tables) {
    const auto& targets = parts.targets;
    for (const MorphTarget& target : targets)
        if (target.positions.size() != vertices || target.normals.size() != vertices)
            throw GenerationError("a morph target has another number of vertices than its mesh");
    const WeightClip* clip = parts.clip;
    if (clip && (targets.empty() || clip->times.empty() ||
                 clip->weights.size() != clip->times.size() * targets.size()))
        throw GenerationError("a clip needs targets, and a weight for each of them at each key");
    Motion out;
    if (targets.empty()) return out;
    Chunk chunk(targets.size() * vertices * 24 +
                (clip ? (clip->times.size() + clip->weights.size()) * 4 : 0));
    std::string names, zeros;
    for (const MorphTarget& target : targets) {
        chunk.append(std::span<const glm::vec3>(target.positions));
        chunk.append(std::span<const glm::vec3>(target.normals));
        out.targets += out.targets.empty() ? ",\"targets\":[" : ",";
        append(out.targets += "{\"POSITION\":", tables.positions(target.positions));
        append(out.targets += ",\"NORMAL\":", tables.vectors(target.normals));
        out.targets += '}';
        append_quoted(names += names.empty() ? "" : ",", target.name);
        zeros += zeros.empty() ? "0" : ",0";
    }
    out.targets += ']';
    out.mesh = ",\"weights\":[" + zeros + "],\"extras\":{\"targetNames\":[" + names + "]}";
    if (clip) {
        chunk.append(std::span<const float>(clip->times));
        chunk.append(std::span<const float>(clip->weights));
        std::string span = ",\"min\":[";
        append(span, clip->times.front());
        append(span += "],\"max\":[", clip->times.back());
        const std::size_t input = tables.accessor(clip->times.size(), float_component, "SCALAR",
                                                  clip->times.size() * 4, 0, span + ']');
        const std::size_t output = tables.accessor(clip->weights.size(), float_component, "SCALAR",
                                                   clip->weights.size() * 4);
        append_quoted(out.animations += ",\"animations\":[{\"name\":", clip->name);
        append(out.animations += ",\"samplers\":[{\"input\":", input);
        append(out.animations += ",\"output\":", output);
        out.animations +=
            ",\"interpolation\":\"LINEAR\"}],\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,"
            "\"path\":\"weights\"}}]}]";
    }
    out.bytes = std::move(chunk.bytes);
    return out;
}

/// The members of a material, and the list of what it uses, each from a comma on.
struct Shine {
    std::string material, used;
};

Shine shine_of(const MaterialLook& look, bool textured) {
    const auto shines = [](const glm::dvec3& light) {
        return light.x > 0.0 || light.y > 0.0 || light.z > 0.0;
    };
    std::string extensions, names, emission;
    const auto extension = [&](const std::string& name, const std::string& members) {
        extensions += (extensions.empty() ? "\"" : ",\"") + name + "\":{" + members + "}";
        names += (names.empty() ? "\"" : ",\"") + name + "\"";
    };
    if (look.coat > 0.0) {
        std::string coat = "\"clearcoatFactor\":";
        append(coat, static_cast<float>(look.coat));
        // Sharp where the skin is smooth, unseen where it is matt: so one material coats the cap alone, without an image of its own.
        coat += textured
                    ? ",\"clearcoatRoughnessFactor\":1,\"clearcoatRoughnessTexture\":{\"index\":2}"
                    : ",\"clearcoatRoughnessFactor\":0.25";
        extension("KHR_materials_clearcoat", coat);
    }
    if (shines(look.glow)) {
        append_corner(emission += ",\"emissiveFactor\":", glm::vec3(look.glow));
        if (textured) emission += ",\"emissiveTexture\":{\"index\":0}";
        extension("KHR_materials_emissive_strength", "\"emissiveStrength\":4");
    }
    if (shines(look.sheen)) {
        std::string sheen = "\"sheenColorFactor\":";
        append_corner(sheen, glm::vec3(look.sheen));
        extension("KHR_materials_sheen", sheen + ",\"sheenRoughnessFactor\":0.45");
    }
    Shine shine;
    if (extensions.empty()) return shine;
    shine.material = emission + ",\"extensions\":{" + extensions + "}";
    shine.used = ",\"extensionsUsed\":[" + names + "]";
    return shine;
}

const std::shared_ptr<const Bytes>& zeros() {
    static const auto bytes = std::make_shared<const Bytes>(4, std::uint8_t{0});
    return bytes;
}

}  // namespace

Body glb(const Mesh& mesh, const GlbParts& parts) {
    if (mesh.positions.empty() || mesh.indices.empty())
        throw GenerationError("an empty mesh cannot be written");
    const bool linked = !parts.image_addresses[0].empty();
    const bool textured = parts.images != nullptr || linked;
    Tables tables;
    Geometry shape = geometry(mesh, textured, tables);
    const Shine shine = shine_of(parts.look, textured);
    Motion moves = motion(parts, mesh.positions.size(), tables);

    std::string images;
    if (parts.images)
        for (const Slice& file : parts.images->files) {
            images += images.empty() ? "" : ",";
            append(images += "{\"mimeType\":\"image/jpeg\",\"bufferView\":",
                   tables.view(file.size));
            images += '}';
        }
    if (linked)
        for (const std::string& address : parts.image_addresses) {
            images += images.empty() ? "{\"uri\":" : ",{\"uri\":";
            append_quoted(images, address);
            images += '}';
        }

    std::string json = "{\"asset\":{\"version\":\"2.0\",\"generator\":\"Sporeprint " +
                       std::to_string(generator_version) + "\"";
    if (!parts.extras_json.empty()) (json += ",\"extras\":") += parts.extras_json;
    json += "}" + shine.used + ",\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"name\":";
    append_quoted(json, parts.name);
    json += ",\"mesh\":0}],\"meshes\":[{\"name\":";
    append_quoted(json, parts.name);
    json += ",\"primitives\":[{\"attributes\":{" + shape.attributes + "},\"indices\":";
    append(json, shape.indices_accessor);
    json += ",\"material\":0" + moves.targets + "}]" + moves.mesh + "}],\"materials\":[{\"name\":";
    append_quoted(json, parts.name);
    if (textured)
        json +=
            ",\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0},\"metallicFactor\":0,"
            "\"metallicRoughnessTexture\":{\"index\":2}},"
            "\"normalTexture\":{\"index\":1},\"occlusionTexture\":{\"index\":2}" +
            shine.material +
            "}],"
            "\"textures\":[{\"sampler\":0,\"source\":0},{\"sampler\":0,\"source\":1},{\"sampler\":"
            "0,\"source\":2}],"
            "\"samplers\":[{\"magFilter\":9729,\"minFilter\":9987,\"wrapS\":33071,\"wrapT\":33071}]"
            ",\"images\":[" +
            images + "]";
    else
        json += ",\"pbrMetallicRoughness\":{\"metallicFactor\":0}" + shine.material + "}]";
    json += ",\"buffers\":[{\"byteLength\":";
    append(json, tables.binary);
    json += "}],\"bufferViews\":[" + tables.views + "],\"accessors\":[" + tables.accessors + "]" +
            moves.animations + "}";
    json.append(padded(json.size()) - json.size(), ' ');

    const std::size_t total = 12 + 8 + json.size() + 8 + tables.binary;
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
    put(at, static_cast<std::uint32_t>(tables.binary));
    put(at, std::uint32_t{0x004E4942});  // "BIN"

    Body body{Slice(std::move(head)), Slice(std::move(shape.bytes))};
    if (moves.bytes) body.emplace_back(std::move(moves.bytes));
    if (parts.images)
        for (const Slice& file : parts.images->files) {
            body.push_back(file);
            if (const std::size_t pad = padded(file.size) - file.size)
                body.push_back(Slice(zeros(), 0, pad));
        }
    return body;
}

}  // namespace sporeprint
