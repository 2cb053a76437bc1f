// The images of a piece of wood: its bark, and the end grain of a sawn end.
#pragma once

#include "core/images.h"
#include "core/model/substrate.h"
#include "core/params/shared_params.h"
#include "core/plant/wood.h"

namespace sporeprint {

/// Everything that the images of wood depend on: all pieces of a kind use the same images.
struct WoodPaint {
    Substrate substrate = Substrate::beech;
    ImageSide texture_size{1024};
    bool operator==(const WoodPaint&) const = default;
};

/// Layout in texture coordinates, v downwards: bark above wood_bark_end, as much as faces the viewer,
/// half a girth; below it end grain, u round the pith, v from the rim to the middle. Both wrap in u.
inline constexpr double wood_bark_end = 0.74, wood_end_rim = 0.77, wood_end_middle = 0.99;

/// The length of the bark of one image along the piece, in girths.
inline constexpr double wood_girths = 0.5 * wood_bark_end;

/// Paints base colour, normal (+Y up) and occlusion-roughness-metalness.
///
/// throws  InvalidInput for Substrate::none (path "/substrate") or an invalid side (path "/side")
/// cost    O(side^2)
[[nodiscard]] RawImages wood_images(const WoodPaint& paint, const Parallel& parallel = in_turn);

}  // namespace sporeprint
