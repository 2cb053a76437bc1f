// Bark as an image that wraps once round a segment and is repeated along it, mirrored.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/images.h"
#include "core/params/describe.h"

namespace sporeprint {

/// The parameters of the look of bark.
struct BarkStyle {
    Colour ridge{118, 102, 84};
    Colour furrow{52, 42, 34};
    double furrows = 0.6;
    int ridges = 12;
    double stretch = 4.0;
    double lenticels = 0.0;
    Colour lenticel{48, 42, 40};

    static constexpr void fields(auto visit) {
        using B = BarkStyle;
        visit(&B::ridge, Info{.name = "ridge", .doc = "Colour of what stands out."});
        visit(&B::furrow, Info{.name = "furrow", .doc = "Colour of what lies deep."});
        visit(&B::furrows, Info{.name = "furrows",
                                .min = 0,
                                .max = 1,
                                .doc = "Depth of the furrows; 0 for smooth bark."});
        visit(&B::ridges,
              Info{.name = "ridges", .min = 3, .max = 40, .doc = "Ridges round a limb."});
        visit(&B::stretch, Info{.name = "stretch",
                                .min = 1,
                                .max = 12,
                                .doc = "How much longer ridges are than wide."});
        visit(&B::lenticels, Info{.name = "lenticels",
                                  .min = 0,
                                  .max = 1,
                                  .doc = "How many level dashes there are, as on birches."});
        visit(&B::lenticel, Info{.name = "lenticel", .doc = "Colour of the dashes."});
    }
    bool operator==(const BarkStyle&) const = default;
};
static_assert(well_described<BarkStyle>());

/// The length of one image along a segment, in girths of the segment.
inline constexpr double bark_girths = 2.0;

/// Returns the place in an image, 0..1, of a point so many images from its start, where every other
/// image is mirrored: it is continuous at both of its ends.
inline double mirrored_place(double images) {
    return 1.0 - std::abs(1.0 - (images - 2.0 * std::floor(0.5 * images)));
}

/// Paints base colour, normal (+Y up, towards the start of a segment) and
/// occlusion-roughness-metalness; the images wrap horizontally.
///
/// side     16..2048 texels, a power of two
/// throws   InvalidInput with all that check() reports, or for another side (path "/side")
/// cost     O(side^2)
[[nodiscard]] RawImages bark_images(const BarkStyle& style, std::uint32_t seed, int side,
                                    const Parallel& parallel = in_turn);

}  // namespace sporeprint
