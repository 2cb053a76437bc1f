// Noise for painting and growing: gradient noise and cells, many points at a time, and the choice
// of instruction set.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sporeprint {

/// Gradient noise: smooth, mean 0, deviation about 0.35, zero at whole numbers; features one unit
/// in size.
///
/// x, y, z  coordinates, N of each, |coordinate| < 1e6
/// out      N values
/// throws   InvalidInput if the lengths differ
/// source   [Perlin2002], gradients uniform in a cube from a 32-bit hash; equal bits with every
/// instruction set
void gradient_noise(std::span<const float> x, std::span<const float> y, std::uint32_t seed,
                    std::span<float> out);
void gradient_noise(std::span<const float> x, std::span<const float> y, std::span<const float> z,
                    std::uint32_t seed, std::span<float> out);

/// The same in the plane, repeating in x after `period` (1..65536) units; 0 <= x <= period.
void periodic_noise(std::span<const float> x, std::span<const float> y, int period,
                    std::uint32_t seed, std::span<float> out);

/// Names that force_simd takes: "auto", then the instruction sets of this build that this
/// processor has, slowest first.
[[nodiscard]] std::vector<std::string> simd_names();

/// Makes all vector code use one instruction set: scalar, ssse3, sse4, avx2, avx3, or auto for the
/// best. Bytes do not depend on it.
///
/// throws   InvalidInput (path "simd") if there is no such name, or this processor lacks it
void force_simd(std::string_view name);

}  // namespace sporeprint
