// The outline of a mushroom: smooth curves through its control points, and the polyline that is
// swept into a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/spline.h"
#include "core/mesh/detail.h"
#include "core/model/swept.h"

namespace sporeprint {

/// A point of an outline in the half-plane of the axis, metres. The tangent has unit length and
/// points from base to apex.
struct OutlineSample {
    double r = 0.0, y = 0.0;
    double tangent_r = 0.0, tangent_y = 0.0;
    double share = 0.0;      ///< arc length from the sub-curve's start over its whole length, 0..1
    double curvature = 0.0;  ///< 1/m; positive where the curve turns left, as around a cap
};

/// The three sub-curves in order from base to apex.
enum class CurveName : std::uint8_t { stem, hymenium, cap };

constexpr const char* name(CurveName curve) {
    switch (curve) {
        case CurveName::stem:
            return "stem";
        case CurveName::hymenium:
            return "hymenium";
        case CurveName::cap:
            return "cap";
    }
    return nullptr;
}

inline constexpr std::array<CurveName, 3> curve_names = {CurveName::stem, CurveName::hymenium,
                                                         CurveName::cap};

/// Returns the number of rings of a sub-curve at a level of detail.
[[nodiscard]] int ring_count(CurveName curve, DetailLevel level);

/// A node of a sub-curve. Nodes lie at equal steps of a parameter u, 0..1, that all shapes of a set
/// share.
struct OutlineNode {
    glm::dvec2 position{0.0};  ///< (r, y)
    glm::dvec2 velocity{0.0};  ///< derivative of the position with respect to u
};

/// An outline as nodes connected by cubics, so that the whole curve is linear in its nodes.
/// Neighbouring sub-curves share their end point bit for bit.
struct OutlineNodes {
    std::vector<OutlineNode> stem;
    /// empty, or collapsed to one point, where a form has no lower face
    std::vector<OutlineNode> hymenium;
    std::vector<OutlineNode> cap;

    [[nodiscard]] const std::vector<OutlineNode>& of(CurveName curve) const {
        return curve == CurveName::stem ? stem : curve == CurveName::hymenium ? hymenium : cap;
    }
    [[nodiscard]] std::vector<OutlineNode>& of(CurveName curve) {
        return curve == CurveName::stem ? stem : curve == CurveName::hymenium ? hymenium : cap;
    }
};

/// One of the three sub-curves, with its arc-length table.
class SubCurve {
  public:
    SubCurve() = default;
    explicit SubCurve(std::vector<SplineSegment<glm::dvec2>> segments);

    /// Builds cubics through nodes at equal steps of u. `fallback_tangent` is the unit tangent
    /// reported for a curve of zero length.
    SubCurve(const std::vector<OutlineNode>& nodes, const glm::dvec2& fallback_tangent);

    [[nodiscard]] bool empty() const { return segments_.empty(); }
    /// Returns the arc length, metres.
    [[nodiscard]] double length() const { return length_; }

    /// Returns the point at a share of the arc length, 0..1.
    [[nodiscard]] OutlineSample at(double share) const;

    /// Returns the points at ascending values of the parameter u, 0..1. The ends equal the first
    /// and last node bit for bit.
    [[nodiscard]] std::vector<OutlineSample> placed(std::span<const double> u) const;

    /// Returns the shares of arc length at which the segments begin and end: one more than there
    /// are segments.
    [[nodiscard]] std::vector<double> segment_shares() const;

    /// Returns the total absolute turning of the tangent from the start to a share of the arc
    /// length, approximately in radians.
    [[nodiscard]] double turning(double share) const;

    /// Returns `count` >= 2 points from start to end, spaced by length and by turning, so that thin
    /// margins stay round.
    [[nodiscard]] std::vector<OutlineSample> sampled(int count) const;

  private:
    struct Knot {
        double arc = 0.0, turn = 0.0, parameter = 0.0;  // the parameter is segment index + t
        double bends = 0.0;  // capped turning up to here, added to the length when rings are placed
    };
    void tabulate(int knots_per_segment);
    void snap_ends(std::vector<OutlineSample>& samples) const;
    [[nodiscard]] OutlineSample sample(double parameter, double arc) const;

    std::vector<SplineSegment<glm::dvec2>> segments_;
    std::vector<Knot> knots_;
    glm::dvec2 fallback_tangent_{0.0, 1.0};
    double length_ = 0.0;
};

/// Returns the share of the arc length of a stem, from its base, that is below y = 0, to 1/64 of it.
[[nodiscard]] double buried_share(const SubCurve& stem);

/// The curve C of [Desbenoit2004] as three smooth sub-curves, base to apex.
struct Outline {
    SubCurve stem, hymenium, cap;

    Outline() = default;

    /// cost  about 10 us
    explicit Outline(const OutlineNodes& nodes);

    /// Builds the outline through the control points of an author.
    ///
    /// pre     silhouette.check() found nothing
    /// throws  Impossible if the curve touches the axis between its ends or crosses itself (path
    ///         below `path`)
    /// source  [Desbenoit2004] sec. 3.1; the spline is centripetal Catmull-Rom
    explicit Outline(const Silhouette& silhouette, const std::string& path = "/model/silhouette");

    /// Builds the same outline without testing whether it crosses itself.
    ///
    /// throws  Impossible if the curve touches the axis between its ends
    [[nodiscard]] static Outline unproven(const Silhouette& silhouette,
                                          const std::string& path = "/model/silhouette");

    [[nodiscard]] const SubCurve& of(CurveName curve) const {
        return curve == CurveName::stem ? stem : curve == CurveName::hymenium ? hymenium : cap;
    }

    /// Returns the rings of a sub-curve at a level of detail, first to last: exactly the polyline
    /// that is swept. They depend on this outline alone, not on the set it was blended in, so the
    /// rings of a mix converge to those of a single species as its weight approaches 1. The result
    /// is empty where the sub-curve does not exist.
    [[nodiscard]] std::vector<OutlineSample> rings(CurveName curve, DetailLevel level) const;
};

}  // namespace sporeprint
