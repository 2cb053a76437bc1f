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

TEST(StretchedShape, HasTheHeightsAndWidthsOfTheProfile) {
    DrawnMushroom drawn;
    drawn.bend_deg = 10.0;
    // Another one: a thicker, shorter stem and a smaller cap.
    DrawnMushroom other;
    other.stem_top = 0.5;
    other.stem_radius = 0.11;
    other.cap_radius = 0.25;
    const Silhouette lent = fitted(other, 0.03).silhouette;
    const trace::Contour contour = trace::contour_of(drawn.mask(), 0.0028 * drawn.pixels);
    const trace::TracedAxis axis =
        trace::axis_of(contour, drawn.gesture().axis, drawn.axis(drawn.stem_top));
    const trace::Marks marks = trace::marks_of(contour, axis, drawn.pixels, trace::Form::capped);
    const trace::Profile profile = trace::profile_of(contour, axis, marks, drawn.pixels, 0.7);
    const auto stretched = [&](double share) {
        return trace::stretched_shape(lent, profile, axis, marks, drawn.pixels, 0.1, share);
    };
    const trace::FittedShape whole = stretched(1.0);
    EXPECT_NO_THROW(static_cast<void>(Outline(whole.silhouette)));
    EXPECT_EQ(whole.silhouette.cap.size(), lent.cap.size());
    EXPECT_NEAR(whole.silhouette.stem.back().y, 0.07, 0.002);
    EXPECT_NEAR(whole.silhouette.stem.back().r, 0.006, 0.0006);
    EXPECT_NEAR(whole.silhouette.hymenium.back().r, 0.035, 0.001);
    EXPECT_NEAR(whole.silhouette.cap.back().y, 0.1, 0.002);
    EXPECT_LT(whole.error, 0.05);
    EXPECT_LT(whole.axis.front().x, whole.axis.back().x);
    // Without any of the map it is the other one in another size.
    const trace::FittedShape sized = stretched(0.0);
    const double size = sized.silhouette.cap.back().y / lent.cap.back().y;
    EXPECT_NEAR(sized.silhouette.cap.back().y, 0.1, 0.002);
    for (std::size_t i = 0; i < lent.stem.size(); ++i) {
        EXPECT_NEAR(sized.silhouette.stem[i].r, size * lent.stem[i].r, 1e-12);
        EXPECT_NEAR(sized.silhouette.stem[i].y, size * lent.stem[i].y, 1e-12);
    }
    EXPECT_GT(sized.error, whole.error);
}

}  // namespace
}  // namespace sporeprint::trace_fit_test
