// The images of a leaf: both faces and the petiole, as LeafChart lays them out.
#pragma once

#include <cstdint>

#include "core/plant/leaf.h"
#include "core/surface/paint.h"

namespace sporeprint {

/// Paints base colour, normal (+Y up) and occlusion-roughness-metalness.
///
/// autumn   0 summer, 0.5 turning, 1 fallen
/// seed     the blotches of this leaf
/// side     16..2048 texels, a power of two
/// returns  three RGB images, painted a little beyond the border and flat from there on, so that mips bleed nothing in
/// throws   InvalidInput with all that check() finds, or for another side (path "/side")
/// cost     O(side^2)
[[nodiscard]] RawImages leaf_images(const LeafShape& shape, const LeafPalette& palette,
                                    double autumn, std::uint32_t seed, int side,
                                    const Parallel& parallel = in_turn);

}  // namespace sporeprint
