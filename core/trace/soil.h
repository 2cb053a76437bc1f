// Soil below a mushroom that was cut out together with it.
#pragma once

#include "core/surface/codecs.h"
#include "core/trace/gesture.h"
#include "core/trace/photo.h"

namespace sporeprint::trace {

/// Returns a mask without the soil or moss that the mushroom stands on: a plate below its stem, wider than that, of
/// another colour. A foot that is wide itself (a bulb, a volva) has the colours of the stem and stays, and so does
/// a foot that is stained but no wider.
///
/// picture, mask  of one size
/// axis           from the foot to the top, at least two points, in pixels of the mask
/// cost           about 10 ms
[[nodiscard]] Mask without_soil(const Picture& picture, const Mask& mask, const Stroke& axis);

}  // namespace sporeprint::trace
