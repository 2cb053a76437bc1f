// The measured outline of a mushroom in the frame of its axis: the mean of both sides.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "core/trace/axis.h"
#include "core/trace/marks.h"

namespace sporeprint::trace {

/// A bulge of a stem that is none of its outline: a ring.
struct TracedRing {
    double height = 0.0;  ///< of its middle above the foot, pixels
    double width = 0.0;   ///< how far it stands out from the stem, pixels
};

/// Three polylines from the foot to the apex, distance from the axis and height along it, pixels. Each begins
/// where the one before it ends.
struct Profile {
    /// The face is empty where a form has none.
    std::vector<glm::dvec2> stem, face, cap;
    std::size_t seen = 0;  ///< points of the cap from the margin on that are on the photograph
    /// The foot is seen to be round: the stem begins on the axis. Otherwise it goes on into the ground.
    bool has_foot = false;
    std::optional<TracedRing> ring;
    double asymmetry = 0.0;  ///< half the mean distance between both sides, of the height
    bool has_corner = true;  ///< between stem and face
};

/// Returns the mean of both sides. The stem is measured square to the axis; the lower face and the cap in
/// the frame of the stem's top, turned as the cap is. What is hidden behind the edge of a funnel or cup is
/// assumed: a round hollow that follows the outer face.
///
/// height  of the mushroom, pixels
/// hollow  depth of that hollow, of the height of the edge above the top of the stem, 0..1
[[nodiscard]] Profile profile_of(const Contour& contour, const TracedAxis& axis, const Marks& marks,
                                 double height, double hollow);

}  // namespace sporeprint::trace
