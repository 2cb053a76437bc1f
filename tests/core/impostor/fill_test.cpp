#include "core/impostor/fill.h"

#include <gtest/gtest.h>

namespace sporeprint::impostor_fill_test {
namespace {

FilledTexel grey(float value, float coverage = 1.0F) {
    return {glm::vec3(value), glm::vec3(0.0F, 0.0F, 1.0F), value, value, coverage};
}

TEST(Fill, OneColourIsContinuedEverywhere) {
    for (const int side : {1, 2, 7, 40}) {
        FilledFrame frame(side);
        frame.texel(side / 2, side / 3) = grey(0.25F, 0.5F);
        frame.fill();
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const FilledTexel& texel = frame.texel(x, y);
                EXPECT_NEAR(texel.colour.y, 0.25F, 1e-6F);
                EXPECT_NEAR(texel.normal.z, 1.0F, 1e-6F);
                EXPECT_NEAR(texel.depth, 0.25F, 1e-6F);
                const bool is_own = x == side / 2 && y == side / 3;
                EXPECT_EQ(texel.coverage, is_own ? 0.5F : 0.0F);
            }
    }
}

TEST(Fill, TexelsThatShowSomethingKeepTheirColour) {
    FilledFrame frame(8);
    for (int x = 0; x < 4; ++x) frame.texel(x, 3) = grey(0.2F * static_cast<float>(x), 0.25F);
    frame.fill();
    for (int x = 0; x < 4; ++x) EXPECT_EQ(frame.texel(x, 3).colour.x, 0.2F * static_cast<float>(x));
}

TEST(Fill, BetweenTwoColoursItIsNearTheNearerOne) {
    FilledFrame frame(16);
    for (int y = 0; y < 16; ++y) {
        frame.texel(0, y) = grey(0.0F);
        frame.texel(15, y) = grey(1.0F);
    }
    frame.fill();
    EXPECT_LT(frame.texel(2, 8).colour.x, 0.2F);
    EXPECT_GT(frame.texel(13, 8).colour.x, 0.8F);
    for (int x = 1; x < 16; ++x)
        EXPECT_GE(frame.texel(x, 8).colour.x, frame.texel(x - 1, 8).colour.x - 1e-6F);
}

TEST(Fill, AnEmptyFrameStaysEmpty) {
    FilledFrame frame(9);
    frame.fill();
    EXPECT_EQ(frame.texel(4, 4).colour, glm::vec3(0.0F));
    EXPECT_EQ(frame.texel(4, 4).coverage, 0.0F);
}

}  // namespace
}  // namespace sporeprint::impostor_fill_test
