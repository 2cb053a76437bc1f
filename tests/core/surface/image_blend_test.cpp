#include "core/surface/image_blend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/grow/painting.h"
#include "core/math/elementary.h"
#include "core/math/noise.h"
#include "core/problems.h"
#include "core/surface/charts.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/orders.h"
#include "tests/support/paintings.h"

namespace sporeprint::surface_image_blend_test {
namespace {

// Returns uncorrelated paintings: other colours, patterns, patches and reliefs.
std::vector<RawImages> unlike(int side) {
    PaintParams red = motley(HymeniumPattern::gills, side);
    PaintParams brown = motley(HymeniumPattern::pores, side);
    brown.surface.cap.ramp = {{110, 70, 40}, {150, 105, 60}, {215, 190, 160}};
    brown.surface.cap.streaks = 0.0;
    brown.surface.cap.zones = 0.0;
    brown.surface.cap.patches = 0.0;
    brown.surface.cap.veins = 0.0;
    brown.surface.stem.top = {190, 150, 110};
    brown.surface.stem.net = 0.9;
    brown.ornaments.warts = 0.0;
    brown.surface.hymenium.colour = {230, 220, 140};
    PaintParams pale = motley(HymeniumPattern::ridges, side);
    pale.surface.cap.ramp = {{240, 236, 228}, {235, 215, 190}, {220, 170, 140}};
    pale.surface.cap.veins = 0.0;
    pale.ornaments.scales = 0.0;
    pale.surface.stem.bands = 0.0;
    pale.weathering.fade = 0.0;
    return {paint_raw(red), paint_raw(brown), paint_raw(pale)};
}

RawImages blend_of(const std::vector<RawImages>& paintings, const std::vector<double>& weights,
                   const Parallel& parallel = in_turn) {
    std::vector<const RawImages*> pointers;
    for (const RawImages& one : paintings) pointers.push_back(&one);
    return blend_raw(pointers, weights, parallel);
}

struct Steps {
    double mean = 0.0;
    int most = 0;
};

Steps steps_between(const RawImages& a, const RawImages& b, std::size_t image) {
    Steps steps;
    for (std::size_t k = 0; k < a.rgb[image].size(); ++k) {
        const int step = std::abs(int{a.rgb[image][k]} - int{b.rgb[image][k]});
        steps.mean += step;
        steps.most = std::max(steps.most, step);
    }
    steps.mean /= static_cast<double>(a.rgb[image].size());
    return steps;
}

// Returns the numbers of one chart: `channel` of `image`, colours in linear light; on a disc only
// texels of the disc.
std::vector<double> numbers(const RawImages& painting, std::size_t part, ImageKind kind,
                            std::size_t channel) {
    const Chart& chart = swept_charts[part];
    const int side = painting.side;
    const int x0 = static_cast<int>(chart.u * side), y0 = static_cast<int>(chart.v * side);
    const int width = static_cast<int>(chart.width * side);
    const int height = static_cast<int>(chart.height * side);
    std::vector<double> out;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double dx = (x + 0.5) / width - 0.5, dy = (y + 0.5) / height - 0.5;
            if (chart.map == ChartMap::disc && dx * dx + dy * dy > 0.22) continue;
            const Texel t = texel(painting, kind, x0 + x, y0 + y);
            const int byte = channel == 0 ? t.r : channel == 1 ? t.g : t.b;
            out.push_back(kind == ImageKind::base_color ? srgb_to_linear(byte / 255.0)
                                                        : byte / 255.0);
        }
    return out;
}

// Returns the RMS difference of the texels of a chart from the mean of the surrounding 16 x 16,
// over all channels.
double detail_of(const RawImages& painting, std::size_t part, ImageKind kind) {
    const Chart& chart = swept_charts[part];
    const int side = painting.side;
    const int x0 = static_cast<int>(chart.u * side), y0 = static_cast<int>(chart.v * side);
    const int width = static_cast<int>(chart.width * side);
    const int height = static_cast<int>(chart.height * side);
    double sum = 0.0;
    int cells = 0;
    for (int j = 0; j + 16 <= height; j += 16)
        for (int i = 0; i + 16 <= width; i += 16) {
            const double dx = (i + 8.0) / width - 0.5, dy = (j + 8.0) / height - 0.5;
            if (chart.map == ChartMap::disc && dx * dx + dy * dy > 0.16) continue;
            ++cells;
            for (int c = 0; c < 3; ++c) {
                double first = 0.0, second = 0.0;
                for (int y = 0; y < 16; ++y)
                    for (int x = 0; x < 16; ++x) {
                        const Texel t = texel(painting, kind, x0 + i + x, y0 + j + y);
                        const int byte = c == 0 ? t.r : c == 1 ? t.g : t.b;
                        const double value = kind == ImageKind::base_color
                                                 ? srgb_to_linear(byte / 255.0)
                                                 : byte / 255.0;
                        first += value;
                        second += value * value;
                    }
                sum += second / 256.0 - first * first / 65536.0;
            }
        }
    return std::sqrt(sum / cells);
}

double mean_of(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

double deviation_of(const std::vector<double>& values) {
    const double mean = mean_of(values);
    double sum = 0.0;
    for (const double value : values) sum += (value - mean) * (value - mean);
    return std::sqrt(sum / static_cast<double>(values.size()));
}

class ImageBlend : public ::testing::Test {
  protected:
    void TearDown() override { force_simd("auto"); }
};

TEST_F(ImageBlend, WeightOneIsThatPaintingByteForByte) {
    for (const int side : {16, 128}) {
        const std::vector<RawImages> paintings = unlike(side);
        for (std::size_t i = 0; i < 3; ++i) {
            std::vector<double> weights(3, 0.0);
            weights[i] = 1.0;
            EXPECT_EQ(blend_of(paintings, weights).rgb, paintings[i].rgb);
            EXPECT_EQ(blend_of({paintings[i]}, {1.0}).rgb, paintings[i].rgb);
        }
    }
}

TEST_F(ImageBlend, EqualPaintingsBlendToThemselves) {
    const RawImages painting = unlike(256)[0];
    for (const std::size_t count : {std::size_t{2}, std::size_t{9}}) {
        const std::vector<double> weights(count, 1.0 / static_cast<double>(count));
        const RawImages same = blend_of(std::vector<RawImages>(count, painting), weights);
        EXPECT_EQ(same.rgb[0], painting.rgb[0]);
        EXPECT_EQ(same.rgb[2], painting.rgb[2]);
        // Normals in bytes are not exactly unit vectors; steep ones are rounded most.
        EXPECT_LE(steps_between(same, painting, 1).most, 3);
        EXPECT_LT(steps_between(same, painting, 1).mean, 0.15);
    }
}

TEST_F(ImageBlend, TheOrderOfPaintingsDoesNotMatter) {
    const std::vector<RawImages> p = unlike(128);
    EXPECT_EQ(blend_of({p[0], p[1]}, {0.375, 0.625}).rgb,
              blend_of({p[1], p[0]}, {0.625, 0.375}).rgb);
    const RawImages there = blend_of({p[0], p[1], p[2]}, {0.25, 0.5, 0.25});
    const RawImages back = blend_of({p[2], p[1], p[0]}, {0.25, 0.5, 0.25});
    for (std::size_t image = 0; image < 3; ++image)
        EXPECT_LE(steps_between(there, back, image).most, 1);
}

TEST_F(ImageBlend, KeepsTheContrastOfEveryChart) {
    const std::vector<RawImages> p = unlike(256);
    for (std::size_t other = 1; other < 3; ++other) {
        const RawImages half = blend_of({p[0], p[other]}, {0.5, 0.5});
        for (std::size_t part = 0; part < part_count; ++part)
            for (const ImageKind kind : {ImageKind::base_color, ImageKind::normal})
                for (std::size_t channel = 0; channel < 2; ++channel) {
                    const double a = deviation_of(numbers(p[0], part, kind, channel));
                    const double b = deviation_of(numbers(p[other], part, kind, channel));
                    const double found = deviation_of(numbers(half, part, kind, channel));
                    EXPECT_GE(found, 0.8 * 0.5 * (a + b))
                        << part << ' ' << name(kind) << ' ' << channel << ' ' << a << ' ' << b;
                }
    }
}

TEST_F(ImageBlend, MeanColoursAreLinearInTheWeights) {
    const std::vector<RawImages> p = unlike(256);
    for (const std::vector<double>& w : std::vector<std::vector<double>>{
             {0.5, 0.5, 0.0}, {0.25, 0.25, 0.5}, {0.125, 0.75, 0.125}, {0.015625, 0.0, 0.984375}}) {
        const RawImages mixed = blend_of(p, w);
        for (std::size_t part = 0; part < part_count; ++part)
            for (std::size_t channel = 0; channel < 3; ++channel) {
                double expected = 0.0;
                for (std::size_t i = 0; i < 3; ++i)
                    expected += w[i] * mean_of(numbers(p[i], part, ImageKind::base_color, channel));
                // Contrast is limited more on the side that has less room: by a hundredth at most.
                EXPECT_NEAR(mean_of(numbers(mixed, part, ImageKind::base_color, channel)), expected,
                            0.012)
                    << part << ' ' << channel;
            }
    }
}

TEST_F(ImageBlend, NoColourLeavesTheRangeOfThePaintings) {
    const std::vector<RawImages> p = unlike(256);
    const RawImages mixed = blend_of(p, {0.3125, 0.4375, 0.25});
    for (const std::size_t image : {std::size_t{0}, std::size_t{2}})
        for (std::size_t k = 0; k < mixed.rgb[image].size(); ++k) {
            const auto [least, most] =
                std::minmax({p[0].rgb[image][k], p[1].rgb[image][k], p[2].rgb[image][k]});
            ASSERT_GE(mixed.rgb[image][k] + 1, least);
            ASSERT_LE(mixed.rgb[image][k], most + 1);
        }
}

TEST_F(ImageBlend, ASixtyFourthIsASmallStep) {
    const std::vector<RawImages> p = unlike(128);
    for (std::size_t other = 1; other < 3; ++other) {
        RawImages last = blend_of({p[0], p[other]}, {1.0, 0.0});
        for (int k = 1; k <= 64; ++k) {
            const double t = k / 64.0;
            RawImages next = blend_of({p[0], p[other]}, {1.0 - t, t});
            for (std::size_t image = 0; image < 3; ++image) {
                const Steps steps = steps_between(last, next, image);
                EXPECT_LT(steps.mean, 2.5) << k << ' ' << image;
                // The first step away from black is the largest that sRGB bytes can show.
                EXPECT_LE(steps.most, 40) << k << ' ' << image;
            }
            last = std::move(next);
        }
    }
}

TEST_F(ImageBlend, GivesEqualBytesWithEveryInstructionSetAndNumberOfThreads) {
    for (const int side : {16, 32, 64, 128, 512}) {
        const std::vector<RawImages> p = unlike(side);
        const std::vector<double> weights = {0.296875, 0.21875, 0.484375};
        const RawImages expected = expect_equal_with_every_instruction_set(
            [&] { return blend_of(p, weights); }, std::to_string(side));
        EXPECT_TRUE(blend_of(p, weights, all_at_once).rgb == expected.rgb) << side;
    }
}

TEST_F(ImageBlend, NormalsAreUnitVectorsThatPointOutwards) {
    const RawImages mixed = blend_of(unlike(256), {0.25, 0.25, 0.5});
    for (int y = 0; y < mixed.side; ++y)
        for (int x = 0; x < mixed.side; ++x) {
            const Texel n = texel(mixed, ImageKind::normal, x, y);
            const double nx = n.r / 127.5 - 1.0, ny = n.g / 127.5 - 1.0, nz = n.b / 127.5 - 1.0;
            ASSERT_NEAR(nx * nx + ny * ny + nz * nz, 1.0, 0.03);
            ASSERT_GT(nz, 0.0);
        }
    for (std::size_t i = 2; i < mixed.rgb[2].size(); i += 3) ASSERT_EQ(mixed.rgb[2][i], 0);
}

TEST_F(ImageBlend, ChartsDoNotBleedIntoEachOther) {
    // Only the caps differ; the other charts are unchanged.
    PaintParams params = motley(HymeniumPattern::gills, 128);
    const RawImages a = paint_raw(params);
    params.surface.cap.ramp = {{20, 60, 200}, {20, 60, 200}, {20, 60, 200}};
    const RawImages b = paint_raw(params);
    const RawImages mixed = blend_of({a, b}, {0.5, 0.5});
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 128; ++x) {
            if (x < 64 && y < 64) continue;
            const Texel before = texel(a, ImageKind::base_color, x, y);
            const Texel after = texel(mixed, ImageKind::base_color, x, y);
            ASSERT_EQ(before.r, after.r);
            ASSERT_EQ(before.g, after.g);
            ASSERT_EQ(before.b, after.b);
        }
}

TEST_F(ImageBlend, WartsShrinkWithTheirWeightAndKeepTheirColour) {
    // White warts on red, blended with the same cap without any.
    PaintParams warty;
    warty.seed = 7;
    warty.side = 256;
    warty.surface.cap.ramp = {{150, 20, 20}, {150, 20, 20}};
    warty.surface.veil.colour = warty.surface.veil.tip = {245, 240, 230};
    warty.warts.count = 40;
    warty.warts.size = 0.12;
    warty.ornaments.warts = 1.0;
    const PaintParams bare = without_patches(warty);
    const RawImages whole_size = paint_raw(warty), plain = paint_raw(bare);
    const RawImages* const paintings[] = {&plain, &plain};
    const PaintParams* const laid[] = {&warty, &bare};
    const auto at = [&](double weight) {
        const double weights[] = {weight, 1.0 - weight};
        return blend_raw(paintings, weights, in_turn, laid);
    };
    const auto white = [](const RawImages& images) {
        int count = 0;
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 128; ++x)
                if (texel(images, ImageKind::base_color, x, y).g > 190) ++count;
        return count;
    };
    const int all = white(whole_size);
    ASSERT_GT(all, 1000);
    EXPECT_NEAR(white(at(0.5)), 0.25 * all, 0.08 * all) << "half as large, as white";
    EXPECT_NEAR(white(at(0.75)), 0.5625 * all, 0.1 * all);
    EXPECT_EQ(at(0.0).rgb, plain.rgb);
    // At weight 1 it equals the result of paint(), except for rounding.
    const RawImages whole = at(1.0);
    for (std::size_t image = 0; image < 3; ++image) {
        EXPECT_LT(steps_between(whole, whole_size, image).mean, 0.3) << image;
        EXPECT_LE(steps_between(whole, whole_size, image).most, 24) << image;
    }
    int last = all;
    for (int k = 63; k >= 0; --k) {
        const int now = white(at(k / 64.0));
        EXPECT_LE(now, last + 12) << k;
        EXPECT_GE(now, last - all / 16) << k;
        last = now;
    }
    const double halves[] = {0.5, 0.5};
    const RawImages here = at(0.5);
    for (const std::string& name : simd_names()) {
        force_simd(name);
        EXPECT_TRUE(blend_raw(paintings, halves, all_at_once, laid).rgb == here.rgb) << name;
    }
    force_simd("auto");
    EXPECT_THROW((void)blend_raw(paintings, halves, in_turn, std::span(laid, 1)), InvalidInput);
}

