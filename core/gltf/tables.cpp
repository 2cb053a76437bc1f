#include "core/gltf/tables.h"

#include <glm/common.hpp>
#include <utility>

#include "core/gltf/compression.h"
#include "core/gltf/json_text.h"

namespace sporeprint::gltf {

namespace {

/// Returns items of so many bytes in another order.
template <std::size_t Size>
Bytes ordered(const Bytes& data, std::span<const std::uint32_t> order) {
    Bytes out(data.size());
    std::uint8_t* at = out.data();
    for (const std::uint32_t i : order) {
        std::memcpy(at, data.data() + Size * i, Size);
        at += Size;
    }
    return out;
}

}  // namespace

void Stream::encode(std::span<const std::uint32_t> order) {
    if (!order.empty()) data = stride == 4 ? ordered<4>(data, order) : ordered<8>(data, order);
    set_bytes(mode ? encoded_vertices(data, items, stride) : std::move(data));
    data = {};
}

void Stream::encode_triangles(std::span<const std::uint32_t> indices, std::size_t vertices) {
    if (mode) return set_bytes(encoded_triangles(indices, vertices));
    Bytes plain(indices.size() * stride);
    std::uint8_t* at = plain.data();
    for (const std::uint32_t index : indices)
        if (stride == 2)
            put(at, static_cast<std::uint16_t>(index));
        else
            put(at, index);
    set_bytes(std::move(plain));
}

void Stream::set_bytes(Bytes encoded) {
    length = encoded.size();
    bytes = std::make_shared<Bytes>(std::move(encoded));
    bytes->resize(padded(length));
}

std::size_t Tables::view(std::size_t length, int target) {
    views += count == 0 ? "" : ",";
    append(views += "{\"buffer\":", buffer);
    append(views += ",\"byteOffset\":", binary);
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

std::size_t Tables::stream(const Stream& stream) {
    append_accessor(stream.items, stream.component, stream.type, stream.more);
    const std::size_t plain = stream.items * stream.stride;
    views += count == 0 ? "" : ",";
    // A compressed view lies in the second buffer, which no file contains.
    append(views += "{\"buffer\":", stream.mode ? std::size_t{1} : buffer);
    views += ",\"byteOffset\":";
    append(views, stream.mode ? decompressed : binary);
    append(views += ",\"byteLength\":", plain);
    if (stream.target == vertex_target) append(views += ",\"byteStride\":", stream.stride);
    if (stream.target != 0)
        append(views += ",\"target\":", static_cast<std::size_t>(stream.target));
    if (stream.mode) {
        decompressed += padded(plain);
        ((views += ",\"extensions\":{\"") += meshopt_compression) += "\":{\"buffer\":0,";
        append(views += "\"byteOffset\":", binary);
        append(views += ",\"byteLength\":", stream.length);
        append(views += ",\"byteStride\":", stream.stride);
        append(views += ",\"count\":", stream.items);
        ((views += ",\"mode\":\"") += stream.mode) += '"';
        if (stream.filter) ((views += ",\"filter\":\"") += stream.filter) += '"';
        views += "}}";
    }
    views += '}';
    binary += padded(stream.length);
    return count++;
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

}  // namespace sporeprint::gltf
