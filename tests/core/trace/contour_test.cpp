#include "core/trace/contour.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/math/elementary.h"

namespace sporeprint::trace_contour_test {
namespace {

using trace::Contour;
using trace::Mask;

Mask disc(double radius, int side) {
    Mask mask(side, side);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            mask.inside[mask.index(x, y)] =
                std::hypot(x + 0.5 - 0.5 * side, y + 0.5 - 0.5 * side) < radius ? 1 : 0;
    return mask;
}

TEST(Contour, OfADiscIsACircle) {
    const Contour contour = trace::contour_of(disc(80.0, 200), 3.0);
    EXPECT_NEAR(trace::area_of(contour), pi * 6400.0, 0.004 * pi * 6400.0);
    for (const glm::dvec2& at : contour)
        EXPECT_NEAR(glm::length(at - glm::dvec2(100.0)), 80.0, 0.6);
}

TEST(Contour, HasTheMaskOnItsRight) {
    const Contour contour = trace::contour_of(disc(80.0, 200), 3.0);
    double turn = 0.0;
    for (std::size_t i = 0; i < contour.size(); ++i) {
        const glm::dvec2 a = contour[i] - 100.0, b = contour[(i + 1) % contour.size()] - 100.0;
        turn += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
    }
    // The y axis points down, so that a positive angle is clockwise on the photograph.
    EXPECT_NEAR(turn, 2.0 * pi, 1e-6);
}

TEST(Contour, OfOnePixelIsAroundIt) {
    Mask mask(3, 3);
    mask.inside[mask.index(1, 1)] = 1;
    const Contour contour = trace::contour_of(mask, 0.0);
    ASSERT_EQ(contour.size(), 4U);
    for (const glm::dvec2& at : contour) EXPECT_NEAR(glm::length(at - glm::dvec2(1.5)), 0.5, 1e-9);
}

RC_GTEST_PROP(Contour, WalksAlongTheWholeBorderOfAPart, ()) {
    Mask noise(*rc::gen::inRange(2, 9), *rc::gen::inRange(2, 9));
    for (std::uint8_t& value : noise.inside)
        value = *rc::gen::elementOf(std::vector<std::uint8_t>{0, 1, 1});
    Mask seed(noise.width, noise.height);
    const std::size_t first = *rc::gen::inRange<std::size_t>(0, seed.inside.size());
    seed.inside[first] = noise.inside[first] = 1;
    const Mask part = trace::without_holes(trace::connected_with(noise, seed));
    std::size_t edges = 0;
    for (int y = 0; y < part.height; ++y)
        for (int x = 0; x < part.width; ++x)
            if (part.at(x, y))
                edges += (part.at(x - 1, y) ? 0 : 1) + (part.at(x + 1, y) ? 0 : 1) +
                         (part.at(x, y - 1) ? 0 : 1) + (part.at(x, y + 1) ? 0 : 1);
    RC_ASSERT(trace::contour_of(part, 0.0).size() == edges);
}

TEST(InsideOf, AContourAreThePixelsWhoseMiddlesItHasRoundThem) {
    const Contour triangle = {{1.0, 1.0}, {9.0, 1.0}, {1.0, 9.0}};
    const trace::Mask mask = trace::inside_of(triangle, {12, 10});
    EXPECT_EQ(mask.width, 12);
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 12; ++x)
            EXPECT_EQ(mask.at(x, y), x >= 1 && y >= 1 && x + y + 1 < 10) << x << ' ' << y;
    // What is beyond the picture is left out.
    const Contour large = {{-50.0, -50.0}, {90.0, -50.0}, {90.0, 90.0}, {-50.0, 90.0}};
    EXPECT_EQ(trace::inside_of(large, {12, 10}).area(), 120U);
    EXPECT_EQ(trace::inside_of({}, {12, 10}).area(), 0U);
}

RC_GTEST_PROP(InsideOf, TheContourOfAMaskIsTheMask, ()) {
    trace::Mask mask(20, 20);
    mask.inside[mask.index(10, 10)] = 1;
    for (int i = 0; i < 60; ++i) {
        const int x = *rc::gen::inRange(2, 18), y = *rc::gen::inRange(2, 18);
        mask.inside[mask.index(x, y)] = 1;
    }
    const trace::Mask part = trace::without_holes(trace::largest_part(mask));
    RC_ASSERT(trace::inside_of(trace::contour_of(part, 0.0), {20, 20}) == part);
}

TEST(ArcLengths, AddUpAlongALine) {
    EXPECT_EQ(trace::arc_lengths({{0.0, 0.0}, {3.0, 4.0}, {3.0, 4.0}, {3.0, 6.0}}),
              (std::vector<double>{0.0, 5.0, 5.0, 7.0}));
    EXPECT_EQ(trace::arc_lengths({{9.0, 9.0}}), std::vector<double>{0.0});
}

TEST(DistanceFromSegment, IsThatOfTheLineBetweenItsEndsAndOfTheEndsBeyond) {
    EXPECT_EQ(trace::distance_from_segment({2.0, 3.0}, {0.0, 0.0}, {10.0, 0.0}), 3.0);
    EXPECT_EQ(trace::distance_from_segment({-3.0, 4.0}, {0.0, 0.0}, {10.0, 0.0}), 5.0);
    EXPECT_EQ(trace::distance_from_segment({3.0, 4.0}, {0.0, 0.0}, {0.0, 0.0}), 5.0);
}

TEST(FirstHit, IsTheNearestOfTheEdgesAhead) {
    const Contour square = {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, {0.0, 10.0}};
    EXPECT_NEAR(trace::first_hit(square, {4.0, 5.0}, {1.0, 0.0}).value(), 6.0, 1e-12);
    EXPECT_NEAR(trace::first_hit(square, {-3.0, 5.0}, {1.0, 0.0}).value(), 3.0, 1e-12);
    EXPECT_FALSE(trace::first_hit(square, {-3.0, 5.0}, {-1.0, 0.0}).has_value());
    EXPECT_FALSE(trace::first_hit(square, {-3.0, 15.0}, {1.0, 0.0}).has_value());
}

}  // namespace
}  // namespace sporeprint::trace_contour_test
