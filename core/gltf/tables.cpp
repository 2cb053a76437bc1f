#include "core/gltf/tables.h"

#include <glm/common.hpp>

#include "core/gltf/compression.h"
#include "core/gltf/json_text.h"

namespace sporeprint::gltf {

std::size_t Tables::view(std::size_t length, int target) {
    views += count == 0 ? "" : ",";
    append(views += "{\"buffer\":0,\"byteOffset\":", binary);
    append(views += ",\"byteLength\":", length);
    if (target != 0) views += ",\"target\":" + std::to_string(target);
    views += '}';
    binary += padded(length);
    return count++;
}

std::size_t Tables::accessor(std::size_t items, int component, const char* type, std::size_t length,
                             int target, const std::string& more) {
    append_accessor(items, component, type, more);
    return view(length, target);
}

std::size_t Tables::stream(std::span<const std::uint8_t> data, std::size_t items, int component,
                           const char* type, const std::string& more, bool compressed, Bytes& out,
                           const char* filter) {
    const std::size_t stride = data.size() / items;
    append_accessor(items, component, type, more);
    append_view(data.size(), compressed, ",\"byteStride\":" + std::to_string(stride),
                vertex_target);
    return close_stream(data, items, compressed, out, filter);
}

std::size_t Tables::transforms(std::span<const std::uint8_t> data, std::size_t items,
                               const char* type, bool compressed, Bytes& out) {
    append_accessor(items, float_component, type, {});
    append_view(data.size(), compressed, {}, 0);
    return close_stream(data, items, compressed, out, "EXPONENTIAL");
}

std::size_t Tables::compressed_triangles(std::span<const std::uint32_t> indices,
                                         std::size_t vertices, int component, Bytes& out) {
    const std::size_t size = component == u16_component ? 2 : 4;
    append_accessor(indices.size(), component, "SCALAR", {});
    append_view(indices.size() * size, true, {}, index_target);
    return close_compressed_view(append_encoded_triangles(indices, vertices, out), indices.size(),
                                 size, "TRIANGLES", out);
}

std::size_t Tables::vectors(std::span<const glm::vec3> values, const std::string& more) {
    return accessor(values.size(), float_component, "VEC3", values.size() * 12, vertex_target,
                    more);
}

std::size_t Tables::positions(std::span<const glm::vec3> values) {
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

void Tables::append_accessor(std::size_t items, int component, const char* type,
                             const std::string& more) {
    accessors += count == 0 ? "" : ",";
    append(accessors += "{\"bufferView\":", count);
    accessors += ",\"componentType\":" + std::to_string(component) + ",\"count\":";
    append(accessors, items);
    ((((accessors += ",\"type\":\"") += type) += '"') += more) += '}';
}

void Tables::append_view(std::size_t length, bool compressed, const std::string& stride,
                         int target) {
    views += count == 0 ? "" : ",";
    views += std::string("{\"buffer\":") + (compressed ? "1" : "0") + ",\"byteOffset\":";
    append(views, compressed ? decompressed : binary);
    append(views += ",\"byteLength\":", length);
    views += stride;
    if (target != 0) views += ",\"target\":" + std::to_string(target);
    if (compressed) decompressed += padded(length);
}

std::size_t Tables::close_stream(std::span<const std::uint8_t> data, std::size_t items,
                                 bool compressed, Bytes& out, const char* filter) {
    if (!compressed) return close_view(data, out);
    const std::size_t stride = data.size() / items;
    return close_compressed_view(append_encoded_vertices(data, items, stride, out), items, stride,
                                 "ATTRIBUTES", out, filter);
}

std::size_t Tables::close_view(std::span<const std::uint8_t> data, Bytes& out) {
    views += '}';
    out.insert(out.end(), data.begin(), data.end());
    out.resize(padded(out.size()));
    binary += padded(data.size());
    return count++;
}

std::size_t Tables::close_compressed_view(std::size_t length, std::size_t items, std::size_t stride,
                                          const char* mode, Bytes& out, const char* filter) {
    ((views += ",\"extensions\":{\"") += meshopt_compression) += "\":{\"buffer\":0,";
    append(views += "\"byteOffset\":", binary);
    append(views += ",\"byteLength\":", length);
    append(views += ",\"byteStride\":", stride);
    append(views += ",\"count\":", items);
    ((views += ",\"mode\":\"") += mode) += '"';
    if (filter) ((views += ",\"filter\":\"") += filter) += '"';
    views += "}}}";
    out.resize(padded(out.size()));
    binary += padded(length);
    return count++;
}

}  // namespace sporeprint::gltf
