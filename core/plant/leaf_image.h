// The images of a leaf: both faces and the petiole, as LeafChart lays them out.
#pragma once

#include <cstdint>

#include "core/images.h"
#include "core/plant/leaf.h"

namespace sporeprint {

/// Returns whether the image of a leaf, which is then a needle, shows a shoot of such needles beside it, and
/// a spray of shoots.
[[nodiscard]] bool has_shoot(const Venation& venation);

/// Returns whether the foliage of trees shows a compound leaf by the picture of a shoot: its leaflets are
/// needles that stand all round it.
[[nodiscard]] bool shows_shoots(const LeafShape& shape);

/// Texels of leaves with less alpha are not drawn. Chosen by eye, so that crowns look closed from afar: smaller
/// copies of the image show up to a sixth more of a shoot than it does itself, and a fifth more of a spray. At
/// 0.5 they show as much.
inline constexpr double leaf_alpha_cutoff = 0.4;

/// Paints base colour, normal (+Y up) and occlusion-roughness-metalness.
///
/// autumn   0: summer; 0.5: turning; 1: fallen
/// seed     selects the blotches of this leaf
/// side     16..2048 texels, a power of two
/// layout   sprays have no effect for a needle
/// snow     how much of the upper face it covers, 0..1
/// returns  three RGB images, painted slightly beyond the border and constant from there on, so
///          that mipmaps do not bleed in; with alpha where there are shoots or sprays: between
///          their needles or leaves it is 0
/// throws   InvalidInput with all that check() reports, or for another side (path "/side") or
///          a share outside 0..1 (paths "/autumn", "/snow")
/// cost     O(side^2)
[[nodiscard]] RawImages leaf_images(const LeafShape& shape, const LeafPalette& palette,
                                    double autumn, std::uint32_t seed, int side,
                                    LeafLayout layout = LeafLayout::alone, double snow = 0.0,
                                    const Parallel& parallel = in_turn);

}  // namespace sporeprint
