#include "core/gltf/glb.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "core/gltf/compression.h"
#include "core/problems.h"
#include "core/version.h"

namespace sporeprint {

namespace {

constexpr int float_component = 5126, u16_component = 5123, u32_component = 5125,
              i16_component = 5122, i8_component = 5120;
constexpr int vertex_target = 34962, index_target = 34963;
constexpr const char* normalized = ",\"normalized\":true";
constexpr const char *quantization = "KHR_mesh_quantization",
                     *meshopt_compression = "EXT_meshopt_compression",
                     *gpu_instancing = "EXT_mesh_gpu_instancing";

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
    std::size_t decompressed = 0;       ///< bytes of all compressed views when decompressed

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
        append_accessor(items, component, type, more);
        return view(length, target);
    }

    /// Adds an accessor of vertices whose items have a stride, with a view of its own, and appends
    /// its bytes to `out`.
    ///
    /// filter  of the compressed items; null for none
    std::size_t stream(std::span<const std::uint8_t> data, std::size_t items, int component,
                       const char* type, const std::string& more, bool compressed, Bytes& out,
                       const char* filter = nullptr) {
        const std::size_t stride = data.size() / items;
        append_accessor(items, component, type, more);
        append_view(data.size(), compressed, ",\"byteStride\":" + std::to_string(stride),
                    vertex_target);
        if (!compressed) return close_view(data, out);
        const Bytes encoded = encoded_vertices(data, items, stride);
        return close_compressed_view(encoded, items, stride, "ATTRIBUTES", out, filter);
    }

    /// Adds an accessor of compressed triangles, and appends their bytes to `out`.
    std::size_t compressed_triangles(std::span<const std::uint32_t> indices, std::size_t vertices,
                                     int component, Bytes& out) {
        const std::size_t size = component == u16_component ? 2 : 4;
        append_accessor(indices.size(), component, "SCALAR", {});
        append_view(indices.size() * size, true, {}, index_target);
        return close_compressed_view(encoded_triangles(indices, vertices), indices.size(), size,
                                     "TRIANGLES", out);
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

  private:
    void append_accessor(std::size_t items, int component, const char* type,
                         const std::string& more) {
        accessors += count == 0 ? "" : ",";
        append(accessors += "{\"bufferView\":", count);
        accessors += ",\"componentType\":" + std::to_string(component) + ",\"count\":";
        append(accessors, items);
        ((((accessors += ",\"type\":\"") += type) += '"') += more) += '}';
    }

    /// Begins a view. A compressed one lies in the second buffer, which no file contains.
    void append_view(std::size_t length, bool compressed, const std::string& stride, int target) {
        views += count == 0 ? "" : ",";
        views += std::string("{\"buffer\":") + (compressed ? "1" : "0") + ",\"byteOffset\":";
        append(views, compressed ? decompressed : binary);
        append(views += ",\"byteLength\":", length);
        views += stride + ",\"target\":" + std::to_string(target);
        if (compressed) decompressed += padded(length);
    }

    std::size_t close_view(std::span<const std::uint8_t> data, Bytes& out) {
        views += '}';
        out.insert(out.end(), data.begin(), data.end());
        out.resize(padded(out.size()));
        binary += padded(data.size());
        return count++;
    }

    std::size_t close_compressed_view(const Bytes& encoded, std::size_t items, std::size_t stride,
                                      const char* mode, Bytes& out, const char* filter = nullptr) {
        ((views += ",\"extensions\":{\"") += meshopt_compression) += "\":{\"buffer\":0,";
        append(views += "\"byteOffset\":", binary);
        append(views += ",\"byteLength\":", encoded.size());
        append(views += ",\"byteStride\":", stride);
        append(views += ",\"count\":", items);
        ((views += ",\"mode\":\"") += mode) += '"';
        if (filter) ((views += ",\"filter\":\"") += filter) += '"';
        views += "}}";
        return close_view(encoded, out);
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

    void attribute(const char* name, std::size_t accessor) {
        attributes += attributes.empty() ? "\"" : ",\"";
        append((attributes += name) += "\":", accessor);
    }
};

/// Throws GenerationError for a mesh that is empty or lacks what its material needs.
void check_mesh(const Mesh& mesh, bool textured) {
    const std::size_t n = mesh.positions.size();
    if (n == 0 || mesh.indices.empty()) throw GenerationError("an empty mesh cannot be written");
    if (mesh.normals.size() != n ||
        (textured && (mesh.tangents.size() != n || mesh.texture_coordinates.size() != n)))
        throw GenerationError("a mesh lacks what its material needs of each vertex");
}

std::array<std::uint16_t, 2> normalized_coordinates(const glm::vec2& uv) {
    return {static_cast<std::uint16_t>(std::floor(uv.x * 65535.0F + 0.5F)),
            static_cast<std::uint16_t>(std::floor(uv.y * 65535.0F + 0.5F))};
}

/// Returns the bytes of a vector of items without padding between their members.
template <class T>
std::span<const std::uint8_t> bytes_of(const std::vector<T>& items) {
    return {reinterpret_cast<const std::uint8_t*>(items.data()), items.size() * sizeof(T)};
}

/// Returns the bounds of integers, which a reader compares before it scales them.
std::string bounds_of(std::span<const Quantized16> values) {
    Quantized16 low = values.front(), high = low;
    for (const Quantized16& value : values)
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], value[k]);
            high[k] = std::max(high[k], value[k]);
        }
    const auto list = [](const Quantized16& of) {
        return std::to_string(of[0]) + ',' + std::to_string(of[1]) + ',' + std::to_string(of[2]);
    };
    return ",\"min\":[" + list(low) + "],\"max\":[" + list(high) + "]";
}

