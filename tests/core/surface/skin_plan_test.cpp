// Texture of skins, lines at the margin, zones, and colours of individuals.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

#include "core/surface/charts.h"
#include "core/surface/paint.h"
#include "tests/support/paintings.h"

namespace sporeprint::surface_skin_plan_test {
namespace {

constexpr SkinKind all_kinds[] = {SkinKind::smooth,  SkinKind::fibrillose, SkinKind::silky,
                                  SkinKind::velvety, SkinKind::granular,   SkinKind::viscid,
                                  SkinKind::matt};

// Returns a grey mushroom without any other texture.
PaintParams plain(int side, SkinKind kind, double strength) {
    PaintParams params;
    params.side = side;
    params.seed = 11;
    params.metrics = motley(HymeniumPattern::gills).metrics;
    params.surface.cap.ramp = {{150, 130, 110}};
    params.surface.cap.ramp_noise = 0.0;
    params.surface.cap.bumps = 0.0;
    params.surface.cap.colour_drift = 0.0;
    params.surface.cap.skin = {.kind = kind, .strength = strength, .grain = 0.01};
    params.surface.stem.top = params.surface.stem.base = {150, 130, 110};
    params.surface.stem.base_stain = 0.0;
    params.surface.stem.bumps = 0.0;
    params.surface.stem.fibrils = 0.0;
    params.surface.stem.skin = params.surface.cap.skin;
    return params;
}

/// One channel of a square inside a chart.
struct Window {
    int size;
    std::vector<double> values;
    [[nodiscard]] double at(int x, int y) const {
        return values[static_cast<std::size_t>(y * size + x)];
    }
};

Window window_of(const RawImages& images, Part part, ImageKind kind, int Texel::*channel) {
    const Chart& chart = swept_charts[static_cast<std::size_t>(part)];
    const double side = images.side;
    const double extent = std::min(chart.width, chart.height) * side;
    const int size = static_cast<int>(0.55 * extent);
    const int left = static_cast<int>((chart.u + 0.5 * chart.width) * side) - size / 2;
    const int top = static_cast<int>((chart.v + 0.5 * chart.height) * side) - size / 2;
    Window window{size, {}};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            window.values.push_back(texel(images, kind, left + x, top + y).*channel);
    return window;
}

Window centred(Window window) {
    const double mean = std::accumulate(window.values.begin(), window.values.end(), 0.0) /
                        static_cast<double>(window.values.size());
    for (double& value : window.values) value -= mean;
    return window;
}

double energy(const Window& window) {
    double sum = 0.0;
    for (const double value : centred(window).values) sum += value * value;
    return sum / static_cast<double>(window.values.size());
}

double correlation(const Window& a, const Window& b) {
    const Window one = centred(a), two = centred(b);
    double sum = 0.0;
    for (std::size_t i = 0; i < one.values.size(); ++i) sum += one.values[i] * two.values[i];
    return sum / static_cast<double>(one.values.size()) / std::sqrt(energy(a) * energy(b) + 1e-12);
}

// Returns the means of squares of `cell` texels.
Window reduced(const Window& window, int cell) {
    Window out{window.size / cell, {}};
    for (int y = 0; y < out.size; ++y)
        for (int x = 0; x < out.size; ++x) {
            double sum = 0.0;
            for (int j = 0; j < cell; ++j)
                for (int i = 0; i < cell; ++i) sum += window.at(cell * x + i, cell * y + j);
            out.values.push_back(sum / (cell * cell));
        }
    return out;
}

TEST(Skin, ItsDetailIsAFewTexelsLargeAtEveryResolution) {
    for (const SkinKind kind : all_kinds)
        for (const Part part : {Part::cap, Part::stem})
            for (const int side : {512, 1024}) {
                const RawImages images = paint_raw(plain(side, kind, 1.0));
                const Window window = window_of(images, part, ImageKind::base_color, &Texel::g);
                const std::string what = std::string(name(kind)) + ' ' + std::to_string(side) +
                                         ' ' + std::to_string(static_cast<int>(part));
                EXPECT_GT(energy(window), 4.0) << what;
                // Means of eight by eight texels keep little of it.
                EXPECT_LT(energy(reduced(window, 8)), 0.5 * energy(window)) << what;
            }
}

TEST(Skin, WithoutStrengthItIsFlat) {
    const RawImages images = paint_raw(plain(512, SkinKind::granular, 0.0));
    for (const Part part : {Part::cap, Part::stem})
        for (const ImageKind kind : {ImageKind::base_color, ImageKind::normal})
            EXPECT_LT(energy(window_of(images, part, kind, &Texel::r)), 3.0);
}

TEST(Skin, ColourReliefAndRoughnessAreIndependent) {
    for (const SkinKind kind : all_kinds)
        for (const Part part : {Part::cap, Part::stem}) {
            const RawImages images = paint_raw(plain(512, kind, 1.0));
            const Window colour = window_of(images, part, ImageKind::base_color, &Texel::g);
            const Window rough = window_of(images, part, ImageKind::orm, &Texel::g);
            const Window slope_x = window_of(images, part, ImageKind::normal, &Texel::r);
            const Window slope_y = window_of(images, part, ImageKind::normal, &Texel::g);
            EXPECT_LT(std::abs(correlation(colour, rough)), 0.2) << name(kind);
            for (const Window* slope : {&slope_x, &slope_y}) {
                EXPECT_LT(std::abs(correlation(colour, *slope)), 0.2) << name(kind);
                EXPECT_LT(std::abs(correlation(rough, *slope)), 0.2) << name(kind);
            }
        }
}

std::array<double, 3> lab(std::array<double, 3> srgb) {
    std::array<double, 3> linear{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double x = srgb[i] / 255.0;
        linear[i] = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    }
    const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
    const double x = f((0.4124 * linear[0] + 0.3576 * linear[1] + 0.1805 * linear[2]) / 0.9505);
    const double y = f(0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]);
    const double z = f((0.0193 * linear[0] + 0.1192 * linear[1] + 0.9505 * linear[2]) / 1.089);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum);
}

