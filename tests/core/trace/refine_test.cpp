#include "core/trace/refine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"
#include "core/trace/fit.h"
#include "core/trace/marked_outline.h"
#include "core/trace/trace.h"
#include "tests/support/drawn_mushroom.h"

namespace sporeprint::trace_refine_test {
namespace {

/// What a trace measures on a mask.
trace::MeasuredOutline measured(const trace::Mask& mask, const trace::Gesture& gesture) {
    return trace::measured(trace::outline_on(mask, gesture, trace::Form::capped).outline,
                           trace::Form::capped);
}

trace::Profile profile_on(const trace::MeasuredOutline& on) {
    return trace::profile_of(on.contour, on.axis, on.marks, on.height, 0.7);
}

/// Returns an upright mushroom of unit height as a camera far away sees it that looks down on it: a stem, and half an
/// ellipsoid whose lower face is hidden behind its margin.
trace::Mask seen_from_above(double pitch_deg, double pixels) {
    constexpr int side = 1000, circles = 600;
    constexpr double stem_top = 0.7, stem_radius = 0.06, cap_radius = 0.35, cap_height = 0.3;
    const auto [sine, cosine] = sine_cosine(radians(pitch_deg));
    trace::Mask mask(side, side);
    // Each of its circles is an ellipse.
    for (int k = 0; k <= circles; ++k) {
        const double y = static_cast<double>(k) / circles, above = (y - stem_top) / cap_height;
        const double r =
            pixels * (above < 0.0 ? stem_radius
                                  : cap_radius * std::sqrt(std::max(1.0 - above * above, 0.0)));
        const double middle = 900.0 - pixels * y * cosine, high = std::max(r * sine, 1.0);
        for (int row = static_cast<int>(middle - high); row <= static_cast<int>(middle + high);
             ++row) {
            const double off = (row + 0.5 - middle) / high;
            const double across = r * std::sqrt(std::max(1.0 - off * off, 0.0));
            for (int x = static_cast<int>(500.0 - across); x < static_cast<int>(500.0 + across);
                 ++x)
                mask.inside[mask.index(x, row)] = 1;
        }
    }
    return mask;
}

TEST(RefinedProfile, FindsHowHighTheCameraWas) {
    for (const double pitch : {3.0, 6.0, 10.0, 14.0}) {
        trace::Gesture gesture;
        gesture.axis = {{500, 890}, {500, 500}, {500, 240}};
        const trace::MeasuredOutline on = measured(seen_from_above(pitch, 700.0), gesture);
        const auto found = trace::refined_profile(profile_on(on), on.axis, on.marks, on.height,
                                                  trace::LowerEdge::margin);
        ASSERT_TRUE(found) << pitch;
        EXPECT_NEAR(found->pitch_deg, pitch, 2.0);
        // The stem goes on behind the near half of the margin.
        const double margin = found->profile.cap.front().y;
        EXPECT_GT(found->profile.stem.back().y, margin);
        EXPECT_NEAR(found->profile.cap.front().x / found->profile.cap.back().y, 0.35, 0.02);
    }
}

TEST(RefinedProfile, IsOnAnAxisThatFollowsAStemWhoseFootIsCutAskew) {
    DrawnMushroom drawn;
    drawn.stem_radius = 0.11;
    trace::Mask mask = drawn.mask();
    // A cut that rises to the right.
    const glm::dvec2 foot = drawn.foot();
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x)
            if (foot.y - y < 0.15 * (x - foot.x) + 12.0) mask.inside[mask.index(x, y)] = 0;
    const trace::MeasuredOutline on = measured(mask, drawn.gesture());
    const auto found = trace::refined_profile(profile_on(on), on.axis, on.marks, on.height,
                                              trace::LowerEdge::face);
    ASSERT_TRUE(found);
    for (const double share : {0.0, 0.25, 0.5, 1.0}) {
        const glm::dvec2 along = found->axis.tangent(share * found->stem_top);
        EXPECT_NEAR(arc_tangent(along.x, -along.y) * 180.0 / pi, 0.0, 1.5) << share;
    }
}

TEST(RefinedProfile, HasTheContourThatWasDrawn) {
    for (const double bend : {0.0, 18.0})
        for (const double turn : {0.0, 9.0}) {
            DrawnMushroom drawn;
            drawn.bend_deg = bend;
            drawn.lean_deg = -0.5 * bend;
            drawn.cap_turn_deg = turn;
            const trace::MeasuredOutline on = measured(drawn.mask(), drawn.gesture());
            const auto found = trace::refined_profile(profile_on(on), on.axis, on.marks, on.height,
                                                      trace::LowerEdge::face);
            ASSERT_TRUE(found);
            trace::Marks marks = on.marks;
            marks.stem_top = found->stem_top;
            marks.cap_turn_deg = 0.0;
            const trace::FittedShape shape =
                trace::fitted_shape(found->profile, found->axis, marks, on.height, 0.1);
            Swept swept;
            swept.silhouette = shape.silhouette;
            swept.axis = shape.axis;
            EXPECT_LT(trace::seen_distance(swept, 0.0, on.marks, on.height, 0.1), 0.005)
                << bend << ' ' << turn;
        }
}

TEST(RefinedProfile, IsNoneWhereTheMarginIsNotAboveTheJunction) {
    // Its lower face is flat: nothing is hidden.
    const DrawnMushroom drawn;
    const trace::MeasuredOutline on = measured(drawn.mask(), drawn.gesture());
    EXPECT_FALSE(trace::refined_profile(profile_on(on), on.axis, on.marks, on.height,
                                        trace::LowerEdge::margin));
}

TEST(SeenDistance, IsThatOfAShapeWhichIsWider) {
    DrawnMushroom drawn;
    drawn.pixels = 800.0;
    const trace::MeasuredOutline on = measured(drawn.mask(), drawn.gesture());
    trace::Traced traced =
        trace::traced(trace::outline_on(drawn.mask(), drawn.gesture(), trace::Form::capped),
                      {0.1, trace::Form::capped});
    const double near = trace::seen_distance(traced.shape, 0.0, on.marks, on.height, 0.1);
    EXPECT_LT(near, 0.004);
    for (auto* part : {&traced.shape.silhouette.stem, &traced.shape.silhouette.hymenium,
                       &traced.shape.silhouette.cap})
        for (OutlinePoint& point : *part) point.r *= 1.15;
    EXPECT_GT(trace::seen_distance(traced.shape, 0.0, on.marks, on.height, 0.1), near + 0.01);
}

}  // namespace
}  // namespace sporeprint::trace_refine_test
