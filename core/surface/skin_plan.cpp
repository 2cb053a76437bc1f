#include "core/surface/skin_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

constexpr float single(double value) { return static_cast<float>(value); }

// What a kind of skin looks like at full strength: elongation of its cells, deviations of
// brightness, hue, slope and roughness, the skew of its brightness, and the unevenness of its film.
struct SkinLook {
    double elongation, tone, hue, slope, gloss, skew, film;
};

SkinLook look_of(SkinKind kind) {
    switch (kind) {
        case SkinKind::smooth:
            return {1.0, 0.16, 0.06, 0.06, 0.06, 0.0, 0.03};
        case SkinKind::fibrillose:
            return {8.0, 0.36, 0.06, 0.14, 0.08, -0.2, 0.0};
        case SkinKind::silky:
            return {14.0, 0.24, 0.04, 0.07, 0.16, 0.0, 0.03};
        case SkinKind::velvety:
            return {1.0, 0.26, 0.06, 0.08, 0.06, 0.4, 0.0};
        case SkinKind::granular:
            return {1.0, 0.32, 0.05, 0.20, 0.06, 0.8, 0.0};
        case SkinKind::viscid:
            return {1.0, 0.16, 0.10, 0.03, 0.10, 0.0, 0.12};
        case SkinKind::matt:
            return {1.0, 0.24, 0.06, 0.10, 0.08, -0.5, 0.0};
    }
    return {};
}

}  // namespace

SkinPlan skin_plan(const SkinTexture& skin, const SkinScale& scale, double smoothed,
                   std::uint32_t seed) {
    SkinPlan plan;
    const SkinLook look = look_of(skin.kind);
    const double strength = skin.strength;
    const double stretch = look.elongation;
    plan.shows = strength > 0.0 || skin.bloom > 0.0;
    plan.fibres = plan.shows && look.elongation > 1.0;
    plan.fibre_seed = seed;
    plan.elongation = single(stretch);
    plan.tone = single(look.tone * strength);
    plan.hue = single(look.hue * strength);
    plan.gloss = single(look.gloss * strength);
    plan.skew = single(look.skew);
    plan.film = single(look.film * strength);
    plan.bloom = single(skin.bloom);
    const double texel = scale.is_round ? scale.texel_x : std::max(scale.texel_x, scale.texel_y);
    double cell = 1.0;
    std::uint32_t octave_number = 0;
    for (; octave_number < 24U && 0.5 * cell >= 1.5 * texel; ++octave_number) cell *= 0.5;
    constexpr std::array<double, 3> spectrum = {0.85, 0.9, 0.6};
    double variance = 0.0;
    for (std::size_t i = 0; i < 3; ++i, cell *= 2.0, --octave_number) {
        const double seen = std::clamp((cell / texel - 1.5) / 1.0, 0.0, 1.0);
        const double weight = seen * spectrum[i] * std::min(1.0, skin.grain / cell);
        plan.seed[i] = seed + octave_number * 0x9E3779B9U;
        plan.weight[i] = single(weight);
        plan.rise[i] = single(weight * look.slope * strength * smoothed * cell / scale.unit);
        variance += 0.1 * weight * weight;
        if (scale.is_round) {
            const double round = std::max(3.0, std::floor(scale.unit / cell + 0.5));
            plan.cells[i] = single(round);
            plan.cells_along[i] =
                single(scale.unit / std::max(stretch * scale.unit / round, 2.2 * scale.texel_y));
        } else {
            plan.cells[i] = single(scale.unit / cell);
        }
    }
    plan.tone_variance = single(variance);
    return plan;
}

Hue hue_of(std::uint32_t seed) {
    Random stream(seed, purposes::hue);
    const double warm = std::clamp(stream.normal(), -2.0, 2.0);
    const double green = std::clamp(stream.normal(), -2.0, 2.0);
    const double turn = stream.uniform();
    return {warm, green, turn};
}

Light tint_of(const Hue& hue, double amount) {
    return {single(1.0 + 0.11 * amount * hue.warm), single(1.0 + 0.06 * amount * hue.green),
            single(1.0 - 0.19 * amount * hue.warm)};
}

}  // namespace sporeprint