// Returns the mean colour of the middle of a part, in CIELAB.
std::array<double, 3> mean_colour(const RawImages& images, Part part) {
    std::array<double, 3> mean{};
    int Texel::*const channels[3] = {&Texel::r, &Texel::g, &Texel::b};
    for (std::size_t i = 0; i < 3; ++i) {
        const Window window = window_of(images, part, ImageKind::base_color, channels[i]);
        mean[i] = std::accumulate(window.values.begin(), window.values.end(), 0.0) /
                  static_cast<double>(window.values.size());
    }
    return lab(mean);
}

TEST(Skin, TheMeanColourStays) {
    for (const Part part : {Part::cap, Part::stem}) {
        const auto flat = mean_colour(paint_raw(plain(512, SkinKind::smooth, 0.0)), part);
        for (const SkinKind kind : all_kinds)
            EXPECT_LT(distance(flat, mean_colour(paint_raw(plain(512, kind, 1.0)), part)), 1.0)
                << name(kind);
        PaintParams powdery = plain(512, SkinKind::matt, 0.5);
        powdery.surface.cap.skin.bloom = powdery.surface.stem.skin.bloom = 1.0;
        EXPECT_LT(distance(flat, mean_colour(paint_raw(powdery), part)), 1.0);
    }
}

TEST(Skin, ALargerImageReducedShowsTheSameSkin) {
    for (const SkinKind kind : all_kinds)
        for (const Part part : {Part::cap, Part::stem}) {
            const Window small =
                window_of(paint_raw(plain(512, kind, 1.0)), part, ImageKind::base_color, &Texel::g);
            const Window large = reduced(window_of(paint_raw(plain(1024, kind, 1.0)), part,
                                                   ImageKind::base_color, &Texel::g),
                                         2);
            ASSERT_EQ(small.size, large.size);
            EXPECT_GT(correlation(small, large), 0.5) << name(kind);
            EXPECT_NEAR(energy(small) / energy(large), 1.0, 0.7) << name(kind);
        }
}

