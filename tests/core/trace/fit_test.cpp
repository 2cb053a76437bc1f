#include "core/trace/fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/silhouette/outline.h"
#include "tests/support/drawn_mushroom.h"

namespace sporeprint::trace_fit_test {
namespace {

trace::FittedShape fitted(const DrawnMushroom& drawn, double height_m) {
    const trace::Contour contour = trace::contour_of(drawn.mask(), 0.0028 * drawn.pixels);
    const trace::TracedAxis axis =
        trace::axis_of(contour, drawn.gesture().axis, drawn.axis(drawn.stem_top));
    const trace::Marks marks = trace::marks_of(contour, axis, drawn.pixels, trace::Form::capped);
    return trace::fitted_shape(trace::profile_of(contour, axis, marks, drawn.pixels, 0.7), axis,
                               marks, drawn.pixels, height_m);
}

TEST(FittedShape, StaysNearTheProfileWithFewPoints) {
    for (const double bend : {0.0, 20.0}) {
        DrawnMushroom drawn;
        drawn.bend_deg = bend;
        const trace::FittedShape shape = fitted(drawn, 0.1);
        EXPECT_LE(shape.error, 0.006);
        EXPECT_LE(shape.silhouette.stem.size(), 12U);
        EXPECT_LE(shape.silhouette.hymenium.size(), 10U);
        EXPECT_LE(shape.silhouette.cap.size(), 10U);
        std::vector<Problem> problems;
        shape.silhouette.check("", problems);
        EXPECT_TRUE(problems.empty());
        EXPECT_NO_THROW(static_cast<void>(Outline(shape.silhouette)));
    }
}

TEST(FittedShape, HasMetresAndARootBelowTheGround) {
    const trace::FittedShape shape = fitted(DrawnMushroom{}, 0.2);
    EXPECT_EQ(shape.silhouette.stem.front().r, 0.0);
    EXPECT_NEAR(shape.silhouette.stem.front().y, -0.035 * 0.2, 1e-9);
    EXPECT_NEAR(shape.silhouette.cap.back().y, 0.2, 0.004);
    double widest = 0.0;
    for (const OutlinePoint& point : shape.silhouette.cap) widest = std::max(widest, point.r);
    EXPECT_NEAR(widest, 0.35 * 0.2, 0.002);
}

TEST(FittedShape, ItsAxisHasTheLengthOfTheStemAsItsUnit) {
    DrawnMushroom drawn;
    drawn.bend_deg = 30.0;
    const trace::FittedShape shape = fitted(drawn, 0.1);
    EXPECT_EQ(shape.axis.front().x, 0.0);
    EXPECT_EQ(shape.axis.front().y, 0.0);
    double length = 0.0;
    for (std::size_t i = 1; i < shape.axis.size(); ++i)
        length += std::hypot(shape.axis[i].x - shape.axis[i - 1].x,
                             shape.axis[i].y - shape.axis[i - 1].y);
    EXPECT_NEAR(length, 1.0, 0.01);
    // To the right on the photograph is +x.
    EXPECT_GT(shape.axis.back().x, 0.1);
}

}  // namespace
}  // namespace sporeprint::trace_fit_test
