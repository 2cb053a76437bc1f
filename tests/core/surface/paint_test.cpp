#include "core/surface/paint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/math/noise.h"
#include "core/math/purposes.h"
#include "core/problems.h"
#include "core/surface/charts.h"
#include "core/surface/codecs.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/paintings.h"

namespace sporeprint::surface_paint_test {
namespace {

constexpr HymeniumPattern all_patterns[] = {HymeniumPattern::smooth, HymeniumPattern::gills,
                                            HymeniumPattern::ridges, HymeniumPattern::pores};

// Returns the mean difference of two atlases in levels of 255, over all images.
double difference(const RawImages& a, const RawImages& b) {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        count += a.rgb[i].size();
        for (std::size_t k = 0; k < a.rgb[i].size(); ++k)
            sum += std::abs(static_cast<int>(a.rgb[i][k]) - static_cast<int>(b.rgb[i][k]));
    }
    return sum / static_cast<double>(count);
}

// Visits every number below a described struct: visit(path, info, number).
template <class T, class Visit>
void for_each_number(T& value, const std::string& path, const Visit& visit) {
    T::fields([&](auto member, const Info& info) {
        auto& sub = value.*member;
        using Sub = std::remove_cvref_t<decltype(sub)>;
        const std::string name = path + "/" + info.name;
        if constexpr (Described<Sub>)
            for_each_number(sub, name, visit);
        else if constexpr (Number<Sub>)
            visit(name, info, sub);
    });
}

template <class T, class Visit>
void for_each_colour(T& value, const std::string& path, const Visit& visit) {
    T::fields([&](auto member, const Info& info) {
        auto& sub = value.*member;
        using Sub = std::remove_cvref_t<decltype(sub)>;
        const std::string name = path + "/" + info.name;
        if constexpr (Described<Sub>)
            for_each_colour(sub, name, visit);
        else if constexpr (std::is_same_v<Sub, Colour>)
            visit(name, sub);
    });
}

TEST(Paint, GivesEqualBytesWithEveryInstructionSet) {
    for (const HymeniumPattern pattern : all_patterns) {
        for (const int side : {16, 128, 512}) {
            if (side == 512 && pattern != HymeniumPattern::gills) continue;
            PaintParams params = motley(pattern, side);
            params.gill_layout = side == 128 ? 23 : side == 16 ? 64 : 0;
            expect_equal_with_every_instruction_set([&] { return paint_raw(params); },
                                                    std::to_string(side));
        }
    }
}

TEST(Paint, GivesEqualFilesForAnyNumberOfThreads) {
    const PaintParams params = motley(HymeniumPattern::gills);
    const ImageSet alone = paint(params);
    const ImageSet again = paint(params);
    const ImageSet shared = paint(params, all_at_once);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_TRUE(*alone.files[i].owner == *again.files[i].owner);
        EXPECT_TRUE(*alone.files[i].owner == *shared.files[i].owner);
    }
}

TEST(Paint, WritesThreeJpegFilesOfTheAtlas) {
    for (const int side : {16, 64, 256}) {
        const ImageSet files = paint(motley(HymeniumPattern::pores, side));
        for (const Slice& file : files.files) {
            const Picture picture = decoded_picture({file.data(), file.size}, "/image");
            EXPECT_EQ(picture.width, side);
            EXPECT_EQ(picture.height, side);
        }
    }
}

TEST(Paint, RefusesASideThatIsNoPowerOfTwo) {
    for (const int side : {0, 8, 100, 4096}) {
        PaintParams params;
        params.side = side;
        EXPECT_THROW((void)paint(params), InvalidInput) << side;
    }
}

