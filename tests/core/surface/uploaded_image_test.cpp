#include "core/surface/uploaded_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "core/problems.h"
#include "core/surface/canvas.h"
#include "core/surface/codecs.h"
#include "tests/support/paintings.h"

namespace sporeprint::surface_uploaded_image_test {
namespace {

// Returns a cap seen from above: nine rays of uneven width, rotated by a number of turns.
Upload rays(double turns) {
    constexpr int side = 256;
    Bytes rgb;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double angle =
                std::atan2(y - 127.5, x - 127.5) / (2.0 * 3.14159265358979) - turns;
            const double share = angle - std::floor(angle);
            const double ray = std::sin(9.0 * 2.0 * 3.14159265 * share * share);
            rgb.push_back(static_cast<std::uint8_t>(130 + 90 * ray));
            rgb.push_back(static_cast<std::uint8_t>(100 + 60 * ray));
            rgb.push_back(60);
        }
    return uploaded(jpeg(rgb, side, side, 95, Chroma::full));
}

PaintParams with_cap(const Upload& image) {
    PaintParams params;
    params.side = 256;
    params.surface.cap.image = image;
    return params;
}

std::vector<ImageRotations> turns_of(const std::vector<PaintParams>& paintings,
                                     const std::vector<double>& weights) {
    std::vector<const PaintParams*> pointers;
    for (const PaintParams& one : paintings) pointers.push_back(&one);
    return aligned_rotations(pointers, weights);
}

TEST(UploadedImages, TheBestShiftIsTheAppliedOne) {
    std::vector<double> a;
    for (int i = 0; i < profile_samples; ++i)
        a.push_back(std::sin(0.1 * i) + (i % 37 == 0 ? 2.0 : 0.0) - 0.01 * i);
    for (const int shift : {0, 1, -1, 17, -100, 128}) {
        std::vector<double> b(a.size());
        for (int i = 0; i < profile_samples; ++i)
            b[static_cast<std::size_t>((i + shift + profile_samples) % profile_samples)] =
                a[static_cast<std::size_t>(i)];
        EXPECT_EQ(best_shift(a, b), shift);
    }
    const std::vector<double> plain(profile_samples, 0.0);
    EXPECT_EQ(best_shift(plain, a), 0);
    EXPECT_EQ(best_shift(plain, plain), 0);
}

TEST(UploadedImages, ProfilesOfARotatedImageAreShifted) {
    const Frame frame = chart_frames(256)[0];
    const auto profile = [&](double turns) {
        return angular_profile(uploaded_image(rays(turns), frame, ""), ChartMap::disc);
    };
    for (const double turns : {0.0, 0.125, -0.25, 0.4})
        EXPECT_NEAR(best_shift(profile(0.0), profile(turns)) / double{profile_samples}, turns,
                    1.0 / profile_samples);
    // Round the stem runs from top to bottom of its image.
    const auto stem = angular_profile(uploaded_image(rays(0.0), frame, ""), ChartMap::strip);
    ASSERT_EQ(stem.size(), std::size_t{profile_samples});
    double sum = 0.0;
    for (const double value : stem) sum += value;
    EXPECT_NEAR(sum, 0.0, 1e-9);
}

TEST(UploadedImages, ImagesOfAMixAreAlignedAndASingleOneIsUnchanged) {
    const std::vector<PaintParams> paintings = {with_cap(rays(0.0)), with_cap(rays(0.125)),
                                                PaintParams{}};
    for (const double t : {0.0, 0.25, 0.5, 1.0}) {
        const auto turns = turns_of(paintings, {0.5 * (1.0 - t), 0.5 * t, 0.5});
        EXPECT_NEAR(turns[1].cap - turns[0].cap, 0.125, 1.0 / profile_samples);
        EXPECT_NEAR(turns[0].cap, -0.125 * t, 1.0 / profile_samples);
        EXPECT_EQ(turns[2], ImageRotations{}) << "what is painted does not turn";
        EXPECT_EQ(turns[0].cap == 0.0, t == 0.0);
        EXPECT_EQ(turns[1].cap == 0.0, t == 1.0);
    }
    EXPECT_EQ(turns_of({with_cap(rays(0.3)), PaintParams{}}, {0.5, 0.5})[0], ImageRotations{})
        << "against nothing else";
}

TEST(UploadedImages, RotationAlignsTheRays) {
    const std::vector<PaintParams> paintings = {with_cap(rays(0.0)), with_cap(rays(0.2))};
    const auto turns = turns_of(paintings, {0.5, 0.5});
    const auto apart = [&](bool turned) {
        const RawImages a = paint_raw(paintings[0], in_turn, turned ? turns[0] : ImageRotations{});
        const RawImages b = paint_raw(paintings[1], in_turn, turned ? turns[1] : ImageRotations{});
        double sum = 0.0;
        for (int y = 24; y < 104; ++y)
            for (int x = 24; x < 104; ++x)
                sum += std::abs(texel(a, ImageKind::base_color, x, y).r -
                                texel(b, ImageKind::base_color, x, y).r);
        return sum / 6400.0;
    };
    EXPECT_LT(apart(true), 0.25 * apart(false));
}

TEST(UploadedImages, AStemIsRotatedAboutItsAxis) {
    PaintParams params;
    params.side = 256;
    Bytes rgb;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) rgb.insert(rgb.end(), 3, y < 32 ? 220 : 30);
    params.surface.stem.image = uploaded(jpeg(rgb, 64, 64, 95, Chroma::full));
    const RawImages plain = paint_raw(params);
    const RawImages half = paint_raw(params, in_turn, {.cap = 0.0, .hymenium = 0.0, .stem = 0.5});
    EXPECT_GT(texel(plain, ImageKind::base_color, 128, 150).r, 180);
    EXPECT_LT(texel(half, ImageKind::base_color, 128, 150).r, 60);
    EXPECT_GT(texel(half, ImageKind::base_color, 128, 200).r, 180);
    EXPECT_EQ(paint_raw(params, in_turn, {.cap = 0.3, .hymenium = 0.6, .stem = 1.0}).rgb,
              plain.rgb);
}

TEST(UploadedImages, AnUnreadableImageIsRefusedByItsPath) {
    PaintParams broken = with_cap(uploaded({1, 2, 3}));
    try {
        (void)turns_of({broken, broken}, {0.5, 0.5});
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.problems().at(0).path, "/surface/cap/image");
    }
}

}  // namespace
}  // namespace sporeprint::surface_uploaded_image_test
