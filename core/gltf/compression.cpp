#include "core/gltf/compression.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <string>

#include "core/problems.h"

namespace sporeprint {

namespace {

/// Returns std::floor(value + 0.5F), without the call that it is on processors without SSE 4.1.
std::int16_t rounded(float value) {
    const float raised = value + 0.5F;
    const int whole = static_cast<int>(raised);
    return static_cast<std::int16_t>(whole - static_cast<int>(static_cast<float>(whole) > raised));
}

std::int8_t rounded_byte(float value) {
    return static_cast<std::int8_t>(std::floor(value * 127.0F + 0.5F));
}

/// Encodes vectors by a filter of meshoptimizer, some at a time, since it reads vectors of four
/// components.
///
/// wide  returns the vector at an index
template <class Item, class Wide>
std::vector<Item> octahedral(std::size_t count, int bits, const Wide& wide) {
    std::array<glm::vec4, 256> some{};
    std::vector<Item> out(count);
    for (std::size_t begin = 0; begin < count; begin += some.size()) {
        const std::size_t n = std::min(some.size(), count - begin);
        for (std::size_t i = 0; i < n; ++i) some[i] = wide(begin + i);
        meshopt_encodeFilterOct(&out[begin], n, sizeof(Item), bits, &some[0].x);
    }
    return out;
}

/// Returns the bytes that an encoder writes.
///
/// most    bytes that it may write
/// encode  writes them to an address, and returns their number: 0 if it refuses
/// what    is encoded, for the error
template <class Encode>
Bytes encoded(std::size_t most, const Encode& encode, const char* what) {
    const auto memory = std::make_unique_for_overwrite<std::uint8_t[]>(most);
    const std::size_t length = encode(memory.get());
    if (length == 0) throw GenerationError(std::string(what) + " could not be compressed");
    return {memory.get(), memory.get() + length};
}

}  // namespace

Renumbered renumbered_by_first_use(std::span<const std::uint32_t> indices, std::size_t vertices) {
    constexpr std::uint32_t unused = ~0U;
    std::vector<std::uint32_t> place(vertices, unused);
    Renumbered out;
    out.order.reserve(vertices);
    out.indices.reserve(indices.size());
    const auto place_of = [&](std::uint32_t index) {
        if (place[index] == unused) {
            place[index] = static_cast<std::uint32_t>(out.order.size());
            out.order.push_back(index);
        }
        return place[index];
    };
    for (const std::uint32_t index : indices) out.indices.push_back(place_of(index));
    for (std::uint32_t i = 0; i < vertices; ++i) place_of(i);
    return out;
}

float largest_coordinate(std::span<const glm::vec3> values, float at_least) {
    float largest = at_least;
    for (const glm::vec3& value : values)
        largest = std::max({largest, std::abs(value.x), std::abs(value.y), std::abs(value.z)});
    return largest;
}

std::vector<Quantized16> quantized(std::span<const glm::vec3> values, float step) {
    std::vector<Quantized16> out;
    out.reserve(values.size());
    for (const glm::vec3& value : values)
        out.push_back(
            {rounded(value.x / step), rounded(value.y / step), rounded(value.z / step), 0});
    return out;
}

std::vector<Quantized16> quantized_normals(std::span<const glm::vec3> normals) {
    return quantized(normals, 1.0F / 32767.0F);
}

std::vector<Quantized8> quantized_tangents(std::span<const glm::vec4> tangents) {
    std::vector<Quantized8> out;
    out.reserve(tangents.size());
    for (const glm::vec4& tangent : tangents)
        out.push_back({rounded_byte(tangent.x), rounded_byte(tangent.y), rounded_byte(tangent.z),
                       rounded_byte(tangent.w)});
    return out;
}

std::vector<Quantized16> octahedral_normals(std::span<const glm::vec3> normals) {
    return octahedral<Quantized16>(normals.size(), 10,
                                   [&](std::size_t i) { return glm::vec4(normals[i], 0.0F); });
}

std::vector<Quantized8> octahedral_tangents(std::span<const glm::vec4> tangents) {
    return octahedral<Quantized8>(tangents.size(), 7, [&](std::size_t i) { return tangents[i]; });
}

std::vector<std::uint32_t> filtered_vectors(std::span<const float> values, std::size_t components,
                                            int bits) {
    std::vector<std::uint32_t> out(values.size());
    meshopt_encodeFilterExp(out.data(), values.size() / components, components * sizeof(float),
                            bits, values.data());
    return out;
}

Bytes encoded_vertices(std::span<const std::uint8_t> data, std::size_t count, std::size_t stride) {
    const std::size_t most = meshopt_encodeVertexBufferBound(count, stride);
    return encoded(
        most,
        [&](std::uint8_t* out) {
            return meshopt_encodeVertexBuffer(out, most, data.data(), count, stride);
        },
        "a vertex stream");
}

Bytes encoded_triangles(std::span<const std::uint32_t> indices, std::size_t vertices) {
    // The library's default is version 0, which the extension does not allow.
    [[maybe_unused]] static const bool is_set = (meshopt_encodeIndexVersion(1), true);
    const std::size_t most = meshopt_encodeIndexBufferBound(indices.size(), vertices);
    return encoded(
        most,
        [&](std::uint8_t* out) {
            return meshopt_encodeIndexBuffer(out, most, indices.data(), indices.size());
        },
        "a triangle list");
}

}  // namespace sporeprint
