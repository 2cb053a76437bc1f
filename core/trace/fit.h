// A traced profile as the outline of a model: few control points of its own spline.
#pragma once

#include "core/model/swept.h"
#include "core/trace/profile.h"

namespace sporeprint::trace {

/// An outline and an axis that a model can have.
struct FittedShape {
    Silhouette silhouette;
    std::vector<AxisPoint> axis;  ///< from the root to the top of the stem
    double error = 0.0;  ///< greatest distance of the outline from the profile, of the height
};

/// Returns the spline through as few points of each part as keep it within 0.4 % of the height, at
/// most ten, and a root below the ground.
///
/// height    of the mushroom, pixels
/// height_m  the same in metres
/// throws    Impossible if the outline crosses itself (path below "/silhouette")
[[nodiscard]] FittedShape fitted_shape(const Profile& profile, const TracedAxis& axis,
                                       const Marks& marks, double height, double height_m);

/// Returns the outline of another mushroom stretched to a profile: heights move to others that rise with them, and
/// so do distances from the axis, so that junction, margin and apex are where the profile has them. Such a
/// map lets no line cross another. Where the spline through the moved points would, they move less far, last
/// by one factor for all.
///
/// share     how far they move at most, 0..1; at 0 the outline is the other one in its size
/// other     an outline that can be grown, with the parts of the profile
/// height    of the mushroom, pixels
/// height_m  the same in metres
/// throws    Impossible if the other outline cannot be grown either
[[nodiscard]] FittedShape stretched_shape(const Silhouette& other, const Profile& profile,
                                          const TracedAxis& axis, const Marks& marks, double height,
                                          double height_m, double share = 1.0);

/// Returns an axis that bends less, if a stem would fold on it; the same one if it would not.
///
/// axis  as of FittedShape
[[nodiscard]] std::vector<AxisPoint> unfolded(const std::vector<AxisPoint>& axis,
                                              const Silhouette& silhouette);

}  // namespace sporeprint::trace