/// Adds positions as integers.
std::size_t add_quantized(std::span<const glm::vec3> values, float step, bool compressed,
                          Tables& tables, Bytes& out) {
    const std::vector<Quantized16> items = quantized(values, step);
    return tables.stream(bytes_of(items), items.size(), i16_component, "VEC3", bounds_of(items),
                         compressed, out);
}

constexpr const char* octahedral = "OCTAHEDRAL";

/// Writes quantised geometry.
///
/// step  of the positions
Geometry quantized_geometry(const Mesh& mesh, bool textured, float step, bool compressed,
                            Tables& tables) {
    check_mesh(mesh, textured);
    const std::size_t n = mesh.positions.size();
    const auto bytes = std::make_shared<Bytes>();
    Geometry out;
    out.attribute("POSITION", add_quantized(mesh.positions, step, compressed, tables, *bytes));
    const std::vector<Quantized16> normals =
        compressed ? octahedral_normals(mesh.normals) : quantized_normals(mesh.normals);
    out.attribute("NORMAL", tables.stream(bytes_of(normals), n, i16_component, "VEC3", normalized,
                                          compressed, *bytes, octahedral));
    if (textured) {
        const std::vector<Quantized8> tangents =
            compressed ? octahedral_tangents(mesh.tangents) : quantized_tangents(mesh.tangents);
        out.attribute("TANGENT", tables.stream(bytes_of(tangents), n, i8_component, "VEC4",
                                               normalized, compressed, *bytes, octahedral));
        std::vector<std::array<std::uint16_t, 2>> coordinates;
        coordinates.reserve(n);
        for (const glm::vec2& uv : mesh.texture_coordinates)
            coordinates.push_back(normalized_coordinates(uv));
        out.attribute("TEXCOORD_0", tables.stream(bytes_of(coordinates), n, u16_component, "VEC2",
                                                  normalized, compressed, *bytes));
    }
    const bool small = n <= 65535;
    const int component = small ? u16_component : u32_component;
    if (compressed) {
        out.indices_accessor = tables.compressed_triangles(mesh.indices, n, component, *bytes);
    } else {
        const std::size_t length = mesh.indices.size() * (small ? 2 : 4);
        Bytes indices(padded(length));
        std::uint8_t* at = indices.data();
        for (const std::uint32_t index : mesh.indices)
            if (small)
                put(at, static_cast<std::uint16_t>(index));
            else
                put(at, index);
        bytes->insert(bytes->end(), indices.begin(), indices.end());
        out.indices_accessor =
            tables.accessor(mesh.indices.size(), component, "SCALAR", length, index_target);
    }
    out.bytes = bytes;
    return out;
}

