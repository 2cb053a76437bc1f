// Images of cap and stem from a photograph, as a model takes them: laid flat, without shade, and closed round the
// mushroom.
#pragma once

#include <optional>

#include "core/surface/codecs.h"
#include "core/trace/photo.h"
#include "core/trace/trace.h"

namespace sporeprint::trace {

/// Images in the layout of core/surface/charts.h; none for a part of which the photograph shows too little.
struct PhotoImages {
    std::optional<Picture> cap;   ///< disc: the apex in the middle, the margin at the rim
    std::optional<Picture> stem;  ///< strip: from the base to the top, and once round
};

/// Returns the images of a mushroom seen from the side.
///
/// picture, mask  of one size
/// traced         in pixels of the mask
/// height_m       of the mushroom
/// source         [Heitz2018] for the blend that hides the mirror
/// cost           about 60 ms
[[nodiscard]] PhotoImages photo_images(const Picture& picture, const Mask& mask,
                                       const Traced& traced, double height_m);

}  // namespace sporeprint::trace
