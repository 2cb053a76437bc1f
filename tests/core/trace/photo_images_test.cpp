#include "core/trace/photo_images.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"
#include "tests/support/drawn_mushroom.h"

namespace sporeprint::trace_photo_images_test {
namespace {

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
