#include "core/gltf/glb.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

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

/// The BIN chunk's geometry, one buffer view per attribute, and the JSON that tells of it.
struct Geometry {
    std::shared_ptr<const Bytes> bytes;
    std::string views, accessors, attributes;
    std::size_t indices_accessor = 0;
    std::size_t view_count = 0;
};

Geometry geometry(const Mesh& mesh, bool textured) {
    const std::size_t n = mesh.positions.size();
    const bool small = n <= 65535;
    const std::size_t index_bytes = padded(mesh.indices.size() * (small ? 2 : 4));
    const std::size_t size = n * (12 + 12 + (textured ? 16 + 4 : 0)) + index_bytes;
    auto bytes = std::make_shared<Bytes>(size);
    std::uint8_t* at = bytes->data();
    Geometry out;
    std::size_t offset = 0;
    const auto view = [&](std::size_t length, int target) {
        out.views += out.view_count == 0 ? "" : ",";
        out.views += "{\"buffer\":0,\"byteOffset\":";
        append(out.views, offset);
        out.views += ",\"byteLength\":";
        append(out.views, length);
        out.views += ",\"target\":" + std::to_string(target) + "}";
        offset += padded(length);
        return out.view_count++;
    };
    const auto accessor = [&](const char* attribute, std::size_t count, int component,
                              const char* type, bool normalised) {
        const std::size_t index = out.view_count - 1;
        out.accessors += index == 0 ? "" : ",";
        out.accessors += "{\"bufferView\":";
        append(out.accessors, index);
        out.accessors += ",\"componentType\":" + std::to_string(component) + ",\"count\":";
        append(out.accessors, count);
        ((out.accessors += ",\"type\":\"") += type) += '"';
        if (normalised) out.accessors += ",\"normalized\":true";
        if (*attribute) {
            out.attributes += out.attributes.empty() ? "\"" : ",\"";
            (out.attributes += attribute) += "\":";
            append(out.attributes, index);
        }
        return index;
    };
    std::memcpy(at, mesh.positions.data(), n * 12);
    at += n * 12;
    view(n * 12, vertex_target);
    accessor("POSITION", n, float_component, "VEC3", false);
    const Bounds box = bounds(mesh);
    for (const auto& [key, corner] : {std::pair{"min", box.min}, std::pair{"max", box.max}}) {
        ((out.accessors += ",\"") += key) += "\":[";
        append(out.accessors, corner.x);
        append(out.accessors += ',', corner.y);
        append(out.accessors += ',', corner.z);
        out.accessors += ']';
    }
    out.accessors += '}';
    std::memcpy(at, mesh.normals.data(), n * 12);
    at += n * 12;
    view(n * 12, vertex_target);
    accessor("NORMAL", n, float_component, "VEC3", false);
    out.accessors += '}';
    if (textured) {
        std::memcpy(at, mesh.tangents.data(), n * 16);
        at += n * 16;
        view(n * 16, vertex_target);
        accessor("TANGENT", n, float_component, "VEC4", false);
        out.accessors += '}';
        for (const glm::vec2& uv : mesh.texture_coordinates) {
            put(at, static_cast<std::uint16_t>(std::floor(uv.x * 65535.0F + 0.5F)));
            put(at, static_cast<std::uint16_t>(std::floor(uv.y * 65535.0F + 0.5F)));
        }
        view(n * 4, vertex_target);
        accessor("TEXCOORD_0", n, u16_component, "VEC2", true);
        out.accessors += '}';
    }
    if (small)
        for (const std::uint32_t i : mesh.indices) put(at, static_cast<std::uint16_t>(i));
    else
        std::memcpy(at, mesh.indices.data(), mesh.indices.size() * 4);
    view(mesh.indices.size() * (small ? 2 : 4), index_target);
    out.indices_accessor =
        accessor("", mesh.indices.size(), small ? u16_component : u32_component, "SCALAR", false);
    out.accessors += '}';
    out.bytes = std::move(bytes);
    return out;
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
    Geometry shape = geometry(mesh, textured);

    std::size_t binary = shape.bytes->size();
    std::string images;
    if (parts.images)
        for (const Slice& file : parts.images->files) {
            shape.views += ",{\"buffer\":0,\"byteOffset\":";
            append(shape.views, binary);
            shape.views += ",\"byteLength\":";
            append(shape.views, file.size);
            shape.views += '}';
            images += images.empty() ? "" : ",";
            images += "{\"mimeType\":\"image/jpeg\",\"bufferView\":";
            append(images, shape.view_count++);
            images += '}';
            binary += padded(file.size);
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
    json += "},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"name\":";
    append_quoted(json, parts.name);
    json += ",\"mesh\":0}],\"meshes\":[{\"name\":";
    append_quoted(json, parts.name);
    json += ",\"primitives\":[{\"attributes\":{" + shape.attributes + "},\"indices\":";
    append(json, shape.indices_accessor);
    json += ",\"material\":0}]}],\"materials\":[{\"name\":";
    append_quoted(json, parts.name);
    if (textured)
        json +=
            ",\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0},\"metallicFactor\":0,"
            "\"metallicRoughnessTexture\":{\"index\":2}},"
            "\"normalTexture\":{\"index\":1},\"occlusionTexture\":{\"index\":2}}],"
            "\"textures\":[{\"sampler\":0,\"source\":0},{\"sampler\":0,\"source\":1},{\"sampler\":"
            "0,\"source\":2}],"
            "\"samplers\":[{\"magFilter\":9729,\"minFilter\":9987,\"wrapS\":33071,\"wrapT\":33071}]"
            ",\"images\":[" +
            images + "]";
    else
        json += ",\"pbrMetallicRoughness\":{\"metallicFactor\":0}}]";
    json += ",\"buffers\":[{\"byteLength\":";
    append(json, binary);
    json += "}],\"bufferViews\":[" + shape.views + "],\"accessors\":[" + shape.accessors + "]}";
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

    Body body{Slice(std::move(head)), Slice(std::move(shape.bytes))};
    if (parts.images)
        for (const Slice& file : parts.images->files) {
            body.push_back(file);
            if (const std::size_t pad = padded(file.size) - file.size)
                body.push_back(Slice(zeros(), 0, pad));
        }
    return body;
}

}  // namespace sporeprint
