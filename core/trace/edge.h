// How clear the border of a mushroom is on its photograph.
#pragma once

#include "core/surface/codecs.h"
#include "core/trace/photo.h"

namespace sporeprint::trace {

/// Below this the border of a mask is hardly an edge: what was cut out is perhaps no mushroom, or out of focus.
inline constexpr double least_edge = 6.0;

/// Returns how far the colours on both sides of the border of a mask differ, CIE L*a*b*: the median of the differences
/// of the means within a hundredth of the longest side of the picture. 100 for a mask without a border.
///
/// picture, mask  of one size
/// cost           about 5 ms
[[nodiscard]] double edge_of(const Picture& picture, const Mask& mask);

}  // namespace sporeprint::trace
