#include "core/trace/photo_file.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "core/surface/codecs.h"
#include "tests/support/refusals.h"

namespace sporeprint::trace_photo_file_test {
namespace {

TEST(PhotoFile, ThatIsTransparentInPartsIsItsOwnMask) {
    Bytes rgba;
    for (int i = 0; i < 40 * 40; ++i) {
        const bool inside = i % 40 >= 10 && i % 40 < 30 && i >= 40 && i < 39 * 40;
        rgba.insert(rgba.end(), {200, 30, 30, static_cast<std::uint8_t>(inside ? 255 : 0)});
    }
    {
        const trace::PhotoFile photo = trace::decoded_photo(png(rgba, 40, 40), "/photo");
        ASSERT_TRUE(photo.cut_out.has_value());
        EXPECT_EQ(photo.cut_out->area(), 760U);
        EXPECT_TRUE(photo.cut_out->at(10, 5));
        EXPECT_FALSE(photo.cut_out->at(9, 5));
        // What is transparent is white paper.
        EXPECT_EQ(photo.picture.rgb[0], 255);
        EXPECT_EQ(photo.picture.rgb[3 * (40 + 15)], 200);
    }
    for (std::size_t i = 3; i < rgba.size(); i += 4) rgba[i] = 255;
    EXPECT_FALSE(trace::decoded_photo(png(rgba, 40, 40), "/photo").cut_out.has_value());
}

TEST(PhotoFile, IsMadeSmallerWithItsMask) {
    constexpr int side = 2600, edge = 100;
    Bytes rgba(std::size_t{4} * side * side, 90);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const bool inside = x >= edge && x < side / 2 && y >= edge && y < side - edge;
            rgba[4 * (static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x)) + 3] =
                inside ? 255 : 0;
        }
    const trace::PhotoFile photo = trace::decoded_photo(png(rgba, side, side), "/photo");
    EXPECT_EQ(photo.picture.width, trace::decoded_side);
    ASSERT_TRUE(photo.cut_out.has_value());
    EXPECT_EQ(photo.cut_out->width, trace::decoded_side);
    constexpr double scale = static_cast<double>(trace::decoded_side) / side;
    EXPECT_NEAR(static_cast<double>(photo.cut_out->area()),
                scale * scale * (0.5 * side - edge) * (side - 2 * edge), 3000.0);
}

TEST(PhotoFile, ThatIsCutOutAndFillsItsFileGetsABorder) {
    // A disc that touches all four borders.
    constexpr int side = 200;
    Bytes rgba;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double u = x - 99.5, v = y - 99.5;
            const bool inside = u * u + v * v <= 100.0 * 100.0;
            rgba.insert(rgba.end(), {200, 30, 30, static_cast<std::uint8_t>(inside ? 255 : 0)});
        }
    const trace::PhotoFile photo = trace::decoded_photo(png(rgba, side, side), "/photo");
    ASSERT_TRUE(photo.cut_out.has_value());
    EXPECT_EQ(photo.picture.width, 212);
    EXPECT_EQ(photo.cut_out->height, 212);
    EXPECT_NEAR(static_cast<double>(photo.cut_out->area()), 31416.0, 60.0);
    EXPECT_FALSE(photo.cut_out->at(5, 106));
    EXPECT_TRUE(photo.cut_out->at(6, 106));
    EXPECT_EQ(photo.picture.rgb[0], 255);
    EXPECT_EQ(photo.picture.rgb[3 * (106 * 212 + 8)], 200);
}

TEST(PhotoFile, RefusesWhatIsNoPhotograph) {
    EXPECT_TRUE(names(refusal([] {
                          static_cast<void>(trace::decoded_photo(Bytes{'G', 'I', 'F'}, "/photo"));
                      }),
                      "/photo", "neither a JPEG"));
}

}  // namespace
}  // namespace sporeprint::trace_photo_file_test