TEST(Paint, WithoutReliefTheNormalsAreFlat) {
    PaintParams params;
    params.side = 256;
    params.surface.cap.bumps = params.surface.cap.skin.strength = 0.0;
    params.surface.stem.bumps = params.surface.stem.skin.strength = 0.0;
    params.surface.stem.fibrils = params.surface.stem.soil = params.surface.stem.mycelium = 0.0;
    const RawImages images = paint_raw(params);
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 128; ++x) {
            const Texel normal = texel(images, ImageKind::normal, x, y);
            ASSERT_NEAR(normal.r, 128, 1);
            ASSERT_NEAR(normal.g, 128, 1);
            ASSERT_NEAR(normal.b, 255, 1);
        }
    for (int y = 128; y < 224; ++y)
        for (int x = 0; x < 256; ++x) {
            const Texel normal = texel(images, ImageKind::normal, x, y);
            ASSERT_NEAR(normal.r, 128, 1);
            ASSERT_NEAR(normal.g, 128, 1);
            ASSERT_NEAR(normal.b, 255, 1);
        }
}

TEST(Paint, NormalsAreUnitVectorsThatPointOutwards) {
    const RawImages images = paint_raw(motley(HymeniumPattern::gills));
    for (int y = 0; y < images.side; ++y)
        for (int x = 0; x < images.side; ++x) {
            const Texel n = texel(images, ImageKind::normal, x, y);
            const double nx = n.r / 127.5 - 1.0, ny = n.g / 127.5 - 1.0, nz = n.b / 127.5 - 1.0;
            ASSERT_NEAR(nx * nx + ny * ny + nz * nz, 1.0, 0.03);
            ASSERT_GE(nz, -0.01);
        }
}

TEST(Paint, NormalsOfABumpPointAwayFromItsCentre) {
    // One large wart: to its right the normal points right, above it (smaller v) the normal points
    // up.
    PaintParams params;
    params.side = 512;
    params.surface.cap.bumps = 0.0;
    params.warts.count = 1;
    params.warts.size = 0.3;
    params.warts.height = 2.0;
    params.ornaments.warts = 1.0;
    const Patch wart = patches(params.warts, params.seed, purposes::warts).at(0);
    const RawImages images = paint_raw(params);
    const TexturePoint middle =
        disc_point(swept_charts[0], wart.sigma, std::cos(wart.theta), std::sin(wart.theta));
    const int cx = static_cast<int>(middle.u * 512.0), cy = static_cast<int>(middle.v * 512.0);
    const int reach = static_cast<int>(0.8 * wart.radius * 0.47 * 256.0);
    double right = 0.0, up = 0.0;
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x) {
            if (cx + x < 0 || cx + x >= 256 || cy + y < 0 || cy + y >= 256) continue;
            const Texel n = texel(images, ImageKind::normal, cx + x, cy + y);
            right += (n.r - 128) * x;
            up -= (n.g - 128) * y;
        }
    EXPECT_GT(right, 0.0);
    EXPECT_GT(up, 0.0);
}

TEST(Paint, FrayedScalesCoverLessAndAreRagged) {
    PaintParams params;
    params.seed = 4;
    params.side = 512;
    params.scales = {.count = 60, .size = 0.12, .height = 0.2, .elongation = 2.0};
    params.ornaments.scales = 1.0;
    params.surface.cap.ramp = {{255, 255, 255}};
    params.surface.veil.colour = params.surface.veil.tip = {0, 0, 0};
    // How dark the cap is, and how much that changes along its rows.
    const auto dark = [&](double fray, int count) {
        params.scales.fray = fray;
        params.scales.count = count;
        const RawImages images = paint_raw(params);
        double sum = 0.0, changes = 0.0;
        for (int y = 0; y < 256; ++y)
            for (int x = 1; x < 256; ++x) {
                const int here = texel(images, ImageKind::base_color, x, y).r;
                sum += 255 - here;
                changes += std::abs(here - texel(images, ImageKind::base_color, x - 1, y).r);
            }
        return std::pair(sum, changes);
    };
    const auto [bare, plain] = dark(0.0, 0);
    const auto [flaps, outlines] = dark(0.0, 60);
    const auto [hairs, ends] = dark(1.0, 60);
    EXPECT_GT(hairs - bare, 0.1 * (flaps - bare)) << "they are dark";
    EXPECT_LT(hairs - bare, 0.9 * (flaps - bare));
    EXPECT_GT((ends - plain) / (hairs - bare), 1.25 * (outlines - plain) / (flaps - bare))
        << "more edges for what they cover";
}

