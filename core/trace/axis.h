// The axis of a mushroom on a photograph, and places relative to it.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "core/trace/contour.h"
#include "core/trace/gesture.h"

namespace sporeprint::trace {

/// A curve on a photograph from the foot of a mushroom to its top: a polyline in small steps.
class TracedAxis {
  public:
    /// points  at least two, pixels; the curve goes straight on beyond both ends
    explicit TracedAxis(std::vector<glm::dvec2> points);

    /// Returns the arc length between its ends, pixels.
    [[nodiscard]] double length() const { return arcs_.back(); }

    /// Returns the point at an arc length from the foot, pixels; less than 0 or more than length() beyond
    /// the ends.
    [[nodiscard]] glm::dvec2 at(double arc) const;

    /// Returns the unit vector from the foot to the top at an arc length.
    [[nodiscard]] glm::dvec2 tangent(double arc) const;

    /// Returns the distance of a point to the right of the axis, and the arc length of the nearest point
    /// of the axis; both in pixels.
    [[nodiscard]] glm::dvec2 local(const glm::dvec2& point) const;

    /// Returns the point at a distance to the right of the axis.
    [[nodiscard]] glm::dvec2 beside(double right, double arc) const;

    [[nodiscard]] const std::vector<glm::dvec2>& points() const { return points_; }

  private:
    std::vector<glm::dvec2> points_;
    std::vector<double> arcs_;

    [[nodiscard]] std::size_t segment(double arc) const;
};

/// Returns the axis of a mushroom: a smooth curve through the middles between both sides of its stem, which
/// goes straight on above the stem, from the foot to the apex of the contour.
///
/// contour  of the mask
/// drawn    the line of the gesture, from the foot to the top, in the same pixels
/// top      where the stem ends, if that is known: middles beyond it do not count
/// source   middles of rays square to the axis, fitted by a polynomial with weights that fall with the
///          distance from it, so that rings and grass do not count
[[nodiscard]] TracedAxis axis_of(const Contour& contour, const Stroke& drawn,
                                 const std::optional<glm::dvec2>& top = std::nullopt);

/// Returns the straight line from the foot through the middle of the area of a contour to where it leaves it:
/// the axis of a mushroom that is wider than high and has no stem to speak of.
///
/// drawn  as of axis_of(); only its beginning counts
[[nodiscard]] TracedAxis straight_axis(const Contour& contour, const Stroke& drawn);

}  // namespace sporeprint::trace