TEST_F(ImageBlend, PairsOfRealSpeciesKeepTheirContrast) {
    // Each species with the next one of the atlas, and with a distant one.
    const std::vector<std::string> ids = swept_ids();
    const auto raw_of = [&](std::size_t i) {
        const MushroomSpec order = painted(order_of(ids[i % ids.size()]), 256);
        return paint_raw(without_patches(paint_spec_of(order, atlas()).at(0).painting));
    };
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const RawImages a = raw_of(i);
        for (const std::size_t apart : {std::size_t{1}, ids.size() / 2}) {
            const RawImages b = raw_of(i + apart);
            const RawImages half = blend_of({a, b}, {0.5, 0.5});
            for (std::size_t part = 0; part < 3; ++part)
                for (const ImageKind kind : {ImageKind::base_color, ImageKind::normal}) {
                    const double own = 0.5 * (detail_of(a, part, kind) + detail_of(b, part, kind));
                    const double found = detail_of(half, part, kind);
                    // A chart that is almost uniform in both has no contrast to keep.
                    EXPECT_GE(found, 0.5 * own - 0.002)
                        << ids[i] << ' ' << ids[(i + apart) % ids.size()] << ' ' << part << ' '
                        << name(kind);
                    EXPECT_LE(found, 1.3 * own + 0.002)
                        << ids[i] << ' ' << ids[(i + apart) % ids.size()] << ' ' << part << ' '
                        << name(kind);
                }
        }
    }
}

