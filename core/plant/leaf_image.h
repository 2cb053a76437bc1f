// The images of a leaf: both faces and the petiole, as LeafChart lays them out.
#pragma once

#include <cstdint>

#include "core/images.h"
#include "core/plant/leaf.h"

namespace sporeprint {

/// Paints base colour, normal (+Y up) and occlusion-roughness-metalness.
///
/// autumn   0: summer; 0.5: turning; 1: fallen
/// seed     selects the blotches of this leaf
/// side     16..2048 texels, a power of two
/// returns  three RGB images, painted slightly beyond the border and constant from there on, so
///          that mipmaps do not bleed in
/// throws   InvalidInput with all that check() reports, or for another side (path "/side")
/// cost     O(side^2)
[[nodiscard]] RawImages leaf_images(const LeafShape& shape, const LeafPalette& palette,
                                    double autumn, std::uint32_t seed, int side,
                                    const Parallel& parallel = in_turn);

}  // namespace sporeprint