TEST(Paint, FallenSpinesLeaveMarksAndFallenWartsNone) {
    PaintParams params;
    params.seed = 4;
    params.side = 512;
    params.warts = {.count = 60, .size = 0.09};
    params.surface.cap.ramp = {{255, 255, 255}};
    params.surface.veil.colour = params.surface.veil.tip = {0, 0, 0};
    const auto dark = [&](double height, double amount) {
        params.warts.height = height;
        params.ornaments.warts = amount;
        const RawImages images = paint_raw(params);
        double sum = 0.0;
        for (int y = 0; y < 256; ++y)
            for (int x = 0; x < 256; ++x) sum += 255 - texel(images, ImageKind::base_color, x, y).r;
        return sum;
    };
    const double bare = dark(0.5, 0.0);
    EXPECT_EQ(dark(1.6, 0.0), bare) << "without any veil there is no trace of it";
    const double warts = dark(0.5, 0.15) - bare, marks = dark(1.6, 0.15) - bare;
    EXPECT_GT(marks, 2.0 * warts) << "most have fallen";
    EXPECT_LT(marks, dark(1.6, 1.0) - bare) << "but marks are paler than what stood there";
}

TEST(Paint, FeltAndCracksDarkenASmoothLowerFaceAndRoughenItsRelief) {
    PaintParams params;
    params.seed = 4;
    params.side = 512;
    params.surface.hymenium.pattern = HymeniumPattern::smooth;
    params.surface.hymenium.mottle = 0.0;
    params.surface.hymenium.colour = params.surface.hymenium.edge = {220, 200, 180};
    params.surface.hymenium.depth = {60, 40, 20};
    struct Look {
        double light = 0.0, slope = 0.0;
    };
    const auto look = [&](double felt, double cracks) {
        params.surface.hymenium.felt = felt;
        params.surface.hymenium.cracks = cracks;
        const RawImages images = paint_raw(params);
        Look sum;
        for (int y = 0; y < 256; ++y)
            for (int x = 256; x < 512; ++x) {
                sum.light += texel(images, ImageKind::base_color, x, y).r;
                sum.slope += 255 - texel(images, ImageKind::normal, x, y).b;
            }
        return sum;
    };
    const Look smooth = look(0.0, 0.0);
    for (const Look& rough : {look(1.0, 0.0), look(0.0, 1.0)}) {
        EXPECT_LT(rough.light, 0.995 * smooth.light);
        EXPECT_GT(rough.light, 0.5 * smooth.light);
        EXPECT_GT(rough.slope, 1.2 * smooth.slope);
    }
}

TEST(Paint, OrmHasNoMetal) {
    const RawImages images = paint_raw(motley(HymeniumPattern::ridges));
    for (std::size_t i = 2; i < images.rgb[2].size(); i += 3) ASSERT_EQ(images.rgb[2][i], 0);
}

/// Returns the same with damage, without which its colours do not show.
PaintParams worn(HymeniumPattern pattern) {
    PaintParams params = motley(pattern);
    params.metrics.radial_strain = 8;
    params.weathering.cracks = 0.5;
    params.weathering.peel = 0.5;
    params.weathering.bruise = 0.5;
    params.weathering.dust = 0.3;
    return params;
}