TEST(Skin, PowderMakesARoughPatternOfItsOwn) {
    PaintParams bare = plain(512, SkinKind::smooth, 0.0);
    bare.surface.cap.roughness = 0.4;
    PaintParams powdery = bare;
    powdery.surface.cap.skin.bloom = 1.0;
    const RawImages before = paint_raw(bare), after = paint_raw(powdery);
    const auto mean = [](const RawImages& images) {
        const Window window = window_of(images, Part::cap, ImageKind::orm, &Texel::g);
        return std::accumulate(window.values.begin(), window.values.end(), 0.0) /
               static_cast<double>(window.values.size());
    };
    EXPECT_GT(mean(after), mean(before) + 5.0);
    EXPECT_GT(energy(window_of(after, Part::cap, ImageKind::base_color, &Texel::g)),
              energy(window_of(before, Part::cap, ImageKind::base_color, &Texel::g)));
}

// Returns a channel once round a disc at a share of its radius.
std::vector<double> round_disc(const RawImages& images, Part part, ImageKind kind, double radius,
                               int Texel::*channel) {
    std::vector<double> out;
    for (int i = 0; i < 3600; ++i) {
        const double angle = 2.0 * 3.14159265358979 * i / 3600.0;
        const TexturePoint p = disc_point(swept_charts[static_cast<std::size_t>(part)], radius,
                                          std::cos(angle), std::sin(angle));
        out.push_back(texel(images, kind, static_cast<int>(p.u * images.side),
                            static_cast<int>(p.v * images.side)).*
                      channel);
    }
    return out;
}

PaintParams striate(double wetness, double slime) {
    PaintParams params = plain(1024, SkinKind::smooth, 0.0);
    params.surface.cap.striae = 0.4;
    params.surface.cap.roughness = 0.25;
    params.surface.hymenium.mottle = 0.0;
    params.surface.hymenium.colour = {0, 0, 0};
    params.hymenium.blades = 60;
    params.hymenium.tiers = 0;
    params.weathering.wetness = wetness;
    params.slime = slime;
    return params;
}

TEST(Striae, AreDarkAboveTheGills) {
    const RawImages images = paint_raw(striate(0.0, 0.0));
    const std::vector<double> line =
        round_disc(images, Part::cap, ImageKind::base_color, 0.97, &Texel::g);
    const std::vector<double> gill =
        round_disc(images, Part::hymenium, ImageKind::orm, 0.97, &Texel::r);
    const int n = static_cast<int>(line.size());
    EXPECT_LT(correlation({n, line}, {n, gill}), -0.6)
        << "the edges of gills are the lightest of the lower face";
}

TEST(Striae, ShowMoreWhenWetAndAreFlatUnderSlime) {
    const auto contrast = [](double wetness, double slime, ImageKind kind) {
        const RawImages images = paint_raw(striate(wetness, slime));
        const std::vector<double> line = round_disc(images, Part::cap, kind, 0.97, &Texel::r);
        const double mean = std::accumulate(line.begin(), line.end(), 0.0) / 3600.0;
        return std::sqrt(energy({3600, line})) / mean;
    };
    EXPECT_GT(contrast(1.0, 0.0, ImageKind::base_color),
              1.2 * contrast(0.0, 0.0, ImageKind::base_color));
    EXPECT_LT(contrast(0.0, 1.0, ImageKind::normal), 0.5 * contrast(0.0, 0.0, ImageKind::normal));
    // Slopes of a glossy cap stay below 0.2, so that highlights do not break up into stitches.
    EXPECT_LT(contrast(0.0, 0.0, ImageKind::normal), 0.2 / std::sqrt(2.0));
}

