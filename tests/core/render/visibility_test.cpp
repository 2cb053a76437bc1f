#include "core/render/visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/math/random.h"

namespace sporeprint::render::render_visibility_test {
namespace {

constexpr int side = 24;

/// Returns a square of two triangles that covers all samples, clockwise with y down.
std::vector<SnappedCorner> whole(float nearness) {
    constexpr float far = side;
    return {snapped({0.0F, 0.0F, nearness}), snapped({0.0F, far, nearness}),
            snapped({far, far, nearness}), snapped({far, 0.0F, nearness})};
}

const std::vector<std::uint32_t> square = {0, 1, 2, 0, 2, 3};

TEST(Visibility, TheNearestTriangleIsShownWhateverTheOrder) {
    for (const bool near_first : {true, false}) {
        Visibility found(side, side);
        EXPECT_FALSE(found.shows(0));
        found.show(near_first ? 1 : 0, square, whole(near_first ? 2.0F : 1.0F), 0, side);
        found.show(near_first ? 0 : 1, square, whole(near_first ? 1.0F : 2.0F), 0, side);
        for (std::size_t i = 0; i < found.draw.size(); ++i) {
            EXPECT_TRUE(found.shows(i));
            EXPECT_EQ(found.draw[i], 1U);
            EXPECT_NEAR(found.nearness[i], 2.0F, 1e-5F);
        }
    }
}

TEST(Visibility, OfEquallyNearTrianglesTheFirstStays) {
    Visibility found(side, side);
    found.show(3, square, whole(1.0F), 0, side);
    found.show(4, square, whole(1.0F), 0, side);
    EXPECT_EQ(std::count(found.draw.begin(), found.draw.end(), 3U), side * side);
    EXPECT_EQ(std::count(found.corner.begin(), found.corner.end(), 0U) +
                  std::count(found.corner.begin(), found.corner.end(), 3U),
              side * side)
        << "each sample shows one of its two triangles";
}

TEST(Visibility, BandsAreTheWhole) {
    Random random(3, 0);
    Visibility at_once(side, side), in_bands(side, side);
    for (std::uint32_t draw = 0; draw < 40; ++draw) {
        std::vector<SnappedCorner> corners;
        for (int i = 0; i < 3; ++i) {
            const double x = random.uniform(0.0, side), y = random.uniform(0.0, side),
                         near = random.uniform(-1.0, 1.0);
            corners.push_back(
                snapped({static_cast<float>(x), static_cast<float>(y), static_cast<float>(near)}));
        }
        const std::vector<std::uint32_t> both_sides = {0, 1, 2, 0, 2, 1};
        at_once.show(draw, both_sides, corners, 0, side);
        for (const auto& [from, to] : {std::pair{10, side}, {0, 3}, {3, 10}})
            in_bands.show(draw, both_sides, corners, from, to);
    }
    EXPECT_EQ(at_once.nearness, in_bands.nearness);
    EXPECT_EQ(at_once.draw, in_bands.draw);
    EXPECT_EQ(at_once.corner, in_bands.corner);
    const std::size_t shown = static_cast<std::size_t>(
        std::count_if(at_once.nearness.begin(), at_once.nearness.end(),
                      [](float near) { return near > Visibility::nothing; }));
    EXPECT_GT(shown, at_once.nearness.size() / 2);
}

}  // namespace
}  // namespace sporeprint::render::render_visibility_test
