// The outline of a mushroom as smooth curves through its control points, and as the polyline that is swept.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/spline.h"
#include "core/model/swept.h"

namespace sporeprint {

/// A point of an outline in the half-plane of the axis, metres. The tangent is unit and points from base to apex.
struct OutlineSample {
    double r = 0.0, y = 0.0;
    double tangent_r = 0.0, tangent_y = 0.0;
    double share = 0.0;      ///< arc length from the sub-curve's start over its whole length, 0..1
    double curvature = 0.0;  ///< 1/m; positive where the curve turns to its left, as round a cap
};

/// The three sub-curves, base to apex.
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

/// Rings of a sub-curve at a level of detail.
[[nodiscard]] int ring_count(CurveName curve, int lod);

/// A node of a sub-curve: nodes stand at equal steps of a parameter u, 0..1, that all shapes of a set have in common.
struct OutlineNode {
    glm::dvec2 position{0.0};  ///< (r, y)
    glm::dvec2 velocity{0.0};  ///< derivative of the position by u
};

/// An outline as nodes. Between them run cubics, so that the whole curve is linear in its nodes; neighbouring sub-curves share their end bit for bit.
struct OutlineNodes {
    std::vector<OutlineNode> stem;
    std::vector<OutlineNode> hymenium;  ///< empty, or at one point, where a form has no lower face
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

    /// Cubics through nodes at equal steps of u. `resting` is the unit tangent that is told of a curve of no length.
    SubCurve(const std::vector<OutlineNode>& nodes, const glm::dvec2& resting);

    [[nodiscard]] bool empty() const { return segments_.empty(); }
    [[nodiscard]] double length() const { return length_; }

    /// The point at a share of the arc length, 0..1.
    [[nodiscard]] OutlineSample at(double share) const;

    /// The points at values of the parameter u, 0..1, rising. The ends are the first and last node bit for bit.
    [[nodiscard]] std::vector<OutlineSample> placed(std::span<const double> u) const;

    /// Shares of arc length at which the segments begin and end; one more than there are segments.
    [[nodiscard]] std::vector<double> segment_shares() const;

    /// How far the tangent has turned up to a share of the arc length, to and fro added up, radians.
    [[nodiscard]] double turning(double share) const;

    /// `count` >= 2 points from start to end, spaced by length and by turning, so that thin margins stay round.
    [[nodiscard]] std::vector<OutlineSample> sampled(int count) const;

  private:
    struct Knot {
        double arc = 0.0, turn = 0.0, parameter = 0.0;  // parameter: segment index + t
        double bends = 0.0;  // what its bends add to its length when rings are placed
    };
    void tabulate(int knots_per_segment);
    void pin_ends(std::vector<OutlineSample>& samples) const;
    [[nodiscard]] OutlineSample sample(double parameter, double arc) const;

    std::vector<SplineSegment<glm::dvec2>> segments_;
    std::vector<Knot> knots_;
    glm::dvec2 resting_{0.0, 1.0};
    double length_ = 0.0;
};

/// The paper's curve C as three smooth sub-curves, base to apex.
struct Outline {
    SubCurve stem, hymenium, cap;

    Outline() = default;

    /// cost  about 10 us
    explicit Outline(const OutlineNodes& nodes);

    /// The outline through an author's own control points.
    ///
    /// pre     silhouette.check() found nothing
    /// throws  Impossible if the curve touches the axis between its ends or crosses itself (path below `path`)
    /// source  [Desbenoit2004] sec. 3.1; the spline is centripetal Catmull-Rom
    explicit Outline(const Silhouette& silhouette, const std::string& path = "/model/silhouette");

    /// The same, without the proof that it does not cross itself.
    [[nodiscard]] static Outline unproven(const Silhouette& silhouette,
                                          const std::string& path = "/model/silhouette");

    [[nodiscard]] const SubCurve& of(CurveName curve) const {
        return curve == CurveName::stem ? stem : curve == CurveName::hymenium ? hymenium : cap;
    }

    /// The rings of a sub-curve at a level of detail, first to last: the very polyline that is swept. They follow from this outline
    /// alone, whatever set it was blended in: a mix has its rings where each of its species alone has them, more and more the nearer it
    /// comes to it. Empty where there is no such sub-curve.
    [[nodiscard]] std::vector<OutlineSample> rings(CurveName curve, int lod) const;
};

}  // namespace sporeprint
