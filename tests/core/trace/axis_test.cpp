#include "core/trace/axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "tests/support/drawn_mushroom.h"

namespace sporeprint::trace_axis_test {
namespace {

using trace::TracedAxis;

TEST(TracedAxis, GoesStraightOnBeyondItsEnds) {
    const TracedAxis axis({{0.0, 10.0}, {0.0, 0.0}, {10.0, -10.0}});
    EXPECT_NEAR(axis.length(), 10.0 + std::sqrt(200.0), 1e-12);
    EXPECT_NEAR(glm::length(axis.at(-4.0) - glm::dvec2(0.0, 14.0)), 0.0, 1e-12);
    EXPECT_NEAR(glm::length(axis.at(axis.length() + std::sqrt(2.0)) - glm::dvec2(11.0, -11.0)), 0.0,
                1e-9);
}

TEST(TracedAxis, FindsPlacesBesideItAgain) {
    const TracedAxis axis({{0.0, 10.0}, {0.0, 0.0}, {10.0, -10.0}});
    for (const double arc : {-3.0, 1.0, 8.0, 17.0, 30.0})
        for (const double right : {-1.5, 0.0, 1.5}) {
            const glm::dvec2 local = axis.local(axis.beside(right, arc));
            EXPECT_NEAR(local.x, right, 1e-9) << arc;
            EXPECT_NEAR(local.y, arc, 1e-9) << arc;
        }
    // To the right of a line that goes up on the photograph is to the right on the photograph.
    EXPECT_NEAR(axis.local({2.0, 5.0}).x, 2.0, 1e-12);
}

/// Returns the greatest distance between the axis that is found and the true one, of the height.
double error_of(const DrawnMushroom& drawn, const trace::Stroke& line) {
    const trace::Contour contour = trace::contour_of(drawn.mask(), 0.0028 * drawn.pixels);
    const TracedAxis axis = trace::axis_of(contour, line, drawn.axis(drawn.stem_top));
    double greatest = 0.0;
    for (double arc = 0.05; arc < drawn.stem_top - 0.05; arc += 0.05)
        greatest = std::max(greatest, std::abs(axis.local(drawn.axis(arc)).x));
    return greatest / drawn.pixels;
}

TEST(AxisOf, FollowsTheStem) {
    for (const double bend : {0.0, 15.0, 40.0})
        for (const double lean : {-10.0, 0.0, 8.0}) {
            DrawnMushroom drawn;
            drawn.bend_deg = bend;
            drawn.lean_deg = lean - 0.5 * bend;
            EXPECT_LT(error_of(drawn, drawn.gesture().axis), 0.008) << bend << ' ' << lean;
        }
}

TEST(AxisOf, DoesNotFollowAnUnsteadyHand) {
    DrawnMushroom drawn;
    drawn.bend_deg = 15.0;
    trace::Stroke line = drawn.gesture().axis;
    for (std::size_t i = 0; i < line.size(); ++i)
        line[i].x += (i % 2 == 0 ? 0.02 : -0.02) * drawn.pixels;
    EXPECT_LT(error_of(drawn, line), 0.012);
}

TEST(AxisOf, IsNotMovedByARing) {
    DrawnMushroom drawn;
    drawn.ring_width = 0.08;
    EXPECT_LT(error_of(drawn, drawn.gesture().axis), 0.008);
}

TEST(StraightAxis, GoesFromTheFootThroughTheMiddleHoweverALineWasDrawn) {
    for (const double lean : {-15.0, 0.0, 10.0}) {
        DrawnForm drawn = drawn_form(trace::Form::cup);
        drawn.lean_deg = lean;
        drawn.pixels = 400.0;
        const trace::Contour contour = trace::contour_of(drawn.mask(), 1.0);
        // The line ends at the edge instead of the middle.
        const TracedAxis axis =
            trace::straight_axis(contour, {drawn.at({0.0, 0.1}), drawn.at({0.6, 0.95})});
        const glm::dvec2 along = axis.tangent(0.0);
        EXPECT_NEAR(arc_tangent(along.x, -along.y) * 180.0 / pi, lean, 4.0);
        EXPECT_LT(glm::length(axis.at(0.0) - drawn.at({0.0, 0.0})), 0.06 * drawn.pixels) << lean;
        EXPECT_NEAR(axis.length() / drawn.pixels, 1.0, 0.03) << lean;
    }
}

}  // namespace
}  // namespace sporeprint::trace_axis_test