TEST_F(ImageBlend, EncodesTheBlendedImages) {
    const std::vector<RawImages> p = unlike(64);
    const RawImages* const pointers[] = {&p[0], &p[1]};
    const double weights[] = {0.25, 0.75};
    const ImageSet once = blend_images(pointers, weights);
    const ImageSet again = blend_images(pointers, weights, all_at_once);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_GT(once.files[i].size, 200U);
        EXPECT_TRUE(*once.files[i].owner == *again.files[i].owner);
    }
    const double corner[] = {0.0, 1.0};
    const PaintParams alone = motley(HymeniumPattern::gills, 64);
    const RawImages raw = paint_raw(alone);
    const RawImages* const other[] = {&p[1], &raw};
    const ImageSet painted = paint(alone), found = blend_images(other, corner);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_TRUE(*painted.files[i].owner == *found.files[i].owner);
}

TEST_F(ImageBlend, RefusesInvalidInput) {
    const std::vector<RawImages> p = unlike(64);
    const RawImages small = unlike(32)[0];
    const auto refuses = [](const std::vector<const RawImages*>& paintings,
                            const std::vector<double>& weights) {
        EXPECT_THROW((void)blend_raw(paintings, weights), InvalidInput);
        EXPECT_THROW((void)blend_images(paintings, weights), InvalidInput);
    };
    refuses({}, {});
    refuses({&p[0]}, {});
    refuses({&p[0], &p[1]}, {1.0});
    refuses({&p[0], &p[1]}, {0.5, 0.6});
    refuses({&p[0], &p[1]}, {1.5, -0.5});
    refuses({&p[0], &p[1]}, {std::numeric_limits<double>::quiet_NaN(), 1.0});
    refuses({&p[0], &p[1]}, {std::numeric_limits<double>::infinity(), 0.0});
    refuses({&p[0], nullptr}, {0.5, 0.5});
    refuses({&p[0], &small}, {0.5, 0.5});
    refuses(std::vector<const RawImages*>(10, &p[0]), std::vector<double>(10, 0.1));
    RawImages cut = p[0];
    cut.rgb[2].pop_back();
    refuses({&p[0], &cut}, {0.5, 0.5});
    RawImages odd = p[0];
    odd.side = 63;
    refuses({&odd}, {1.0});
    odd.side = -64;
    refuses({&odd}, {1.0});
}

}  // namespace
}  // namespace sporeprint::surface_image_blend_test