TEST(Zones, DifferInWidthAlongARadiusAndRoundTheAxis) {
    PaintParams params = plain(1024, SkinKind::smooth, 0.0);
    params.surface.cap.zones = 1.0;
    params.surface.cap.zone_count = 10;
    const RawImages images = paint_raw(params);
    // Radii at which the brightness has a minimum.
    const auto minima = [&](double angle) {
        std::vector<double> found;
        std::vector<double> values;
        for (int i = 0; i <= 220; ++i) {
            double sum = 0.0;
            for (int k = -2; k <= 2; ++k) {
                const double a = angle + 0.01 * k;
                const TexturePoint p =
                    disc_point(swept_charts[0], i / 220.0, std::cos(a), std::sin(a));
                sum += texel(images, ImageKind::base_color, static_cast<int>(p.u * 1024.0),
                             static_cast<int>(p.v * 1024.0))
                           .g;
            }
            values.push_back(sum);
        }
        for (std::size_t i = 4; i + 4 < values.size(); ++i) {
            bool is_lowest = true;
            for (std::size_t k = i - 4; k <= i + 4; ++k) is_lowest &= values[i] <= values[k];
            const double radius = static_cast<double>(i) / 220.0;
            if (is_lowest && (found.empty() || radius - found.back() > 0.02))
                found.push_back(radius);
        }
        return found;
    };
    double least_spread = 1.0;
    std::vector<double> thirds;
    for (int k = 0; k < 8; ++k) {
        const std::vector<double> at = minima(0.3 + 0.78 * k);
        ASSERT_GE(at.size(), 5U);
        ASSERT_LE(at.size(), 15U);
        double sum = 0.0, square = 0.0;
        for (std::size_t i = 1; i < at.size(); ++i) {
            sum += at[i] - at[i - 1];
            square += (at[i] - at[i - 1]) * (at[i] - at[i - 1]);
        }
        const double n = static_cast<double>(at.size() - 1), mean = sum / n;
        least_spread = std::min(least_spread, std::sqrt(square / n - mean * mean) / mean);
        thirds.push_back(at[3]);
    }
    EXPECT_GT(least_spread, 0.1);
    const auto [low, high] = std::minmax_element(thirds.begin(), thirds.end());
    EXPECT_GT(*high - *low, 0.02);
}

TEST(Hue, VariesBetweenIndividualsAndOverEachOneModestly) {
    const auto colour = [](std::uint32_t seed, double drift) {
        PaintParams params = plain(64, SkinKind::smooth, 0.0);
        params.seed = seed;
        params.surface.cap.colour_drift = drift;
        return mean_colour(paint_raw(params), Part::cap);
    };
    const auto base = colour(1, 0.0);
    std::array<double, 3> mean{};
    double far = 0.0, typical = 0.0;
    constexpr int individuals = 60;
    for (std::uint32_t seed = 1; seed <= individuals; ++seed) {
        const auto one = colour(seed, 0.3);
        for (std::size_t i = 0; i < 3; ++i) mean[i] += one[i] / individuals;
        far = std::max(far, distance(base, one));
        typical += distance(base, one) / individuals;
    }
    EXPECT_LT(distance(base, mean), 1.0);
    EXPECT_GT(typical, 0.8);
    EXPECT_LT(far, 8.0);
    PaintParams params = plain(512, SkinKind::smooth, 0.0);
    const RawImages even = paint_raw(params);
    params.surface.cap.colour_drift = 0.5;
    const RawImages drifted = paint_raw(params);
    EXPECT_GT(energy(window_of(drifted, Part::cap, ImageKind::base_color, &Texel::b)),
              2.0 * energy(window_of(even, Part::cap, ImageKind::base_color, &Texel::b)));
}

}  // namespace
}  // namespace sporeprint::surface_skin_plan_test
