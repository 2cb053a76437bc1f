#include "core/trace/photo_images.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"
#include "tests/support/drawn_mushroom.h"

namespace sporeprint::trace_photo_images_test {
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

/// A drawn mushroom with a red cap, lit from the right, and a grey stem.
struct Painted {
    DrawnMushroom drawn;
    trace::Mask mask = drawn.mask();
    trace::Traced traced = trace::traced(mask, drawn.gesture(), {.height_m = 0.1});
    Picture picture{drawn.side, drawn.side, {}};

    Painted() {
        const glm::dvec2 foot = drawn.foot();
        for (int y = 0; y < drawn.side; ++y)
            for (int x = 0; x < drawn.side; ++x) {
                const bool is_cap = (foot.y - y) / drawn.pixels > drawn.stem_top;
                const double half = drawn.pixels * (is_cap ? drawn.cap_radius : drawn.stem_radius);
                const double side = std::clamp((x - foot.x) / half, -1.0, 1.0);
                const double shade = 0.75 + 0.25 * side;
                const glm::dvec3 rgb = !mask.at(x, y) ? glm::dvec3(30.0, 140.0, 30.0)
                                       : is_cap       ? shade * glm::dvec3(210.0, 50.0, 40.0)
                                                      : shade * glm::dvec3(200.0, 200.0, 190.0);
                for (int c = 0; c < 3; ++c)
                    picture.rgb.push_back(static_cast<std::uint8_t>(rgb[c]));
            }
    }
};

/// Returns the mean of a channel round a disc or a strip at a place along the part.
double mean_round(const Picture& picture, bool is_disc, double along, double from, double to,
                  std::size_t channel) {
    double sum = 0.0;
    constexpr int samples = 60;
    for (int i = 0; i < samples; ++i) {
        const double share = from + (to - from) * (i + 0.5) / samples;
        const double u = is_disc ? 0.5 + 0.5 * along * std::cos(2.0 * pi * share) : along,
                     v = is_disc ? 0.5 + 0.5 * along * std::sin(2.0 * pi * share) : share;
        const auto x = static_cast<std::size_t>(u * picture.width),
                   y = static_cast<std::size_t>(v * picture.height);
        sum += picture.rgb[3 * (y * static_cast<std::size_t>(picture.width) + x) + channel];
    }
    return sum / samples;
}

TEST(PhotoImages, HaveTheColoursOfTheirPartsWithoutShade) {
    const Painted painted;
    const trace::PhotoImages images =
        trace::photo_images(painted.picture, painted.mask, painted.traced, 0.1);
    ASSERT_TRUE(images.cap && images.stem);
    for (const double along : {0.3, 0.6, 0.85}) {
        // Red, and not the green of the background.
        EXPECT_GT(mean_round(*images.cap, true, along, 0.0, 1.0, 0), 120.0) << along;
        EXPECT_LT(mean_round(*images.cap, true, along, 0.0, 1.0, 1), 70.0) << along;
        EXPECT_NEAR(mean_round(*images.stem, false, along, 0.0, 1.0, 0),
                    mean_round(*images.stem, false, along, 0.0, 1.0, 1), 8.0);
        // No side is darker than another, which the photograph's left one is.
        for (const Picture* picture : {&*images.cap, &*images.stem}) {
            const bool is_disc = picture == &*images.cap;
            for (const double from : {0.0, 0.25, 0.5, 0.75})
                EXPECT_NEAR(mean_round(*picture, is_disc, along, from, from + 0.25, 0),
                            mean_round(*picture, is_disc, along, 0.0, 1.0, 0), 6.0)
                    << along << from;
        }
    }
}

TEST(PhotoImages, CloseRoundTheMushroom) {
    const Painted painted;
    const trace::PhotoImages images =
        trace::photo_images(painted.picture, painted.mask, painted.traced, 0.1);
    ASSERT_TRUE(images.stem);
    const Picture& stem = *images.stem;
    const auto row = static_cast<std::size_t>(3 * stem.width);
    for (std::size_t i = 0; i < row; ++i)
        EXPECT_NEAR(stem.rgb[i], stem.rgb[stem.rgb.size() - row + i], 10.0);
}

TEST(PhotoImages, HaveNoCapOfWhichTheMaskShowsTooLittle) {
    Painted painted;
    // A hand before the cap.
    for (int y = 0; y < painted.drawn.side; ++y)
        for (int x = 0; x < painted.drawn.side; ++x)
            if (y < painted.drawn.foot().y - 0.7 * painted.drawn.pixels &&
                x > painted.drawn.foot().x - 0.2 * painted.drawn.pixels)
                painted.mask.inside[painted.mask.index(x, y)] = 0;
    const trace::PhotoImages images =
        trace::photo_images(painted.picture, painted.mask, painted.traced, 0.1);
    EXPECT_FALSE(images.cap.has_value());
    EXPECT_TRUE(images.stem.has_value());
}

}  // namespace
}  // namespace sporeprint::trace_photo_images_test
