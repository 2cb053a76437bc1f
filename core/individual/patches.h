// Where the torn pieces of veil and skin lie: drawn once per individual, read by build (geometry) and by paint.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/purposes.h"
#include "core/model/veils.h"

namespace sporeprint {

/// One piece. Angles in radians; lengths in shares of the meridian it lies on.
struct Patch {
    double sigma = 0.0;   ///< along the meridian, 0 at the apex (or the ground)
    double theta = 0.0;   ///< round the axis, 0..2 pi
    double radius = 0.0;  ///< before the amount is applied
    double drawn =
        0.0;  ///< factor drawn for its size, 0.62..1.47: no age and no neighbour changes it
    double spin = 0.0;    ///< turn of its outline
    double height = 0.0;  ///< in its own radii
    double survival =
        0.0;  ///< 0..1: the piece is gone when the amount is below it; it shrinks towards that point
    std::uint32_t id = 0;  ///< names its own random stream
};

/// A window of the meridian that is no wider has no pieces.
inline constexpr double least_window = 1e-6;

/// Places the pieces of a style evenly on the young face (a hemisphere for the cap), from the individual's own stream.
///
/// seed     the individual; purpose  which kind of piece, so that kinds do not share draws
/// returns  style.count pieces in a fixed order, none for a window narrower than least_window; none overlaps another by more than
///          a fifth, and one that has no room has radius 0
[[nodiscard]] std::vector<Patch> patches(const PatchStyle& style, std::uint32_t seed,
                                         std::uint32_t purpose);

/// Size factor 0..1 of a piece when `amount` (0..1) of the veil is left; continuous in amount, 0 when amount is 0.
[[nodiscard]] double patch_scale(const Patch& patch, double amount);

}  // namespace sporeprint
