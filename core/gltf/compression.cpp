#include "core/gltf/compression.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/problems.h"

namespace sporeprint {

namespace {

std::int16_t rounded(float value) { return static_cast<std::int16_t>(std::floor(value + 0.5F)); }

std::int8_t rounded_byte(float value) {
    return static_cast<std::int8_t>(std::floor(value * 127.0F + 0.5F));
}

}  // namespace

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
    std::vector<glm::vec4> wide;
    wide.reserve(normals.size());
    for (const glm::vec3& normal : normals) wide.emplace_back(normal, 0.0F);
    std::vector<Quantized16> out(normals.size());
    meshopt_encodeFilterOct(out.data(), out.size(), sizeof(Quantized16), 10, &wide[0].x);
    return out;
}

std::vector<Quantized8> octahedral_tangents(std::span<const glm::vec4> tangents) {
    std::vector<Quantized8> out(tangents.size());
    meshopt_encodeFilterOct(out.data(), out.size(), sizeof(Quantized8), 8, &tangents[0].x);
    return out;
}

std::vector<std::uint32_t> filtered_vectors(std::span<const float> values, std::size_t components,
                                            int bits) {
    std::vector<std::uint32_t> out(values.size());
    meshopt_encodeFilterExp(out.data(), values.size() / components, components * sizeof(float),
                            bits, values.data());
    return out;
}

Bytes encoded_vertices(std::span<const std::uint8_t> data, std::size_t count, std::size_t stride) {
    Bytes out(meshopt_encodeVertexBufferBound(count, stride));
    out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), data.data(), count, stride));
    if (out.empty()) throw GenerationError("a vertex stream could not be compressed");
    return out;
}

Bytes encoded_triangles(std::span<const std::uint32_t> indices, std::size_t vertices) {
    // The library's default is version 0, which the extension does not allow.
    [[maybe_unused]] static const bool is_set = (meshopt_encodeIndexVersion(1), true);
    Bytes out(meshopt_encodeIndexBufferBound(indices.size(), vertices));
    out.resize(meshopt_encodeIndexBuffer(out.data(), out.size(), indices.data(), indices.size()));
    if (out.empty()) throw GenerationError("a triangle list could not be compressed");
    return out;
}

}  // namespace sporeprint