TEST(Paint, EveryNumberChangesTheImages) {
    std::vector<RawImages> before;
    for (const HymeniumPattern pattern : all_patterns) before.push_back(paint_raw(worn(pattern)));
    PaintParams walked = worn(HymeniumPattern::smooth);
    std::vector<std::string> names;
    for_each_number(walked, "",
                    [&](const std::string& name, const Info&, auto&) { names.push_back(name); });
    for (const std::string& wanted : names) {
        if (wanted == "/side") continue;
        // Parameters that only shape blades, and rows of spines that this pattern does not show.
        const auto shapes = {"/hymenium/inner_depth", "/hymenium/notch", "/hymenium/edge_waves",
                             "/cells/rows",           "/cells/from",     "/cells/grow"};
        if (std::find(shapes.begin(), shapes.end(), wanted) != shapes.end()) continue;
        bool changed = false;
        for (std::size_t p = 0; p < 4 && !changed; ++p) {
            PaintParams params = worn(all_patterns[p]);
            for_each_number(
                params, "", [&](const std::string& name, const Info& info, auto& number) {
                    if (name != wanted) return;
                    using N = std::remove_cvref_t<decltype(number)>;
                    const double now = static_cast<double>(number);
                    const bool rises = now < 0.5 * (info.min + info.max);
                    if constexpr (std::is_integral_v<N>)
                        number = static_cast<N>(now + (wanted.starts_with("/metrics") ? 20.0
                                                       : now < info.max               ? 1.0
                                                                                      : -1.0));
                    else
                        number =
                            rises ? now + 0.3 * (info.max - now) : now - 0.3 * (now - info.min);
                });
            changed = difference(before[p], paint_raw(params)) > 1e-3;
        }
        EXPECT_TRUE(changed) << wanted;
    }
}

TEST(Paint, EveryColourChangesTheImages) {
    std::vector<RawImages> before;
    for (const HymeniumPattern pattern : all_patterns) before.push_back(paint_raw(worn(pattern)));
    PaintParams walked = worn(HymeniumPattern::smooth);
    std::vector<std::string> names;
    for_each_colour(walked, "", [&](const std::string& name, Colour&) { names.push_back(name); });
    EXPECT_EQ(names.size(), 20U);
    for (const std::string& wanted : names) {
        bool changed = false;
        for (std::size_t p = 0; p < 4 && !changed; ++p) {
            PaintParams params = worn(all_patterns[p]);
            for_each_colour(params, "", [&](const std::string& name, Colour& colour) {
                if (name == wanted) colour = Colour{20, 200, 240};
            });
            changed = difference(before[p], paint_raw(params)) > 0.02;
        }
        EXPECT_TRUE(changed) << wanted;
    }
}

TEST(Paint, ASmallChangeOfANumberIsASmallChangeOfTheImages) {
    for (const HymeniumPattern pattern : {HymeniumPattern::gills, HymeniumPattern::ridges}) {
        const PaintParams start = motley(pattern);
        const RawImages before = paint_raw(start);
        PaintParams walked = start;
        std::vector<std::string> names;
        for_each_number(walked, "", [&](const std::string& name, const Info&, auto& number) {
            if constexpr (std::is_floating_point_v<std::remove_cvref_t<decltype(number)>>)
                names.push_back(name);
        });
        for (const std::string& wanted : names) {
            PaintParams params = start;
            for_each_number(params, "",
                            [&](const std::string& name, const Info& info, auto& number) {
                                using N = std::remove_cvref_t<decltype(number)>;
                                if (name == wanted)
                                    number = static_cast<N>(static_cast<double>(number) +
                                                            0.0005 * (info.max - info.min));
                            });
            EXPECT_LT(difference(before, paint_raw(params)), 0.5) << wanted;
        }
    }
}

TEST(Paint, TheRampRunsFromApexToMargin) {
    PaintParams params;
    params.side = 512;
    params.surface.cap.ramp = {{255, 0, 0}, {0, 0, 255}};
    params.surface.cap.ramp_noise = params.surface.cap.colour_drift = 0.0;
    const RawImages images = paint_raw(params);
    const Texel apex = texel(images, ImageKind::base_color, 128, 128);
    const Texel margin = texel(images, ImageKind::base_color, 247, 128);
    EXPECT_GT(apex.r, 230);
    EXPECT_LT(apex.b, 40);
    EXPECT_GT(margin.b, 230);
    EXPECT_LT(margin.r, 40);
}

