#include "core/render/texture.h"

#include <gtest/gtest.h>

#include "core/problems.h"
#include "core/surface/codecs.h"

namespace sporeprint::render::render_texture_test {
namespace {

/// Returns a JPEG of the best quality whose left half is of one grey and whose right of another.
Bytes halves(int width, int height, std::uint8_t left, std::uint8_t right) {
    Bytes rgb;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) rgb.insert(rgb.end(), 3, x < width / 2 ? left : right);
    return jpeg(rgb, width, height, 100, Chroma::full);
}

TEST(Texture, AnEvenImageIsEvenAtEveryDistance) {
    const Texture texture(halves(256, 256, 102, 102), Encoding::linear, false);
    for (const float texels : {0.01F, 1.0F, 3.0F, 1000.0F})
        for (const glm::vec2& at : {glm::vec2(0), glm::vec2(0.5F), glm::vec2(1), glm::vec2(-9, 7)})
            EXPECT_NEAR(texture.at(at, texels).y, 0.4F, 1e-3F);
}

TEST(Texture, SrgbIsDecodedToLinearLight) {
    const Bytes file = halves(64, 64, 188, 188);
    EXPECT_NEAR(Texture(file, Encoding::srgb, false).at({0.5F, 0.5F}, 1).x, 0.5F, 0.005F);
    EXPECT_NEAR(Texture(file, Encoding::linear, false).at({0.5F, 0.5F}, 1).x, 188.0F / 255.0F,
                1e-3F);
}

TEST(Texture, HalvesMeetInTheMiddleAndWhereTheImageRepeats) {
    const Bytes file = halves(64, 64, 0, 255);
    const Texture clamped(file, Encoding::linear, false), repeated(file, Encoding::linear, true);
    EXPECT_NEAR(clamped.at({0.25F, 0.5F}, 1).x, 0.0F, 0.01F);
    EXPECT_NEAR(clamped.at({0.5F, 0.5F}, 1).x, 0.5F, 0.01F);
    EXPECT_NEAR(clamped.at({1.0F, 0.5F}, 1).x, 1.0F, 0.01F);
    EXPECT_NEAR(repeated.at({1.0F, 0.5F}, 1).x, 0.5F, 0.01F) << "between the last and the first";
    EXPECT_NEAR(repeated.at({7.25F, 0.5F}, 1).x, 0.0F, 0.01F);
    EXPECT_NEAR(repeated.at({-0.25F, 0.5F}, 1).x, 1.0F, 0.01F);
}

TEST(Texture, AnImageThatIsNotSquareIsRefused) {
    EXPECT_THROW(Texture(halves(64, 32, 0, 0), Encoding::linear, false), GenerationError);
}

}  // namespace
}  // namespace sporeprint::render::render_texture_test