Geometry geometry(const Mesh& mesh, bool textured, Tables& tables) {
    check_mesh(mesh, textured);
    const std::size_t n = mesh.positions.size();
    const bool small = n <= 65535;
    const std::size_t index_bytes = mesh.indices.size() * (small ? 2 : 4);
    Chunk chunk(n * (12 + 12 + (textured ? 16 + 4 : 0)) + padded(index_bytes));
    Geometry out;
    chunk.append(std::span<const glm::vec3>(mesh.positions));
    out.attribute("POSITION", tables.positions(mesh.positions));
    chunk.append(std::span<const glm::vec3>(mesh.normals));
    out.attribute("NORMAL", tables.vectors(mesh.normals));
    if (textured) {
        chunk.append(std::span<const glm::vec4>(mesh.tangents));
        out.attribute("TANGENT",
                      tables.accessor(n, float_component, "VEC4", n * 16, vertex_target));
        for (const glm::vec2& uv : mesh.texture_coordinates) {
            put(chunk.at, normalized_coordinates(uv));
        }
        out.attribute("TEXCOORD_0",
                      tables.accessor(n, u16_component, "VEC2", n * 4, vertex_target, normalized));
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

/// step  of the positions if they are quantised
TargetData target_data(std::span<const MorphTarget> targets, std::size_t vertices,
                       GlbGeometry storage, float step, Tables& tables) {
    for (const MorphTarget& target : targets)
        if (target.positions.size() != vertices || target.normals.size() != vertices)
            throw GenerationError("a morph target has another number of vertices than its mesh");
    TargetData out;
    if (targets.empty()) return out;
    const bool floats = storage == GlbGeometry::floats,
               compressed = storage == GlbGeometry::compressed;
    const auto bytes = std::make_shared<Bytes>();
    bytes->reserve(targets.size() * vertices * 24);
    const auto add_floats = [&](std::span<const glm::vec3> values, bool with_bounds) {
        const auto* const data = reinterpret_cast<const std::uint8_t*>(values.data());
        if (compressed)
            return tables.stream({data, values.size_bytes()}, vertices, float_component, "VEC3", {},
                                 true, *bytes);
        bytes->insert(bytes->end(), data, data + values.size_bytes());
        return with_bounds ? tables.positions(values) : tables.vectors(values);
    };
    for (const MorphTarget& target : targets) {
        out.targets += out.targets.empty() ? ",\"targets\":[" : ",";
        append(out.targets += "{\"POSITION\":",
               floats ? add_floats(target.positions, true)
                      : add_quantized(target.positions, step, compressed, tables, *bytes));
        append(out.targets += ",\"NORMAL\":", add_floats(target.normals, false));
        out.targets += '}';
    }
    out.targets += ']';
    out.bytes = bytes;
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

/// The names of the extensions in use, each once.
struct Extensions {
    std::vector<std::string> names, required;

    /// Adds an extension without which the file cannot be read.
    void require(const std::string& name) {
        if (std::find(required.begin(), required.end(), name) == required.end())
            required.push_back(name);
        use(name);
    }

    void use(const std::string& name) {
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    /// Returns the JSON members, with a leading comma. Required extensions are in both lists.
    [[nodiscard]] std::string json() const {
        return list_of(",\"extensionsUsed\":[", names) +
               list_of(",\"extensionsRequired\":[", required);
    }

  private:
    static std::string list_of(const char* member, const std::vector<std::string>& names) {
        if (names.empty()) return {};
        std::string list;
        for (const std::string& name : names) append_quoted(list += separator(list), name);
        return member + list + "]";
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

/// step  factor of all scales
InstanceData instance_data(const std::vector<GlbTransform>& places, double step, Tables& tables) {
    const std::size_t n = places.size();
    Chunk chunk(n * (12 + 16 + 12));
    InstanceData out;
    for (const GlbTransform& place : places) {
        check_transform(place.rotation, glm::vec3(place.scale));
        put(chunk.at, glm::vec3(place.translation));
    }
    for (const GlbTransform& place : places) put(chunk.at, glm::vec4(place.rotation));
    for (const GlbTransform& place : places) put(chunk.at, glm::vec3(step * place.scale));
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
/// step    factor of the scale, by which the positions of its mesh were divided
std::string node_json(const GlbNode& node, double step, const std::string& instances) {
    // Instances are scaled each.
    const glm::vec3 translation(node.translation),
        scale(instances.empty() ? step * node.scale : node.scale);
    const glm::vec4 rotation(node.rotation);
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
        json += std::string(",\"extensions\":{\"") + gpu_instancing + "\":{\"attributes\":{" +
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

/// Returns the step of the positions of a mesh and its targets, by which its nodes are scaled: 1 for
/// floats.
float step_of(const GlbMesh& mesh, GlbGeometry storage) {
    if (storage == GlbGeometry::floats) return 1.0F;
    float largest = 0.0F;
    for (const GlbPrimitive& primitive : mesh.primitives) {
        largest = largest_coordinate(primitive.mesh->positions, largest);
        for (const MorphTarget& target : primitive.targets)
            largest = largest_coordinate(target.positions, largest);
    }
    return largest > 0.0F ? largest / static_cast<float>(most_quantized) : 1.0F;
}

/// Returns the JSON of all meshes, and appends their buffers to `geometries`.
///
/// steps  of the positions of each mesh
std::string meshes_json(const GlbScene& scene, const std::vector<float>& steps, Tables& tables,
                        Body& geometries) {
    const GlbGeometry storage = scene.geometry;
    std::string meshes;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const GlbMesh& mesh = scene.meshes[i];
        const float step = steps[i];
        std::string primitives;
        for (const GlbPrimitive& primitive : mesh.primitives) {
            if (primitive.material >= scene.materials.size())
                throw GenerationError("a primitive wears a material that there is not");
            const bool textured = is_textured(scene.materials[primitive.material]);
            Geometry shape = storage == GlbGeometry::floats
                                 ? geometry(*primitive.mesh, textured, tables)
                                 : quantized_geometry(*primitive.mesh, textured, step,
                                                      storage == GlbGeometry::compressed, tables);
            geometries.emplace_back(std::move(shape.bytes));
            TargetData morph = target_data(primitive.targets, primitive.mesh->positions.size(),
                                           storage, step, tables);
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

/// steps  of the positions of each mesh
NodeData node_data(const GlbScene& scene, const std::vector<float>& steps, Tables& tables,
                   Extensions& used, Body& geometries) {
    NodeData data;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const GlbNode& node = scene.nodes[i];
        if (node.mesh >= scene.meshes.size())
            throw GenerationError("a node shows a mesh that there is not");
        const auto step = static_cast<double>(steps[node.mesh]);
        InstanceData instances;
        if (!node.instances.empty()) {
            instances = instance_data(node.instances, step, tables);
            geometries.emplace_back(std::move(instances.bytes));
            used.require(gpu_instancing);
        }
        (data.nodes += separator(data.nodes)) += node_json(node, step, instances.attributes);
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
    if (scene.geometry != GlbGeometry::floats) used.require(quantization);
    if (scene.geometry == GlbGeometry::compressed) used.require(meshopt_compression);
    std::vector<float> steps;
    steps.reserve(scene.meshes.size());
    for (const GlbMesh& mesh : scene.meshes) steps.push_back(step_of(mesh, scene.geometry));
    const std::string meshes = meshes_json(scene, steps, tables, geometries);
    const NodeData nodes = node_data(scene, steps, tables, used, geometries);
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
    if (tables.decompressed > 0) {
        append(json += "},{\"byteLength\":", tables.decompressed);
        ((json += ",\"extensions\":{\"") += meshopt_compression) += "\":{\"fallback\":true}}";
    }
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
    scene.geometry = parts.geometry;
    return glb(scene);
}

}  // namespace sporeprint