TEST(Paint, BladesUseFaceAndEdgeColoursAndFleshItsOwn) {
    PaintParams params;
    params.side = 256;
    params.surface.hymenium.colour = {0, 180, 0};
    params.surface.hymenium.edge = {255, 0, 0};
    params.surface.hymenium.depth = {0, 0, 255};
    params.surface.hymenium.mottle = 0.0;
    params.surface.flesh.colour = {250, 200, 90};
    const RawImages images = paint_raw(params);
    const auto look = [&](Part part, ImageKind kind, double along, double across) {
        const TexturePoint at =
            strip_point(swept_charts[static_cast<std::size_t>(part)], along, across);
        return texel(images, kind, static_cast<int>(at.u * 256.0), static_cast<int>(at.v * 256.0));
    };
    for (const double along : {0.1, 0.5, 0.9}) {
        EXPECT_GT(look(Part::blade, ImageKind::base_color, along, 0.7).g, 120);
        EXPECT_GT(look(Part::blade, ImageKind::base_color, along, 0.99).r, 200);
        EXPECT_GT(look(Part::blade, ImageKind::base_color, along, 0.0).b,
                  look(Part::blade, ImageKind::base_color, along, 0.7).b);
        EXPECT_LT(look(Part::blade, ImageKind::orm, along, 0.05).r,
                  look(Part::blade, ImageKind::orm, along, 0.8).r);
        const Texel flesh = look(Part::flesh, ImageKind::base_color, along, 0.5);
        // Between fresh and dry, and browner where it is drier.
        EXPECT_GE(flesh.r, 185);
        EXPECT_LE(flesh.r, 255);
        EXPECT_GE(flesh.g, 130);
        EXPECT_LE(flesh.g, 210);
        EXPECT_GE(flesh.b, 40);
        EXPECT_LE(flesh.b, 100);
    }
}

TEST(Paint, TheStemClosesWithoutASeam) {
    // The image is continuous round the stem: the step across the seam is no larger than its
    // neighbours.
    PaintParams params = motley(HymeniumPattern::gills, 512);
    const RawImages images = paint_raw(params);
    const Chart& chart = swept_charts[2];
    const double top = chart.v * 512.0, height = chart.height * 512.0;
    const int first = static_cast<int>(std::ceil(top + height * chart.inset - 0.5));
    const int rows = static_cast<int>(height * (1.0 - 2.0 * chart.inset));
    const auto step = [&](int a, int b) {
        double sum = 0.0;
        for (int x = 20; x < 492; ++x) {
            const Texel p = texel(images, ImageKind::base_color, x, a);
            const Texel q = texel(images, ImageKind::base_color, x, b);
            sum += std::abs(p.r - q.r) + std::abs(p.g - q.g) + std::abs(p.b - q.b);
        }
        return sum / 472.0;
    };
    double usual = 0.0;
    for (int y = first; y < first + rows; ++y) usual = std::max(usual, step(y, y + 1));
    EXPECT_LE(step(first + rows - 1, first), 2.0 * usual);
    // Beyond the seam the strip continues with its other end.
    EXPECT_LE(step(first - 2, first - 2 + rows), 2.0 * usual);
}

TEST(Paint, SoilAndFeltClingToTheFootOfTheStemAlone) {
    PaintParams params = motley(HymeniumPattern::gills, 512);
    params.surface.stem.top = params.surface.stem.base = {200, 60, 60};
    params.surface.stem.base_stain = params.surface.stem.net = params.surface.stem.bands = 0.0;
    params.metrics.stem_foot = quantised_length(0.01);  // a tenth of the stem
    params.surface.stem.soil = params.surface.stem.mycelium = 0.0;
    const RawImages clean = paint_raw(params);
    params.surface.stem.soil = 1.0;
    const RawImages dirty = paint_raw(params);
    params.surface.stem.soil = 0.0;
    params.surface.stem.mycelium = 1.0;
    const RawImages felted = paint_raw(params);
    const Chart& stem = swept_charts[static_cast<std::size_t>(Part::stem)];
    const auto mean_green = [&](const RawImages& images, double along) {
        double sum = 0.0;
        for (int i = 0; i < 200; ++i) {
            const TexturePoint at = strip_point(stem, along, i / 200.0);
            sum += texel(images, ImageKind::base_color, static_cast<int>(at.u * 512.0),
                         static_cast<int>(at.v * 512.0))
                       .g;
        }
        return sum / 200.0;
    };
    // Below the ground the stem has the colour of soil, which is less green than 60 of 255, and
    // its felt, where there is no soil, nearly that of felt.
    EXPECT_NEAR(mean_green(dirty, 0.03), params.surface.stem.soil_colour.g, 12.0);
    EXPECT_GT(mean_green(felted, 0.12), mean_green(clean, 0.12) + 50.0);
    // Soil thins out upwards, and ends within four half diameters.
    EXPECT_LT(mean_green(dirty, 0.12), mean_green(dirty, 0.25));
    for (const RawImages* const images : {&dirty, &felted})
        for (const double along : {0.47, 0.7, 0.95})
            EXPECT_EQ(mean_green(*images, along), mean_green(clean, along)) << along;
}

