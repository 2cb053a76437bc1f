#include "core/trace/gesture.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/drawn_mushroom.h"

namespace sporeprint::trace_gesture_test {
namespace {

TEST(Drawn, IsABandOfTheStrokesWidth) {
    const trace::Mask mask = trace::drawn({{{10.0, 5.5}, {30.0, 5.5}}}, 40, 11, 3.0);
    for (int y = 0; y < 11; ++y) EXPECT_EQ(mask.at(20, y), y >= 4 && y <= 6) << y;
    EXPECT_FALSE(mask.at(7, 5));
    EXPECT_FALSE(mask.at(32, 5));
}

TEST(Drawn, IsADiscForAPoint) {
    const trace::Mask mask = trace::drawn({{{50.0, 50.0}}}, 100, 100, 60.0);
    EXPECT_NEAR(static_cast<double>(mask.area()), 3.14159 * 30.0 * 30.0, 30.0);
}

TEST(Drawn, LeavesOutWhatIsBeyondTheBorder) {
    EXPECT_EQ(trace::drawn({{{-50.0, -50.0}, {-10.0, 300.0}}}, 20, 20, 3.0).area(), 0U);
    EXPECT_EQ(trace::drawn({{{-50.0, 10.0}, {500.0, 10.0}}}, 20, 20, 2.0).area(), 40U);
    EXPECT_EQ(trace::drawn({{}}, 20, 20, 2.0).area(), 0U);
}

TEST(WithoutOvershoot, EndsWhereTheMaskIsNoWiderThanTheStroke) {
    // A block from row 30 to 69, and the stroke itself beyond it.
    const trace::Stroke stroke = {{50.0, 20.5}, {50.0, 75.5}};
    trace::Mask mask = trace::drawn({stroke}, 100, 100, 3.0);
    for (int y = 30; y < 70; ++y)
        for (int x = 30; x < 70; ++x) mask.inside[mask.index(x, y)] = 1;
    const trace::Stroke within = trace::without_overshoot(stroke, mask, 3.0);
    EXPECT_NEAR(within.front().y, 30.0, 1.0);
    EXPECT_NEAR(within.back().y, 69.0, 1.0);
    const trace::Stroke inside = {{50.0, 35.0}, {50.0, 65.0}};
    EXPECT_EQ(trace::without_overshoot(inside, mask, 3.0), inside);
    const trace::Stroke thin_stem = {{50.0, 0.5}, {50.0, 69.5}};
    EXPECT_EQ(trace::without_overshoot(thin_stem, mask, 3.0), thin_stem)
        << "more than a fifth is a part of the mushroom";
    EXPECT_EQ(trace::without_overshoot({}, mask, 3.0), trace::Stroke{});
    EXPECT_EQ(trace::without_overshoot({{5.0, 5.0}}, mask, 3.0).size(), 1U);
}

TEST(UprightLine, IsFromTheFootToTheMiddleOfTheCap) {
    trace::Mask mask(60, 100);
    const auto fill = [&](int left, int top, int right, int bottom) {
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x) mask.inside[mask.index(x, y)] = 1;
    };
    fill(20, 30, 30, 90);
    fill(10, 10, 50, 30);
    // The highest place is at the edge of a tilted cap.
    mask.inside[mask.index(49, 9)] = 1;
    const trace::Stroke line = trace::upright_line(mask);
    ASSERT_EQ(line.size(), 2U);
    EXPECT_EQ(line[0], glm::dvec2(25.0, 89.5));
    EXPECT_NEAR(line[1].x, 30.0, 0.1);
    EXPECT_EQ(line[1].y, 9.5);
    EXPECT_TRUE(trace::upright_line(trace::Mask(3, 3)).empty());
}

TEST(Gesture, IsScaledWithThePhotograph) {
    const trace::Gesture gesture{{{1.0, 2.0}, {3.0, 4.0}},
                                 {{5.0, 6.0}},
                                 {{{7.0, 8.0}}},
                                 {{{9.0, 10.0}}},
                                 trace::PhotoFrame{{11.0, 12.0}, {13.0, 14.0}}};
    const trace::Gesture half = gesture.scaled(0.5);
    EXPECT_EQ(half.axis[1], glm::dvec2(1.5, 2.0));
    EXPECT_EQ(half.cap[0], glm::dvec2(2.5, 3.0));
    EXPECT_EQ(half.keep[0][0], glm::dvec2(3.5, 4.0));
    EXPECT_EQ(half.drop[0][0], glm::dvec2(4.5, 5.0));
    EXPECT_EQ(half.frame->to, glm::dvec2(6.5, 7.0));
}

TEST(IsReversed, ALineFromTheTopToTheFootOfAnUprightMushroom) {
    for (const double lean : {-30.0, 0.0, 20.0}) {
        DrawnMushroom drawn;
        drawn.pixels = 500.0;
        drawn.lean_deg = lean;
        const trace::Stroke up = {drawn.axis(0.03), drawn.axis(0.9)}, down = {up[1], up[0]};
        EXPECT_FALSE(trace::is_reversed(up, drawn.mask())) << lean;
        EXPECT_TRUE(trace::is_reversed(down, drawn.mask())) << lean;
        // The same mushroom on its head: its foot is above.
        trace::Mask turned = drawn.mask();
        std::reverse(turned.inside.begin(), turned.inside.end());
        const auto mirrored = [&](const glm::dvec2& at) {
            return glm::dvec2(drawn.side - at.x, drawn.side - at.y);
        };
        EXPECT_FALSE(trace::is_reversed({mirrored(up[0]), mirrored(up[1])}, turned)) << lean;
    }
    // A ball has no wider half: down is from the top.
    trace::Mask ball(100, 100);
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 100; ++x)
            ball.inside[ball.index(x, y)] = (x - 50) * (x - 50) + (y - 50) * (y - 50) < 1600;
    EXPECT_TRUE(trace::is_reversed({{50, 15}, {50, 80}}, ball));
    EXPECT_FALSE(trace::is_reversed({{50, 80}, {50, 15}}, ball));
    // A line that lies is taken as it is.
    EXPECT_FALSE(trace::is_reversed({{15, 50}, {80, 55}}, ball));
}

}  // namespace
}  // namespace sporeprint::trace_gesture_test
