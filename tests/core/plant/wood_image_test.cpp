#include "core/plant/wood_image.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "tests/support/refusals.h"

namespace sporeprint::plant_wood_image_test {
namespace {

constexpr int side = 128;

/// Returns the mean colour of rows, 0..255.
std::array<double, 3> mean_of(const RawImages& images, double from, double to) {
    std::array<double, 3> sum{};
    const auto first = static_cast<std::size_t>(from * side),
               last = static_cast<std::size_t>(to * side);
    for (std::size_t i = first * side; i < last * side; ++i)
        for (std::size_t k = 0; k < 3; ++k) sum[k] += images.rgb[0][3 * i + k];
    for (double& value : sum) value /= static_cast<double>((last - first) * side);
    return sum;
}

TEST(WoodImage, EveryKindHasItsOwnBarkAndGrain) {
    std::set<Bytes> different;
    for (const Substrate wood : all_woods) {
        const RawImages images = wood_images({wood, {side}});
        EXPECT_EQ(images.rgb, wood_images({wood, {side}}).rgb);
        different.insert(images.rgb[0]);
        const auto grain = mean_of(images, wood_end_rim + 0.03, wood_end_middle);
        EXPECT_GT(grain[0], grain[1]) << name(wood) << ": wood is brown";
        EXPECT_GT(grain[1], grain[2]) << name(wood);
    }
    EXPECT_EQ(different.size(), all_woods.size());
    const auto birch = mean_of(wood_images({Substrate::birch, {side}}), 0.0, wood_bark_end),
               oak = mean_of(wood_images({Substrate::oak, {side}}), 0.0, wood_bark_end);
    EXPECT_GT(birch[0], 1.8 * oak[0]) << "the bark of birches is white";
}

TEST(WoodImage, WrapsRoundThePiece) {
    const RawImages images = wood_images({Substrate::poplar, {side}});
    const auto difference = [&](std::size_t column, std::size_t other) {
        double sum = 0.0;
        for (std::size_t y = 0; y < side; ++y)
            sum += std::abs(static_cast<double>(images.rgb[0][3 * (y * side + column)]) -
                            static_cast<double>(images.rgb[0][3 * (y * side + other)]));
        return sum / side;
    };
    double inside = 0.0;
    for (std::size_t x = 1; x < side; ++x) inside = std::max(inside, difference(x - 1, x));
    EXPECT_LE(difference(side - 1, 0), 1.2 * inside);
}

TEST(WoodImage, NormalsOfEndsAreNearlyUnitVectors) {
    const RawImages images = wood_images({Substrate::beech, {side}});
    for (std::size_t i = static_cast<std::size_t>(0.78 * side) * side; i < side * side; ++i) {
        const glm::dvec3 normal = 2.0 *
                                      glm::dvec3(images.rgb[1][3 * i], images.rgb[1][3 * i + 1],
                                                 images.rgb[1][3 * i + 2]) /
                                      255.0 -
                                  1.0;
        EXPECT_NEAR(glm::length(normal), 1.0, 0.1);
        EXPECT_EQ(images.rgb[2][3 * i + 2], 0) << "no metal";
    }
}

TEST(WoodImage, OfNothingIsRefused) {
    EXPECT_TRUE(names(refusal([] {
                          (void)wood_images({Substrate::none, {side}});
                      }),
                      "/substrate", "no wood"));
}

}  // namespace
}  // namespace sporeprint::plant_wood_image_test