TEST(Paint, BleedsBeyondEveryRim) {
    PaintParams params;
    params.side = 512;
    params.surface.cap.ramp = {{255, 255, 255}, {30, 60, 200}};
    params.surface.cap.ramp_noise = 0.0;
    const RawImages images = paint_raw(params);
    for (int i = 0; i < 64; ++i) {
        const double angle = 2.0 * 3.14159265 * i / 64.0;
        const auto at = [&](double radius) {
            const TexturePoint p =
                disc_point(swept_charts[0], radius, std::cos(angle), std::sin(angle));
            return texel(images, ImageKind::base_color, static_cast<int>(p.u * 512.0),
                         static_cast<int>(p.v * 512.0));
        };
        const Texel inside = at(0.99), outside = at(1.04);
        EXPECT_NEAR(inside.r, outside.r, 26);
        EXPECT_NEAR(inside.g, outside.g, 26);
        EXPECT_NEAR(inside.b, outside.b, 26);
    }
}

// Returns a face of plain gills on a gill layout of `gill_layout` blades.
PaintParams with_layout(int blades, int tiers, int gill_layout,
                        HymeniumPattern pattern = HymeniumPattern::gills) {
    PaintParams params;
    params.side = 1024;
    params.metrics = motley(HymeniumPattern::gills).metrics;
    params.hymenium.blades = blades;
    params.hymenium.tiers = tiers;
    params.hymenium.forking = 0.0;
    params.gill_layout = gill_layout;
    params.surface.hymenium.pattern = pattern;
    params.surface.hymenium.mottle = 0.0;
    // Walls reflect no light: slots are as dark as their depth makes them.
    params.surface.hymenium.colour = {0, 0, 0};
    return params;
}

// Returns the occlusion once round the hymenium at a share of its disc.
std::vector<int> round_occlusion(const RawImages& images, double radius) {
    std::vector<int> out;
    for (int i = 0; i < 7200; ++i) {
        const double angle = 2.0 * 3.14159265 * i / 7200.0;
        const TexturePoint p =
            disc_point(swept_charts[1], radius, std::cos(angle), std::sin(angle));
        out.push_back(texel(images, ImageKind::orm, static_cast<int>(p.u * images.side),
                            static_cast<int>(p.v * images.side))
                          .r);
    }
    return out;
}

// Returns the number of dark slots between blades.
int slots_of(const std::vector<int>& occlusion) {
    int slots = 0;
    bool was_dark = false;
    for (const int value : occlusion) {
        const bool dark = was_dark ? value < 190 : value < 165;
        if (dark && !was_dark) ++slots;
        was_dark = dark;
    }
    return slots;
}

TEST(Paint, GillsAreAsManyAsRequested) {
    EXPECT_NEAR(slots_of(round_occlusion(paint_raw(with_layout(40, 0, 0)), 0.8)), 40, 1);
}

