// A traced profile bettered by drawing its mushroom and comparing contours.
#pragma once

#include <optional>

#include "core/model/swept.h"
#include "core/trace/axis.h"
#include "core/trace/marks.h"
#include "core/trace/profile.h"

namespace sporeprint::trace {

/// What is taken for the lower edge of a cap on the photograph: its lower face as it is seen from the side; or
/// the near half of its margin, seen from above, before a lower face that is hidden.
enum class LowerEdge { face, margin };

/// How high a camera may be above the mushroom, degrees.
inline constexpr double most_pitch_deg = 15.0;

/// A profile with its axis, and how high the camera was.
struct RefinedProfile {
    Profile profile;
    TracedAxis axis;
    double stem_top = 0.0;   ///< arc length of the axis where the stem ends, pixels
    double pitch_deg = 0.0;  ///< of the camera above the horizon, 0 to 15
    double apart = 0.0;      ///< the sum that was made least
};

/// Moves the foot, bends the axis, and widens and raises stem, lower face and cap so that the mushroom, drawn as a
/// camera sees it, has the contour that was measured. Its cap stands on the stem's top as the axis does.
///
/// height   of the mushroom, pixels
/// returns  none if the lower edge cannot be what it is to be taken for
/// source   the least sum of distances of contour points from the drawn contour, soft above half a percent of the
///          height, by Levenberg and Marquardt's method
[[nodiscard]] std::optional<RefinedProfile> refined_profile(const Profile& profile,
                                                            const TracedAxis& axis,
                                                            const Marks& marks, double height,
                                                            LowerEdge edge);

/// Returns the mean distance of a measured contour from that of a shape as a camera sees it, where it fits best,
/// of the height.
///
/// shape   an outline and an axis, metres
/// height  of the mushroom, pixels
[[nodiscard]] double seen_distance(const Swept& shape, double pitch_deg, const Marks& marks,
                                   double height, double height_m);

}  // namespace sporeprint::trace
