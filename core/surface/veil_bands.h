// The bands across the veil's strip.
#pragma once

namespace sporeprint {

/// Where the outer and the inner side of the veil are painted across its strip. From the attachment
/// to the edge the outer side runs upwards; the inner side, which is the upper face of a ring and the
/// inside of a sac, runs on from the edge to the attachment. Warts and scales show the outer side.
/// Between them the edge goes on, so that coarse images do not mix them.
inline constexpr double veil_outer_to = 0.7, veil_inner_from = 0.76;

}  // namespace sporeprint
