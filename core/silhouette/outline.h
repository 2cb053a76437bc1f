// The outline of a mushroom as smooth curves through its control points, and as the polyline that is swept.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/math/spline.h"
#include "core/model/model.h"

namespace sporeprint {

/// A point of an outline in the half-plane of the axis, metres. The tangent is unit and points from base to apex.
struct OutlineSample {
    double r = 0.0, y = 0.0;
    double tangent_r = 0.0, tangent_y = 0.0;
    double share = 0.0;  ///< arc length from the sub-curve's start over its whole length, 0..1
};

/// One of the three sub-curves, with its arc-length table.
class SubCurve {
  public:
    SubCurve() = default;
    explicit SubCurve(std::vector<SplineSegment<glm::dvec2>> segments);

    [[nodiscard]] bool empty() const { return segments_.empty(); }
    [[nodiscard]] double length() const { return length_; }

    /// The point at a share of the arc length, 0..1.
    [[nodiscard]] OutlineSample at(double share) const;

    /// `count` >= 2 points from start to end, spaced half by length and half by turning, so that thin margins stay round.
    [[nodiscard]] std::vector<OutlineSample> sampled(int count) const;

  private:
    struct Knot {
        double arc = 0.0, turn = 0.0, parameter = 0.0;  // parameter: segment index + t
    };
    [[nodiscard]] OutlineSample sample(double parameter, double arc) const;

    std::vector<SplineSegment<glm::dvec2>> segments_;
    std::vector<Knot> knots_;
    double length_ = 0.0;
};

/// The paper's curve C as three smooth sub-curves, base to apex.
struct Outline {
    SubCurve stem, hymenium, cap;

    /// pre     silhouette.check() found nothing
    /// throws  Impossible if the curve touches the axis between its ends or crosses itself (path below `path`)
    /// source  [Desbenoit2004] sec. 3.1; the spline is centripetal Catmull-Rom
    explicit Outline(const Silhouette& silhouette, const std::string& path = "/model/silhouette");
};

/// First pair of segments of a polyline that touch without being neighbours; none if it is simple.
/// Exact for the given coordinates up to rounding of one orientation test. cost O(n^2), boxes first
[[nodiscard]] std::optional<std::array<std::size_t, 2>> first_crossing(
    const std::vector<glm::dvec2>& polyline);

}  // namespace sporeprint
