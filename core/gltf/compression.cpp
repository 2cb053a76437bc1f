#include "core/gltf/compression.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

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

std::size_t place_in(VertexOrder order, std::size_t i) { return order.empty() ? i : order[i]; }

/// Encodes vectors by a filter of meshoptimizer, some at a time, since it reads vectors of four
/// components.
///
/// wide  returns the vector at an index
template <class Item, class Wide>
void write_octahedral(std::size_t count, VertexOrder order, int bits, const Wide& wide,
                      std::vector<Item>& out) {
    std::array<glm::vec4, 256> some{};
    out.resize(count);
    for (std::size_t begin = 0; begin < count; begin += some.size()) {
        const std::size_t n = std::min(some.size(), count - begin);
        for (std::size_t i = 0; i < n; ++i) some[i] = wide(place_in(order, begin + i));
        meshopt_encodeFilterOct(&out[begin], n, sizeof(Item), bits, &some[0].x);
    }
}

}  // namespace

std::vector<std::uint32_t> order_of_first_use(std::span<const std::uint32_t> indices,
                                              std::size_t vertices) {
    std::vector<bool> is_used(vertices, false);
    std::vector<std::uint32_t> order;
    order.reserve(vertices);
    for (const std::uint32_t index : indices) {
        if (is_used[index]) continue;
        is_used[index] = true;
        order.push_back(index);
    }
    for (std::uint32_t i = 0; i < vertices; ++i)
        if (!is_used[i]) order.push_back(i);
    return order;
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

std::vector<Quantized16> octahedral_normals(std::span<const glm::vec3> normals, VertexOrder order,
                                            std::vector<Quantized16> reused) {
    std::vector<Quantized16> out = std::move(reused);
    write_octahedral(
        normals.size(), order, 10, [&](std::size_t i) { return glm::vec4(normals[i], 0.0F); }, out);
    return out;
}

std::vector<Quantized8> octahedral_tangents(std::span<const glm::vec4> tangents,
                                            VertexOrder order) {
    std::vector<Quantized8> out;
    write_octahedral(
        tangents.size(), order, 7, [&](std::size_t i) { return tangents[i]; }, out);
    return out;
}

std::vector<std::uint32_t> filtered_vectors(std::span<const float> values, std::size_t components,
                                            int bits) {
    std::vector<std::uint32_t> out(values.size());
    meshopt_encodeFilterExp(out.data(), values.size() / components, components * sizeof(float),
                            bits, values.data());
    return out;
}

std::size_t append_encoded_vertices(std::span<const std::uint8_t> data, std::size_t count,
                                    std::size_t stride, Bytes& out) {
    const std::size_t before = out.size(), most = meshopt_encodeVertexBufferBound(count, stride);
    out.resize(before + most);
    const std::size_t length =
        meshopt_encodeVertexBuffer(out.data() + before, most, data.data(), count, stride);
    if (length == 0) throw GenerationError("a vertex stream could not be compressed");
    out.resize(before + length);
    return length;
}

std::size_t append_encoded_triangles(std::span<const std::uint32_t> indices, std::size_t vertices,
                                     Bytes& out) {
    // The library's default is version 0, which the extension does not allow.
    [[maybe_unused]] static const bool is_set = (meshopt_encodeIndexVersion(1), true);
    const std::size_t before = out.size(),
                      most = meshopt_encodeIndexBufferBound(indices.size(), vertices);
    out.resize(before + most);
    const std::size_t length =
        meshopt_encodeIndexBuffer(out.data() + before, most, indices.data(), indices.size());
    if (length == 0) throw GenerationError("a triangle list could not be compressed");
    out.resize(before + length);
    return length;
}

}  // namespace sporeprint
