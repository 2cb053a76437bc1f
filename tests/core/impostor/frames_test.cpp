#include "core/impostor/frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace sporeprint::impostor_frames_test {
namespace {

constexpr int last = frame_grid - 1;

TEST(Frames, APlaceIsThatOfItsDirection) {
    for (int row = 0; row <= 40; ++row)
        for (int column = 0; column <= 40; ++column) {
            const glm::vec2 place(static_cast<float>(column) / 40.0F,
                                  static_cast<float>(row) / 40.0F);
            const glm::vec3 direction = direction_at(place);
            EXPECT_NEAR(glm::length(direction), 1.0F, 1e-6F);
            EXPECT_GE(direction.y, 0.0F);
            EXPECT_LT(glm::distance(place_of(direction), place), 1e-6F);
            EXPECT_LT(glm::distance(place_of(7.0F * direction), place), 1e-6F);
        }
}

TEST(Frames, TheMiddleIsSeenFromAboveAndTheBorderFromTheSide) {
    EXPECT_EQ(direction_at({0.5F, 0.5F}), glm::vec3(0.0F, 1.0F, 0.0F));
    EXPECT_EQ(direction_at({0.0F, 1.0F}), glm::vec3(0.0F, 0.0F, 1.0F));
    EXPECT_EQ(direction_at({1.0F, 1.0F}), glm::vec3(1.0F, 0.0F, 0.0F));
    for (int i = 0; i <= last; ++i)
        for (const FrameCell cell :
             {FrameCell{i, 0}, FrameCell{i, last}, FrameCell{0, i}, FrameCell{last, i}})
            EXPECT_EQ(axes_of(cell).toward.y, 0.0F);
}

TEST(Frames, ADirectionBelowTheHorizonHasThePlaceOfItsAzimuth) {
    EXPECT_LT(glm::distance(place_of({1.0F, -3.0F, 2.0F}), place_of({1.0F, 0.0F, 2.0F})), 1e-6F);
    EXPECT_EQ(place_of({0.0F, -1.0F, 0.0F}), glm::vec2(0.5F));
}

TEST(Frames, AxesAreRightHandedWithUpTowardsTheSky) {
    for (int row = 0; row < frame_grid; ++row)
        for (int column = 0; column < frame_grid; ++column) {
            const FrameAxes axes = axes_of(FrameCell{column, row});
            EXPECT_LT(glm::distance(glm::cross(axes.right, axes.up), axes.toward), 1e-6F);
            EXPECT_NEAR(glm::length(axes.right), 1.0F, 1e-6F);
            EXPECT_NEAR(axes.right.y, 0.0F, 1e-6F) << "a level horizon";
            EXPECT_GE(axes.up.y, 0.0F);
        }
    EXPECT_EQ(axes_of(FrameCell{0, last}).right, glm::vec3(1.0F, 0.0F, 0.0F));
    EXPECT_EQ(axes_of(FrameCell{last / 2, last / 2}).up, glm::vec3(0.0F, 0.0F, -1.0F));
}

TEST(Frames, AVectorIsSeenInTheAxesOfItsFrame) {
    const FrameAxes axes = axes_of(FrameCell{last, last});  // from +X
    EXPECT_EQ(axes.seen({1.0F, 2.0F, 3.0F}), glm::vec3(-3.0F, 2.0F, 1.0F));
}

}  // namespace
}  // namespace sporeprint::impostor_frames_test
