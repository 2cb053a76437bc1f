// The intermediate shape of morphs whose linear interpolation self-intersects even through their
// mature stages.
#pragma once

#include <vector>

#include "core/silhouette/outline.h"

namespace sporeprint {

/// Returns half an ellipse, as high as the shapes are on average: the sub-curves follow it from
/// pole to pole, and the lower face is a narrow band of it. Since it is convex, linear
/// interpolation between it and nearly every shape is free of self-intersections.
///
/// shapes  at least one, all with equally many nodes
[[nodiscard]] OutlineNodes intermediate_shape(const std::vector<OutlineNodes>& shapes);

}  // namespace sporeprint
