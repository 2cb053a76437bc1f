// Positions of the patches of torn veil and skin: drawn once per individual, used by geometry and
// painting.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/purposes.h"
#include "core/model/veils.h"

namespace sporeprint {

/// One patch. Angles are in radians, lengths in shares of its meridian.
struct Patch {
    double sigma = 0.0;   ///< along the meridian, 0 at the apex (or the ground)
    double theta = 0.0;   ///< round the axis, 0..2 pi
    double radius = 0.0;  ///< before the amount is applied
    double drawn = 0.0;   ///< random size factor, 0.3..1.75, independent of age and neighbours
    double spin = 0.0;    ///< rotation of its outline
    double height = 0.0;  ///< in its own radii
    double survival =
        /// 0..1: the patch is absent when the amount is below it; it shrinks towards that point
        0.0;
    std::uint32_t id = 0;  ///< key of its own random stream
};

/// A window of the meridian that is at most this wide has no patches.
inline constexpr double least_window = 1e-6;

/// Places the patches of a style evenly on the young face (a hemisphere for the cap), from the
/// individual's own stream.
///
/// seed     of the individual
/// purpose  the kind of patch, so that kinds do not share draws
/// returns  style.count patches in a fixed order, none for a window narrower than least_window;
///          none overlaps another by more than a fifth, and one without space has radius 0
[[nodiscard]] std::vector<Patch> patches(const PatchStyle& style, std::uint32_t seed,
                                         std::uint32_t purpose);

/// Returns the size factor 0..1 of a patch when `amount` (0..1) of the veil is left; continuous, 0
/// when the amount is 0.
[[nodiscard]] double patch_scale(const Patch& patch, double amount);

}  // namespace sporeprint
