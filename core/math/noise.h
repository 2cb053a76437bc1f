// Noise for painting and geometry: gradient noise, many points at a time, and the choice of the
// instruction set.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sporeprint {

/// Computes gradient noise: smooth, mean 0, deviation about 0.35, zero at integers; features are
/// one unit in size.
///
/// x, y, z  coordinates, N of each, |coordinate| < 1e6
/// out      N values
/// throws   InvalidInput if the lengths differ
/// source   [Perlin2002], gradients uniform in a cube from a 32-bit hash; equal bits with every
///          instruction set
void gradient_noise(std::span<const float> x, std::span<const float> y, std::uint32_t seed,
                    std::span<float> out);
void gradient_noise(std::span<const float> x, std::span<const float> y, std::span<const float> z,
                    std::uint32_t seed, std::span<float> out);

/// Computes the same in the plane, periodic in x with `period` (1..65536) units; 0 <= x <= period.
void periodic_noise(std::span<const float> x, std::span<const float> y, int period,
                    std::uint32_t seed, std::span<float> out);

/// Returns the names that force_simd accepts: "auto", then the instruction sets of this build that
/// this processor has, slowest first.
[[nodiscard]] std::vector<std::string> simd_names();

/// Makes all vector code use one instruction set: scalar, ssse3, sse4, avx2, avx3, or auto for the
/// best. Results do not depend on it.
///
/// throws   InvalidInput (path "simd") if there is no such name, or this processor lacks it
void force_simd(std::string_view name);

}  // namespace sporeprint
