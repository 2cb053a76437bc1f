// Converts the texture of a skin, and the hue of an individual, to the values that the kernels read.
// Private to core/surface.
#pragma once

#include <cstdint>

#include "core/model/surface.h"
#include "core/surface/plan.h"

namespace sporeprint {

/// Lengths of a chart in metres: of its unit, and of a texel along x and y.
struct SkinScale {
    double unit, texel_x, texel_y;
    bool is_round = false;  ///< x runs once round, and its unit is once round
};

/// Returns the octaves of a skin at the resolution of a chart. They are at fixed lengths, powers of
/// two of a metre. Those finer than 1.5 texels are left out, and the finest of the others fades in
/// up to 2.5 texels.
///
/// smoothed  factor on its relief
[[nodiscard]] SkinPlan skin_plan(const SkinTexture& skin, const SkinScale& scale, double smoothed,
                                 std::uint32_t seed);

/// How the hue of an individual differs from its species': two deviates, and the direction on the
/// cap's disc in which it becomes warmer, in turns.
struct Hue {
    double warm, green, turn;
};
[[nodiscard]] Hue hue_of(std::uint32_t seed);

/// Returns factors on a colour, whose mean over all seeds is 1.
[[nodiscard]] Light tint_of(const Hue& hue, double amount);

}  // namespace sporeprint