TEST(Paint, OnTheGillLayoutOfASetGillsAreAsManyAsTheirOwn) {
    // Fewer than reach the stem in the layout; as many as fill it and half of its first tier.
    EXPECT_NEAR(slots_of(round_occlusion(paint_raw(with_layout(40, 0, 64)), 0.8)), 40, 1);
    const RawImages tiered = paint_raw(with_layout(60, 0, 40));
    EXPECT_NEAR(slots_of(round_occlusion(tiered, 0.82)), 60, 1);
    EXPECT_NEAR(slots_of(round_occlusion(tiered, 0.3)), 40, 1);
    EXPECT_NEAR(slots_of(round_occlusion(paint_raw(with_layout(22, 1, 60)), 0.82)), 44, 1);
}

TEST(Paint, BladesOfASetUseOneGillLayout) {
    // A slot is 120 samples wide; the unevenness of the face moves a blade by a tenth of that.
    const auto lightest = [](const std::vector<int>& occlusion, int slot) {
        int most = 0;
        for (int i = 7200 + 120 * slot - 15; i <= 7200 + 120 * slot + 15; ++i)
            most = std::max(most, occlusion[static_cast<std::size_t>(i % 7200)]);
        return most;
    };
    const std::vector<int> gill_layout = round_occlusion(paint_raw(with_layout(60, 0, 0)), 0.8);
    for (const int blades : {30, 37, 45, 59}) {
        const std::vector<int> fewer = round_occlusion(paint_raw(with_layout(blades, 0, 60)), 0.8);
        int standing = 0;
        for (int slot = 0; slot < 60; ++slot) {
            EXPECT_GE(lightest(gill_layout, slot), 240) << slot;
            standing += lightest(fewer, slot) >= 240;
        }
        EXPECT_EQ(standing, blades);
    }
}

TEST(Paint, OnItsOwnGillLayoutASpeciesIsPaintedAsIfItWereAlone) {
    EXPECT_EQ(paint_raw(with_layout(60, 2, 60)).rgb, paint_raw(with_layout(60, 2, 0)).rgb);
    EXPECT_EQ(paint_raw(with_layout(34, 1, 34, HymeniumPattern::ridges)).rgb,
              paint_raw(with_layout(34, 1, 0, HymeniumPattern::ridges)).rgb);
    EXPECT_EQ(paint_raw(with_layout(60, 2, 90, HymeniumPattern::pores)).rgb,
              paint_raw(with_layout(60, 2, 0, HymeniumPattern::pores)).rgb);
    EXPECT_NE(paint_raw(with_layout(34, 1, 72, HymeniumPattern::ridges)).rgb,
              paint_raw(with_layout(34, 1, 0, HymeniumPattern::ridges)).rgb);
}

TEST(Paint, DeeperGillsAreDarkerBetween) {
    double last = 256.0;
    for (const double relief : {0.0, 0.5, 1.0}) {
        PaintParams params = motley(HymeniumPattern::gills);
        params.hymenium.relief = relief;
        const RawImages images = paint_raw(params);
        double sum = 0.0;
        for (int y = 0; y < 128; ++y)
            for (int x = 128; x < 256; ++x) sum += texel(images, ImageKind::orm, x, y).r;
        sum /= 128.0 * 128.0;
        EXPECT_LT(sum, last);
        last = sum;
    }
}

