#include "core/gltf/primitives.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <utility>
#include <vector>

#include "core/gltf/compression.h"
#include "core/gltf/json_text.h"
#include "core/mesh/index_order.h"
#include "core/problems.h"

namespace sporeprint::gltf {

namespace {

/// Throws GenerationError for a mesh that is empty or lacks what its material needs.
void check_mesh(const Mesh& mesh, TextureData data) {
    const std::size_t n = mesh.positions.size();
    if (n == 0 || mesh.indices.empty()) throw GenerationError("an empty mesh cannot be written");
    if (mesh.normals.size() != n || (data == TextureData::all && mesh.tangents.size() != n) ||
        (data != TextureData::none && mesh.texture_coordinates.size() != n) ||
        (!mesh.sway.empty() && mesh.sway.size() != n))
        throw GenerationError("a mesh lacks what its material needs of each vertex");
}

std::array<std::uint16_t, 2> normalized_coordinates(const glm::vec2& uv) {
    return {static_cast<std::uint16_t>(std::floor(uv.x * 65535.0F + 0.5F)),
            static_cast<std::uint16_t>(std::floor(uv.y * 65535.0F + 0.5F))};
}

std::uint8_t normalized_byte(float value) {
    return static_cast<std::uint8_t>(std::floor(value * 255.0F + 0.5F));
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
std::size_t add_quantized(const std::vector<Quantized16>& items, bool compressed, Tables& tables,
                          Bytes& out) {
    return tables.stream(bytes_of(items), items.size(), i16_component, "VEC3", bounds_of(items),
                         compressed, out);
}

/// Adds the sway of all vertices, if the mesh has it.
///
/// throws  GenerationError for texture coordinates of a mesh without others, which have to precede
void add_sway(const Mesh& mesh, bool textured, GlbSway format, bool compressed, VertexOrder order,
              Tables& tables, Geometry& geometry, Bytes& out) {
    const std::size_t n = mesh.sway.size();
    if (n == 0) return;
    const auto sway = [&](std::size_t i) { return mesh.sway[order.empty() ? i : order[i]]; };
    if (format != GlbSway::texture_coordinates) {
        std::vector<std::array<std::uint8_t, 4>> items;
        items.reserve(n);
        for (std::size_t i = 0; i < n; ++i) {
            const Sway of = sway(i);
            items.push_back({normalized_byte(of.bend), normalized_byte(of.flutter),
                             normalized_byte(of.phase), normalized_byte(of.branch)});
        }
        return geometry.attribute(
            format == GlbSway::color ? "COLOR_0" : "_WIND",
            tables.stream(bytes_of(items), n, u8_component, "VEC4", normalized, compressed, out));
    }
    if (!textured)
        throw GenerationError("sway as texture coordinates needs a mesh that has others");
    std::vector<std::array<std::uint16_t, 2>> first, second;
    first.reserve(n);
    second.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Sway of = sway(i);
        first.push_back(normalized_coordinates({of.bend, of.phase}));
        second.push_back(normalized_coordinates({of.flutter, of.branch}));
    }
    for (const auto& [name, items] : {std::pair("TEXCOORD_1", &first), {"TEXCOORD_2", &second}})
        geometry.attribute(name, tables.stream(bytes_of(*items), n, u16_component, "VEC2",
                                               normalized, compressed, out));
}

constexpr const char* octahedral = "OCTAHEDRAL";

/// Returns the indices of a mesh whose vertices have another order.
std::vector<std::uint32_t> renumbered(std::span<const std::uint32_t> indices, VertexOrder order) {
    std::vector<std::uint32_t> place(order.size()), out;
    for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
    out.reserve(indices.size());
    for (const std::uint32_t index : indices) out.push_back(place[index]);
    return out;
}

/// Writes quantised geometry.
///
/// step      of the positions
/// renumber  whether triangles and vertices may have another order if they are compressed
Geometry quantized_geometry(const Mesh& mesh, TextureData data, GlbSway sway, float step,
                            bool compressed, bool renumber, Tables& tables) {
    check_mesh(mesh, data);
    const std::size_t n = mesh.positions.size();
    const auto bytes = std::make_shared<Bytes>();
    // Memory for all streams as if none became smaller; pages that are never written cost nothing.
    bytes->reserve(n * 32 + mesh.indices.size() * 4 + 4096);
    Geometry out;
    std::vector<Quantized16> items = quantized(mesh.positions, step);
    std::vector<std::uint32_t> order, triangles;
    if (compressed && renumber) {
        triangles = triangles_by_last_vertex(mesh.indices, n);
        order = order_of_first_use(triangles, n);
        triangles = renumbered(triangles, order);
        std::vector<Quantized16> ordered;
        ordered.reserve(n);
        for (const std::uint32_t i : order) ordered.push_back(items[i]);
        items = std::move(ordered);
    }
    out.attribute("POSITION", add_quantized(items, compressed, tables, *bytes));
    items = compressed ? octahedral_normals(mesh.normals, order, std::move(items))
                       : quantized_normals(mesh.normals);
    out.attribute("NORMAL", tables.stream(bytes_of(items), n, i16_component, "VEC3", normalized,
                                          compressed, *bytes, octahedral));
    if (data == TextureData::all) {
        const std::vector<Quantized8> tangents = compressed
                                                     ? octahedral_tangents(mesh.tangents, order)
                                                     : quantized_tangents(mesh.tangents);
        out.attribute("TANGENT", tables.stream(bytes_of(tangents), n, i8_component, "VEC4",
                                               normalized, compressed, *bytes, octahedral));
    }
    if (data != TextureData::none) {
        std::vector<std::array<std::uint16_t, 2>> coordinates;
        coordinates.reserve(n);
        for (std::size_t i = 0; i < n; ++i)
            coordinates.push_back(
                normalized_coordinates(mesh.texture_coordinates[order.empty() ? i : order[i]]));
        out.attribute("TEXCOORD_0", tables.stream(bytes_of(coordinates), n, u16_component, "VEC2",
                                                  normalized, compressed, *bytes));
    }
    add_sway(mesh, data != TextureData::none, sway, compressed, order, tables, out, *bytes);
    const bool small = n <= 65535;
    const int component = small ? u16_component : u32_component;
    if (compressed) {
        out.indices_accessor = tables.compressed_triangles(order.empty() ? mesh.indices : triangles,
                                                           n, component, *bytes);
        bytes->shrink_to_fit();
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

Geometry float_geometry(const Mesh& mesh, TextureData data, GlbSway sway, Tables& tables) {
    check_mesh(mesh, data);
    const std::size_t n = mesh.positions.size();
    const bool small = n <= 65535;
    const std::size_t index_bytes = mesh.indices.size() * (small ? 2 : 4);
    const bool has_tangents = data == TextureData::all, has_coordinates = data != TextureData::none;
    const std::size_t sway_size = mesh.sway.empty()                      ? 0
                                  : sway == GlbSway::texture_coordinates ? 8
                                                                         : 4;
    Chunk chunk(n * (12 + 12 + (has_tangents ? 16 : 0) + (has_coordinates ? 4 : 0) + sway_size) +
                padded(index_bytes));
    Geometry out;
    chunk.append(std::span<const glm::vec3>(mesh.positions));
    out.attribute("POSITION", tables.positions(mesh.positions));
    chunk.append(std::span<const glm::vec3>(mesh.normals));
    out.attribute("NORMAL", tables.vectors(mesh.normals));
    if (has_tangents) {
        chunk.append(std::span<const glm::vec4>(mesh.tangents));
        out.attribute("TANGENT",
                      tables.accessor(n, float_component, "VEC4", n * 16, vertex_target));
    }
    if (has_coordinates) {
        for (const glm::vec2& uv : mesh.texture_coordinates) {
            put(chunk.at, normalized_coordinates(uv));
        }
        out.attribute("TEXCOORD_0",
                      tables.accessor(n, u16_component, "VEC2", n * 4, vertex_target, normalized));
    }
    Bytes weights;
    add_sway(mesh, has_coordinates, sway, false, {}, tables, out, weights);
    chunk.append(std::span<const std::uint8_t>(weights));
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

}  // namespace

Geometry geometry_of(const Mesh& mesh, TextureData data, GlbSway sway, GlbGeometry storage,
                     float step, bool renumber, Tables& tables) {
    return storage == GlbGeometry::floats
               ? float_geometry(mesh, data, sway, tables)
               : quantized_geometry(mesh, data, sway, step, storage == GlbGeometry::compressed,
                                    renumber, tables);
}

TargetData target_data(std::span<const MorphTarget> targets, std::size_t vertices,
                       GlbGeometry storage, float step, Tables& tables) {
    for (const MorphTarget& target : targets)
        if (target.positions.size() != vertices ||
            target.normals.size() != (targets.front().normals.empty() ? 0 : vertices))
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
               floats
                   ? add_floats(target.positions, true)
                   : add_quantized(quantized(target.positions, step), compressed, tables, *bytes));
        if (!target.normals.empty())
            append(out.targets += ",\"NORMAL\":", add_floats(target.normals, false));
        out.targets += '}';
    }
    out.targets += ']';
    out.bytes = bytes;
    return out;
}

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

}  // namespace sporeprint::gltf
