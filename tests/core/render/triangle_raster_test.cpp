#include "core/render/triangle_raster.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <vector>

#include "tests/support/draws.h"

namespace sporeprint::render::render_triangle_raster_test {
namespace {

constexpr int side = 64;

/// Adds one to each pixel of a triangle.
void add(std::vector<int>& pixels, const Corner& a, const Corner& b, const Corner& c) {
    rasterize(snapped(a), snapped(b), snapped(c), side, side,
              [&](int x, int y, float) { ++pixels.at(static_cast<std::size_t>(y * side + x)); });
}

int sum(const std::vector<int>& pixels) {
    int total = 0;
    for (const int pixel : pixels) total += pixel;
    return total;
}

TEST(TriangleRaster, ASquareOfTwoTrianglesHasEachOfItsPixelsOnce) {
    std::vector<int> pixels(side * side, 0);
    const Corner a{8, 8}, b{40, 8}, c{40, 24}, d{8, 24};
    add(pixels, a, d, c);
    add(pixels, a, c, b);
    EXPECT_EQ(sum(pixels), 32 * 16);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            ASSERT_EQ(pixels[static_cast<std::size_t>(y * side + x)],
                      x >= 8 && x < 40 && y >= 8 && y < 24 ? 1 : 0)
                << x << ' ' << y;
}

TEST(TriangleRaster, BandsOfRowsHaveThePixelsOfTheWholeOnceEach) {
    std::vector<int> whole(side * side, 0), banded(side * side, 0);
    const Corner a{-3, 5}, b{30, 61}, c{60, 9};
    add(whole, a, b, c);
    for (const int from : {0, 16, 17, 48})
        rasterize(
            snapped(a), snapped(b), snapped(c), side,
            from == 0    ? 16
            : from == 16 ? 17
            : from == 17 ? 48
                         : side,
            [&](int x, int y, float) { ++banded.at(static_cast<std::size_t>(y * side + x)); },
            from);
    EXPECT_GT(sum(whole), 1000);
    EXPECT_EQ(whole, banded);
}

TEST(TriangleRaster, WhatFacesAwayOrHasNoAreaIsLeftOut) {
    std::vector<int> pixels(side * side, 0);
    add(pixels, {8, 8}, {40, 8}, {40, 24});
    add(pixels, {8, 8}, {24, 24}, {40, 40});
    add(pixels, {8, 8}, {8, 8}, {40, 40});
    EXPECT_EQ(sum(pixels), 0);
}

TEST(TriangleRaster, DepthIsLinear) {
    const auto depth = [](float x, float y) { return 3.0F + 0.25F * x - 0.5F * y; };
    const auto corner = [&](float x, float y) { return Corner{x, y, depth(x, y)}; };
    int count = 0;
    rasterize(snapped(corner(2, 3)), snapped(corner(20, 60)), snapped(corner(55, 11)), side, side,
              [&](int x, int y, float found) {
                  ++count;
                  ASSERT_NEAR(found,
                              depth(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F),
                              1e-4);
              });
    EXPECT_GT(count, 500);
}

RC_GTEST_PROP(TriangleRaster, AFanAroundAPointHasEachPixelOfItsPolygonOnce, ()) {
    // A convex polygon around a point: triangles share edges, and no pixel is in two of them.
    const auto coordinate = [] {
        return static_cast<float>(*rc::gen::inRange(0, 16 * side)) / 16.0F;
    };
    const Corner corners[] = {{0, 0}, {0, side}, {side, side}, {side, 0}};
    const Corner centre{coordinate(), coordinate()};
    std::vector<int> pixels(side * side, 0);
    for (int i = 0; i < 4; ++i) add(pixels, centre, corners[i], corners[(i + 1) % 4]);
    for (const int pixel : pixels) RC_ASSERT(pixel == 1);
}

RC_GTEST_PROP(TriangleRaster, CornersBeyondTheImageAreNoHarm, ()) {
    const auto any = [] {
        return *rc::gen::element(-1e9F, -5.0F, 0.0F, 17.3F, 64.0F, 2048.0F, 1e9F);
    };
    std::vector<int> pixels(side * side, 0);
    const Corner a{any(), any()}, b{any(), any()}, c{any(), any()};
    add(pixels, a, b, c);
    RC_ASSERT(sum(pixels) <= side * side);
}

}  // namespace
}  // namespace sporeprint::render::render_triangle_raster_test
