#include "core/world/height_field.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/math/elementary.h"
#include "core/math/noise.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/problems.h"

namespace sporeprint {

namespace {

/// Standard deviation of gradient_noise() over the plane: the root of 1.6^2 / 3 * 8 A B, where B is
/// the integral of the squared weight of a corner along a side of a cell, and A that of its product
/// with the squared distance from the corner.
constexpr double noise_deviation = 0.28180341267601344;

/// Standard deviations of the height between high and low ground.
constexpr double deviations_in_relief = 4.0;

/// Coordinates are displaced by this many features per unit of noise, and the noise that displaces
/// them has lattice cells of this many features.
constexpr double warp_amplitude = 0.35, warp_size = 1.3;

/// Number of octaves that are displaced, from the largest on. Displaced details would be streaks.
constexpr std::size_t warped_octaves = 3;

/// How much wider valleys are than ridges, 0..1: slopes of low ground are multiplied by down to 1
/// less this, those of high ground by up to 1 more.
constexpr double valley_width = 0.6;

/// Octaves are shifted by up to this many cells of their lattice.
constexpr double most_shift = 256.0;

/// Points per call of the noise: all arrays of a block stay in the first-level cache.
constexpr std::size_t block_size = 256;

}  // namespace

Grid world_grid(int extent) {
    if (extent != 256 && extent != 1024 && extent != 4096)
        throw InvalidInput("extent", std::to_string(extent) + " is none of 256, 1024, 4096");
    const double whole = 1.25 * extent;
    return {world_grid_side, whole / (world_grid_side - 1), -0.5 * whole};
}

HeightFunction::Octave HeightFunction::octave_of(std::uint32_t seed, std::uint32_t object,
                                                 double size) {
    Random random(seed, purposes::terrain, object);
    Octave octave;
    octave.seed = random.bits();
    const double x0 = random.uniform(0.0, most_shift);
    const double y0 = random.uniform(0.0, most_shift);
    // The golden section of a right angle: no two lattices are nearly parallel.
    const double first = Random(seed, purposes::terrain, octaves + 2).uniform(0.0, 2.0 * pi);
    const SineCosine turn = sine_cosine(first + object * 0.61803398874989485 * 0.5 * pi);
    octave.xx = static_cast<float>(turn.cosine / size);
    octave.xy = static_cast<float>(-turn.sine / size);
    octave.yx = static_cast<float>(turn.sine / size);
    octave.yy = static_cast<float>(turn.cosine / size);
    octave.x0 = static_cast<float>(x0);
    octave.y0 = static_cast<float>(y0);
    return octave;
}

HeightFunction::HeightFunction(const TerrainParams& params, std::uint32_t seed) {
    require_valid(params);
    double size = params.feature, amplitude = 1.0, variance = 0.0;
    for (std::size_t i = 0; i < octaves; ++i) {
        octaves_[i] = octave_of(seed, static_cast<std::uint32_t>(i), size);
        octaves_[i].amplitude = amplitude;
        variance += amplitude * amplitude;
        amplitude *= params.roughness;
        size *= 0.5;
    }
    const double scale = 1.0 / (noise_deviation * std::sqrt(variance));
    for (Octave& octave : octaves_) octave.amplitude *= scale;
    deviation_ = params.relief / deviations_in_relief;
    for (std::size_t i = 0; i < warps_.size(); ++i) {
        warps_[i] =
            octave_of(seed, static_cast<std::uint32_t>(octaves + i), warp_size * params.feature);
        warps_[i].amplitude = warp_amplitude * params.feature;
    }
}

void HeightFunction::Octave::sample(std::span<const float> x, std::span<const float> y,
                                    std::span<float> out) const {
    std::array<float, block_size> u, v;
    for (std::size_t i = 0; i < x.size(); ++i) {
        u[i] = xx * x[i] + xy * y[i] + x0;
        v[i] = yx * x[i] + yy * y[i] + y0;
    }
    gradient_noise(std::span(u).first(x.size()), std::span(v).first(x.size()), seed, out);
}

void HeightFunction::add_block(std::span<const float> x, std::span<const float> y,
                               std::span<double> out) const {
    const std::size_t count = x.size();
    std::array<float, block_size> warped_x, warped_y, noise;
    const auto warp = [&](const Octave& by, std::span<const float> from,
                          std::array<float, block_size>& to) {
        by.sample(x, y, std::span(noise).first(count));
        const auto amplitude = static_cast<float>(by.amplitude);
        for (std::size_t i = 0; i < count; ++i) to[i] = from[i] + amplitude * noise[i];
    };
    warp(warps_[0], x, warped_x);
    warp(warps_[1], y, warped_y);
    for (std::size_t k = 0; k < octaves; ++k) {
        const bool is_warped = k < warped_octaves;
        octaves_[k].sample(is_warped ? std::span<const float>(warped_x).first(count) : x,
                           is_warped ? std::span<const float>(warped_y).first(count) : y,
                           std::span(noise).first(count));
        for (std::size_t i = 0; i < count; ++i)
            out[i] += octaves_[k].amplitude * static_cast<double>(noise[i]);
    }
}

void HeightFunction::heights(std::span<const float> x, std::span<const float> y,
                             std::span<double> out) const {
    if (x.size() != y.size() || x.size() != out.size())
        throw InvalidInput("", "coordinates and heights differ in number");
    std::fill(out.begin(), out.end(), 0.0);
    for (std::size_t from = 0; from < x.size(); from += block_size) {
        const std::size_t count = std::min(block_size, x.size() - from);
        add_block(x.subspan(from, count), y.subspan(from, count), out.subspan(from, count));
    }
    for (double& t : out) t = deviation_ * (t + valley_width * (std::sqrt(t * t + 1.0) - 1.0));
}

std::int32_t quantised_height(double height) {
    return static_cast<std::int32_t>(std::floor(height * height_units + 0.5));
}

std::vector<std::int32_t> heights_of(const TerrainParams& params, std::uint32_t seed, int extent) {
    const HeightFunction function(params, seed);
    const Grid grid = world_grid(extent);
    const auto side = static_cast<std::size_t>(grid.side);
    std::vector<float> x(side), y(side);
    std::vector<double> row(side);
    for (int column = 0; column < grid.side; ++column)
        x[static_cast<std::size_t>(column)] = static_cast<float>(grid.place(column));
    std::vector<std::int32_t> heights(grid.nodes());
    for (int j = 0; j < grid.side; ++j) {
        std::fill(y.begin(), y.end(), static_cast<float>(grid.place(j)));
        function.heights(x, y, row);
        std::transform(row.begin(), row.end(),
                       heights.begin() + static_cast<std::ptrdiff_t>(grid.index(0, j)),
                       quantised_height);
    }
    return heights;
}

}  // namespace sporeprint
