#include "core/trace/likeness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/trace/lab.h"
#include "tests/support/drawn_mushroom.h"

namespace sporeprint::trace_likeness_test {
namespace {

/// Returns a picture of one colour.
Picture plain(int side, glm::dvec3 rgb) {
    Picture picture{side, side, {}};
    for (int i = 0; i < side * side; ++i)
        for (int c = 0; c < 3; ++c) picture.rgb.push_back(static_cast<std::uint8_t>(rgb[c]));
    return picture;
}

TEST(Likeness, IsTheOutlineInHeightsWhateverItsSize) {
    DrawnMushroom drawn;
    const trace::Likeness large =
        trace::likeness_of(plain(drawn.side, {90.0, 60.0, 30.0}), drawn.mask());
    EXPECT_NEAR(large.half_widths[10], drawn.stem_radius, 0.004);
    // Just above the lower face, at 0.7 of the height.
    EXPECT_NEAR(large.half_widths[28], drawn.cap_radius, 0.01);
    DrawnMushroom small = drawn;
    small.side = 300;
    small.pixels = 210.0;
    const trace::Likeness other =
        trace::likeness_of(plain(small.side, {90.0, 60.0, 30.0}), small.mask());
    EXPECT_LT(trace::unlikeness(large, other).shape, 0.012);
    EXPECT_EQ(trace::unlikeness(large, other).colour, 0.0);
}

TEST(Likeness, SeesColourOfEachQuarter) {
    const DrawnMushroom drawn;
    Picture picture = plain(drawn.side, {200.0, 200.0, 200.0});
    // The upper part is red.
    for (std::size_t i = 0; i < picture.rgb.size() / 2; ++i) picture.rgb[i] = i % 3 == 0 ? 220 : 20;
    const trace::Likeness found = trace::likeness_of(picture, drawn.mask());
    EXPECT_GT(found.colours[3].y, 60.0);
    EXPECT_NEAR(found.colours[0].y, 0.0, 0.5);
    EXPECT_NEAR(found.colours[0].x, 0.5 * trace::lab_of({200.0, 200.0, 200.0}).x, 1e-9);
}

TEST(Likeness, OfItselfIsNothing) {
    const DrawnMushroom drawn;
    const trace::Likeness found =
        trace::likeness_of(plain(drawn.side, {9.0, 99.0, 199.0}), drawn.mask());
    EXPECT_EQ(trace::unlikeness(found, found).total(), 0.0);
}

}  // namespace
}  // namespace sporeprint::trace_likeness_test
