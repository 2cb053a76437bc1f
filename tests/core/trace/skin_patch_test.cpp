#include "core/trace/skin_patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/math/elementary.h"

namespace sporeprint::trace_skin_patch_test {
namespace {

using trace::SkinPatch;

SkinPatch patch(std::size_t rows, std::size_t columns) {
    SkinPatch made;
    made.rows = rows;
    made.columns = columns;
    made.reach = 1.0;
    made.light.assign(rows * columns, glm::dvec3(0.0));
    made.is_seen.assign(rows * columns, true);
    return made;
}

TEST(Unshade, DividesByTheShadeOfACylinder) {
    for (const bool has_depth : {false, true}) {
        SkinPatch skin = patch(40, 60);
        for (std::size_t row = 0; row < skin.rows; ++row)
            for (std::size_t column = 0; column < skin.columns; ++column) {
                const double angle = skin.angle(column);
                const double shade =
                    0.7 + 0.3 * std::sin(angle) + (has_depth ? 0.4 * (std::cos(angle) - 0.8) : 0.0);
                // Colours along the part are its own.
                skin.light[row * skin.columns + column] =
                    shade * glm::dvec3(0.5, 0.3, 0.1) * (row < 20 ? 1.0 : 0.5);
            }
        trace::unshade(skin, has_depth);
        for (const std::size_t row : {3U, 33U}) {
            double least = 1e9, most = 0.0;
            for (std::size_t column = 0; column < skin.columns; ++column) {
                const double light = skin.light[row * skin.columns + column].x;
                least = std::min(least, light);
                most = std::max(most, light);
            }
            EXPECT_LT(most / least, 1.01) << has_depth << row;
        }
        EXPECT_NEAR(skin.light[33 * skin.columns].x / skin.light[3 * skin.columns].x, 0.5, 1e-6);
    }
}

TEST(Unshade, LeavesSpotsThatAreNoShade) {
    SkinPatch skin = patch(40, 60);
    for (std::size_t i = 0; i < skin.light.size(); ++i)
        skin.light[i] = glm::dvec3(i % 60 < 6 ? 1.0 : 0.4);  // a pale stripe at the left edge
    trace::unshade(skin, false);
    EXPECT_GT(skin.light[3].x / skin.light[40].x, 1.8);
}

TEST(Fill, GoesOnSmoothlyAndKeepsWhatIsSeen) {
    SkinPatch skin = patch(33, 47);
    for (std::size_t row = 0; row < skin.rows; ++row)
        for (std::size_t column = 0; column < skin.columns; ++column) {
            const std::size_t i = row * skin.columns + column;
            skin.light[i] = glm::dvec3(0.2 + 0.01 * static_cast<double>(column));
            const bool is_hole = row > 8 && row < 24 && column > 10 && column < 30;
            if (!is_hole) continue;
            skin.is_seen[i] = false;
            skin.light[i] = glm::dvec3(9.0);
        }
    const SkinPatch before = skin;
    trace::fill(skin);
    for (std::size_t i = 0; i < skin.light.size(); ++i) {
        EXPECT_TRUE(skin.is_seen[i]);
        if (before.is_seen[i]) {
            EXPECT_EQ(skin.light[i], before.light[i]);
        } else {
            // Between what is to the left and to the right of the hole.
            EXPECT_GT(skin.light[i].x, 0.25);
            EXPECT_LT(skin.light[i].x, 0.55);
        }
    }
}

TEST(Fill, OfNothingSeenIsDark) {
    SkinPatch skin = patch(5, 4);
    skin.is_seen.assign(20, false);
    skin.light.assign(20, glm::dvec3(0.7));
    trace::fill(skin);
    for (const glm::dvec3& light : skin.light) EXPECT_EQ(light, glm::dvec3(0.0));
}

TEST(Unshade, DividesByTheShadeOfADomeLitFromOneSide) {
    // A square with a disc in it, whose colour changes from ring to ring.
    constexpr std::size_t side = 64, rows = 8;
    SkinPatch skin = patch(side, side);
    std::vector<trace::ShadePlace> places(side * side);
    const auto colour = [](std::size_t row) { return 0.2 + 0.05 * static_cast<double>(row); };
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::size_t column = i % side, row = i / side;
        const double x = (static_cast<double>(column) + 0.5) / (0.5 * side) - 1.0,
                     y = (static_cast<double>(row) + 0.5) / (0.5 * side) - 1.0;
        const double radius = std::sqrt(x * x + y * y);
        if (radius > 1.0) continue;
        places[i] = {static_cast<std::size_t>(radius * rows * 0.999), {x, y}};
        skin.light[i] = glm::dvec3((1.0 + 0.3 * x - 0.2 * y) * colour(places[i].row));
    }
    trace::unshade(skin, places, rows);
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (places[i].row == trace::ShadePlace::nowhere || places[i].row == 0) continue;
        EXPECT_NEAR(skin.light[i].x / skin.light[side * side / 2 + side - 2].x,
                    colour(places[i].row) / colour(rows - 1), 0.03)
            << i;
    }
}

TEST(ShowsEnough, CountsTheTexelsOfThePart) {
    SkinPatch skin = patch(10, 10);
    for (std::size_t i = 0; i < 70; ++i) skin.is_seen[i] = false;
    EXPECT_FALSE(trace::shows_enough(skin, 100));
    EXPECT_TRUE(trace::shows_enough(skin, 60));
}

TEST(PhotoLight, IsLinearBetweenPixelsAndThatOfTheBorderBeyondIt) {
    const Picture picture{2, 2, {0, 0, 0, 255, 255, 255, 0, 0, 0, 255, 255, 255}};
    const trace::PhotoLight light(picture);
    EXPECT_NEAR(light.at({1.0, 1.0}).x, 0.5, 1e-9);
    EXPECT_NEAR(light.at({-5.0, 1.0}).x, 0.0, 1e-9);
    EXPECT_NEAR(light.at({9.0, 9.0}).x, 1.0, 2e-3);
    EXPECT_EQ(light.pixel({1.5, 0.5}), (trace::Pixel{255, 255, 255}));
}

}  // namespace
}  // namespace sporeprint::trace_skin_patch_test
