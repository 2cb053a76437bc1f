#include "core/trace/hue.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace sporeprint::trace_hue_test {
namespace {

using trace::Pixel;

TEST(HueOf, HardlyChangesInShade) {
    for (const Pixel& pixel : {Pixel{220, 60, 40}, Pixel{200, 180, 120}, Pixel{90, 140, 200}}) {
        const Pixel shaded{static_cast<std::uint8_t>(pixel[0] / 3),
                           static_cast<std::uint8_t>(pixel[1] / 3),
                           static_cast<std::uint8_t>(pixel[2] / 3)};
        EXPECT_TRUE(trace::are_near(trace::hue_of(pixel), trace::hue_of(shaded), 1));
    }
    EXPECT_EQ(trace::hue_of({0, 0, 0}), trace::hue_of({255, 255, 255}));
    EXPECT_FALSE(trace::are_near(trace::hue_of({220, 60, 40}), trace::hue_of({90, 140, 200}), 5));
}

TEST(CommonestHue, IsThatOfMostLitPixels) {
    std::vector<Pixel> pixels(50, Pixel{200, 40, 30});
    pixels.insert(pixels.end(), 40, Pixel{240, 240, 235});
    pixels.insert(pixels.end(), 60, Pixel{12, 12, 12});  // outlines
    EXPECT_EQ(trace::commonest_hue(pixels), trace::hue_of({200, 40, 30}));
    pixels.insert(pixels.end(), 20, Pixel{240, 240, 235});
    EXPECT_EQ(trace::commonest_hue(pixels), trace::hue_of({240, 240, 235}));
    // None has that of grey.
    EXPECT_TRUE(trace::are_near(trace::commonest_hue({}), trace::hue_of({100, 100, 100}), 1));
}

TEST(CommonestHue, OfTwoColoursIsOneOfTheLarger) {
    // A red cap whose hue changes in the light, with pale spots that are all alike.
    const std::vector<Pixel> reds = {
        {250, 70, 50}, {240, 30, 30}, {230, 20, 80}, {180, 20, 120}, {250, 100, 60}};
    std::vector<Pixel> pixels;
    for (const Pixel& red : reds) pixels.insert(pixels.end(), 12, red);
    pixels.insert(pixels.end(), 40, Pixel{250, 220, 200});
    const trace::Hue pale = trace::hue_of({250, 220, 200});
    EXPECT_FALSE(trace::are_near(trace::commonest_hue(pixels), pale, 4));
    pixels.insert(pixels.end(), 40, Pixel{250, 220, 200});
    EXPECT_EQ(trace::commonest_hue(pixels), pale);
}

RC_GTEST_PROP(CommonestHue, IsThatOfOnePixel, ()) {
    Pixel pixel{};
    for (std::uint8_t& channel : pixel) channel = *rc::gen::arbitrary<std::uint8_t>();
    RC_ASSERT(trace::commonest_hue({pixel}) == trace::hue_of(pixel));
}

}  // namespace
}  // namespace sporeprint::trace_hue_test
