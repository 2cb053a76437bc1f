// Quantised and compressed geometry: KHR_mesh_quantization and EXT_meshopt_compression.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "core/bytes.h"

namespace sporeprint {

/// A vector of 16-bit components as it lies in a file: x, y, z and padding, which is 0.
using Quantized16 = std::array<std::int16_t, 4>;
/// A vector of 8-bit components as it lies in a file.
using Quantized8 = std::array<std::int8_t, 4>;

/// Returns the largest absolute coordinate of vectors, but at least `at_least`.
[[nodiscard]] float largest_coordinate(std::span<const glm::vec3> values, float at_least = 0.0F);

/// The largest quantised coordinate. Three bits less than 16 are a fifth of the bytes of compressed
/// positions, and their error is still 2^-14 of the largest coordinate.
inline constexpr int most_quantized = 8192;

/// Triangles whose vertices have another order.
struct Renumbered {
    std::vector<std::uint32_t> order;    ///< of the vertices, as indices of those before
    std::vector<std::uint32_t> indices;  ///< of the triangles
};

/// Returns triangles whose vertices are numbered as they are first used; those that none uses come
/// last.
///
/// indices  each below `vertices`
[[nodiscard]] Renumbered renumbered_by_first_use(std::span<const std::uint32_t> indices,
                                                 std::size_t vertices);

/// Returns vectors as integers: each times the step is within half a step of the vector.
///
/// step  at least largest_coordinate() / most_quantized
[[nodiscard]] std::vector<Quantized16> quantized(std::span<const glm::vec3> values, float step);

/// Returns unit vectors as normalised integers (value / 32767), within 0.003 degrees.
[[nodiscard]] std::vector<Quantized16> quantized_normals(std::span<const glm::vec3> normals);

/// Returns tangents as normalised bytes (value / 127); the direction is within half a degree, the
/// handedness (w) exact.
[[nodiscard]] std::vector<Quantized8> quantized_tangents(std::span<const glm::vec4> tangents);

/// Returns unit vectors for the filter OCTAHEDRAL, with 10 bits for each coordinate: decoding
/// returns what quantized_normals() returns, within 0.3 degrees.
[[nodiscard]] std::vector<Quantized16> octahedral_normals(std::span<const glm::vec3> normals);

/// Returns tangents for the filter OCTAHEDRAL, with 7 bits for each coordinate: decoding returns
/// what quantized_tangents() returns, within two degrees.
[[nodiscard]] std::vector<Quantized8> octahedral_tangents(std::span<const glm::vec4> tangents);

/// Returns vectors for the filter EXPONENTIAL: decoding returns each component within 2^-bits of
/// the largest of its vector.
///
/// values      of all vectors, one after another
/// components  of each vector
/// bits        of the integers, 1..24
[[nodiscard]] std::vector<std::uint32_t> filtered_vectors(std::span<const float> values,
                                                          std::size_t components, int bits);

/// Returns a vertex stream encoded by meshoptimizer, vertex codec 0 (EXT_meshopt_compression, mode
/// ATTRIBUTES).
///
/// data    `count` items of `stride` bytes; padding bytes are 0
/// stride  a multiple of 4, at most 256
/// throws  GenerationError if the encoder refuses
[[nodiscard]] Bytes encoded_vertices(std::span<const std::uint8_t> data, std::size_t count,
                                     std::size_t stride);

/// Returns a triangle list encoded by meshoptimizer, index codec 1 (mode TRIANGLES). Decoding
/// returns the same triangles in the same order, each perhaps from another of its corners.
///
/// throws  GenerationError if the encoder refuses
[[nodiscard]] Bytes encoded_triangles(std::span<const std::uint32_t> indices, std::size_t vertices);

}  // namespace sporeprint
