// The intermediate shape of morphs whose linear interpolation self-intersects even through their
// mature stages.
#pragma once

#include <vector>

#include "core/silhouette/outline.h"

namespace sporeprint {

/// Returns a smooth ellipse, as high as the shapes are on average, with their sub-curves laid out
/// from pole to pole and the lower face as a narrow band. No part of it occludes another, so linear
/// interpolation to nearly every shape is free of self-intersections.
///
/// shapes  at least one, all with equally many nodes
[[nodiscard]] OutlineNodes intermediate_shape(const std::vector<OutlineNodes>& shapes);

}  // namespace sporeprint