TEST(Paint, DecurrentGillsCoverTheirShareOfTheStem) {
    PaintParams params = motley(HymeniumPattern::gills, 512);
    params.surface.stem.net = params.surface.stem.bands = params.surface.stem.bumps = 0.0;
    params.surface.hymenium.edge = {255, 0, 0};
    params.surface.hymenium.depth = {0, 0, 255};
    const RawImages ending = paint_raw(params);
    params.hymenium.decurrent = 0.3;
    const RawImages running = paint_raw(params);
    const Chart& stem = swept_charts[static_cast<std::size_t>(Part::stem)];
    // Counts how often the stem changes from red to blue and back round a ring; every gill has a
    // flank on each side.
    const auto flanks = [&](const RawImages& images, double along) {
        int count = 0;
        bool red = false;
        for (int i = 0; i <= 400; ++i) {
            const TexturePoint at = strip_point(stem, along, i / 400.0);
            const Texel t = texel(images, ImageKind::base_color, static_cast<int>(at.u * 512.0),
                                  static_cast<int>(at.v * 512.0));
            const bool now = t.r > t.b;
            if (i > 0 && now != red) ++count;
            red = now;
        }
        return count;
    };
    EXPECT_EQ(flanks(running, 0.98), 2 * params.hymenium.blades);
    EXPECT_EQ(flanks(ending, 0.98), 0);
    for (int i = 0; i < 100; ++i) {
        const TexturePoint at = strip_point(stem, 0.69, i / 100.0);
        const auto x = static_cast<int>(at.u * 512.0), y = static_cast<int>(at.v * 512.0);
        EXPECT_EQ(texel(running, ImageKind::base_color, x, y).r,
                  texel(ending, ImageKind::base_color, x, y).r)
            << "below them the stem is bare";
    }
}

TEST(Paint, WaterDarkensAndSmooths) {
    PaintParams params = motley(HymeniumPattern::gills);
    params.weathering.wetness = 0.0;
    const RawImages dry = paint_raw(params);
    params.weathering.wetness = 1.0;
    const RawImages wet = paint_raw(params);
    double light = 0.0, rough = 0.0;
    for (std::size_t i = 0; i < dry.rgb[0].size(); ++i)
        light += static_cast<double>(wet.rgb[0][i]) - static_cast<double>(dry.rgb[0][i]);
    for (std::size_t i = 1; i < dry.rgb[2].size(); i += 3)
        rough += static_cast<double>(wet.rgb[2][i]) - static_cast<double>(dry.rgb[2][i]);
    EXPECT_LT(light, 0.0);
    EXPECT_LT(rough, 0.0);
}

// Returns an image with quarters of four colours.
Upload quarters(int side) {
    Bytes rgb(3 * static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            std::uint8_t* p = &rgb[3 * static_cast<std::size_t>(y * side + x)];
            p[0] = x < side / 2 ? 220 : 30;
            p[1] = y < side / 2 ? 200 : 40;
            p[2] = 90;
        }
    return uploaded(jpeg(rgb, side, side, 95, Chroma::full));
}

TEST(Paint, AnUploadedImageReplacesThePaintingOfADisc) {
    for (const int side : {64, 2048}) {
        PaintParams params;
        params.side = 512;
        params.surface.cap.image = quarters(side);
        const RawImages images = paint_raw(params);
        const int places[4][2] = {{70, 70}, {186, 70}, {70, 186}, {186, 186}};
        for (const auto& place : places) {
            const Texel found = texel(images, ImageKind::base_color, place[0], place[1]);
            EXPECT_NEAR(found.r, place[0] < 128 ? 220 : 30, 6);
            EXPECT_NEAR(found.g, place[1] < 128 ? 200 : 40, 6);
            EXPECT_NEAR(found.b, 90, 8);
        }
    }
}

TEST(Paint, AnUploadedImageIsMappedOverTheStem) {
    PaintParams params;
    params.side = 512;
    params.surface.stem.image = quarters(128);
    const RawImages images = paint_raw(params);
    const int places[4][2] = {{100, 290}, {400, 290}, {100, 410}, {400, 410}};
    for (const auto& place : places) {
        const Texel found = texel(images, ImageKind::base_color, place[0], place[1]);
        EXPECT_NEAR(found.r, place[0] < 256 ? 220 : 30, 6);
        EXPECT_NEAR(found.g, place[1] < 352 ? 200 : 40, 6);
    }
}

TEST(Paint, AnUnreadableImageIsRefusedByItsPath) {
    PaintParams params;
    params.surface.stem.image = uploaded({1, 2, 3, 4});
    try {
        (void)paint(params);
        FAIL();
    } catch (const InvalidInput& error) {
        ASSERT_EQ(error.problems().size(), 1U);
        EXPECT_EQ(error.problems()[0].path, "/surface/stem/image");
    }
}

}  // namespace
}  // namespace sporeprint::surface_paint_test
