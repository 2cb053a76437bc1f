#include "core/plant/bark_relief.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/math/elementary.h"
#include "core/math/noise.h"
#include "core/problems.h"

namespace sporeprint {

namespace {

/// The shape of what stands out of bark, and of what parts it.
struct BarkForm {
    double depth;           ///< in widths of the image
    int ridges;             ///< across an image; 0: the bark only swells
    double stretch;         ///< how many times as long as wide ridges are
    double furrow;          ///< width of furrows, as a value of the noise
    double cross = 0.0;     ///< depth of cracks across ridges, as a share of that of furrows
    double cross_by = 1.0;  ///< how many times as long as wide the pieces between these are
};

BarkForm relief_of(Substrate kind) {
    switch (kind) {
        case Substrate::none:
            break;
        case Substrate::beech:
            return {.depth = 0.007, .ridges = 0, .stretch = 1.3, .furrow = 0.0};
        case Substrate::birch:
            return {.depth = 0.006, .ridges = 0, .stretch = 0.8, .furrow = 0.0};
        case Substrate::oak:
            return {.depth = deepest_bark,
                    .ridges = 11,
                    .stretch = 4.5,
                    .furrow = 0.34,
                    .cross = 0.6,
                    .cross_by = 1.4};
        case Substrate::poplar:
            return {.depth = 0.015,
                    .ridges = 9,
                    .stretch = 5.0,
                    .furrow = 0.4,
                    .cross = 0.25,
                    .cross_by = 2.0};
        case Substrate::spruce:
            return {.depth = 0.008,
                    .ridges = 17,
                    .stretch = 1.5,
                    .furrow = 0.13,
                    .cross = 0.55,
                    .cross_by = 0.9};
    }
    throw InvalidInput("/substrate", "no wood has no images");
}

std::vector<float> noise_at(std::span<const float> across, std::span<const float> along, int round,
                            double longer, std::uint32_t seed) {
    std::vector<float> u(across.size()), v(across.size()), out(across.size());
    const auto period = static_cast<float>(round), step = static_cast<float>(round / longer);
    for (std::size_t i = 0; i < u.size(); ++i) {
        u[i] = across[i] * period;
        v[i] = along[i] * step;
    }
    periodic_noise(u, v, round, seed, out);
    return out;
}

}  // namespace

BarkNoise::BarkNoise(Substrate kind, std::span<const float> across, std::span<const float> along)
    : seed_(32U * (7U + static_cast<std::uint32_t>(kind))),
      across_(across),
      along_(along),
      warp_across_(noise_at(across, along, 7, 1.7, seed_ + 30U)),
      warp_along_(noise_at(across, along, 6, 1.3, seed_ + 31U)) {}

std::vector<float> BarkNoise::at(int round, double longer, std::uint32_t purpose,
                                 double warp) const {
    const std::size_t count = across_.size();
    std::vector<float> u(count), v(count), out(count);
    const auto period = static_cast<float>(round), step = static_cast<float>(round / longer),
               by = static_cast<float>(warp);
    for (std::size_t i = 0; i < count; ++i) {
        const float x = across_[i] * period + by * warp_across_[i];
        u[i] = std::min(std::max(x - period * std::floor(x / period), 0.0F), period);
        v[i] = along_[i] * step + by * warp_along_[i];
    }
    periodic_noise(u, v, round, seed_ + purpose, out);
    return out;
}

std::vector<float> bark_rise(Substrate kind, const BarkNoise& noise) {
    const BarkForm style = relief_of(kind);
    if (style.ridges == 0) {
        std::vector<float> out = noise.at(5, style.stretch, 0U);
        const std::vector<float> fine = noise.at(13, style.stretch, 1U);
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = static_cast<float>(smooth_step(
                -0.9, 0.9, static_cast<double>(out[i]) + 0.4 * static_cast<double>(fine[i])));
        return out;
    }
    std::vector<float> out = noise.at(style.ridges, style.stretch, 0U);
    const std::vector<float> middle = noise.at(2 * style.ridges + 1, style.stretch, 1U);
    const std::vector<float> across = noise.at(style.ridges, style.cross_by, 2U, 1.1);
    const std::vector<float> uneven = noise.at(3 * style.ridges, 1.6, 3U);
    for (std::size_t i = 0; i < out.size(); ++i) {
        // Furrows follow a level set of the noise: lines that part and meet. That of 0 would go
        // through every point of the lattice.
        const double rough = 0.09 * static_cast<double>(uneven[i]);
        const double from_furrow = std::abs(static_cast<double>(out[i]) + 0.1 +
                                            0.45 * static_cast<double>(middle[i]) + rough);
        const double from_crack = std::abs(static_cast<double>(across[i]) + 0.13 + rough);
        const double ridge = smooth_step(0.0, style.furrow, from_furrow);
        const double piece = smooth_step(0.0, 0.12, from_crack);
        out[i] =
            static_cast<float>(ridge * (1.0 - style.cross * (1.0 - piece)) * (0.86 + 0.14 * piece));
    }
    return out;
}

double bark_depth(Substrate kind) { return relief_of(kind).depth; }

}  // namespace sporeprint
