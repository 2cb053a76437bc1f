#include "core/individual/patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/math/elementary.h"
#include "core/math/purposes.h"

namespace sporeprint::individual_patches_test {
namespace {

PatchStyle warts() {
    PatchStyle style;
    style.count = 150;
    style.size = 0.04;
    return style;
}

bool same(const Patch& a, const Patch& b) {
    return a.sigma == b.sigma && a.theta == b.theta && a.radius == b.radius && a.spin == b.spin &&
           a.height == b.height && a.survival == b.survival && a.id == b.id;
}

TEST(Patches, LieInTheWindowOfTheirStyle) {
    PatchStyle style = warts();
    style.from = 0.2;
    style.to = 0.9;
    const std::vector<Patch> found = patches(style, 5, purposes::warts);
    ASSERT_EQ(found.size(), 150U);
    std::size_t crowded_out = 0;
    for (const Patch& patch : found) {
        EXPECT_GE(patch.sigma, 0.2);
        EXPECT_LE(patch.sigma, 0.9);
        EXPECT_GE(patch.theta, 0.0);
        EXPECT_LT(patch.theta, 2.0 * pi);
        EXPECT_GE(patch.radius, 0.0);
        if (patch.radius == 0.0) ++crowded_out;
        EXPECT_GE(patch.survival, 0.0);
        EXPECT_LT(patch.survival, 1.0);
    }
    EXPECT_LT(crowded_out, 30U) << "they stay in the row, without size";
}

TEST(Patches, AreEvenlySpreadOverTheHemisphere) {
    // The median of the area of a hemisphere between pole and rim lies at sixty degrees.
    std::size_t upper = 0, all = 0, right = 0;
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        PatchStyle style = warts();
        style.size = 0.01;  // none is crowded out
        for (const Patch& patch : patches(style, seed, purposes::warts)) {
            ++all;
            if (patch.sigma < 2.0 / 3.0) ++upper;
            if (patch.theta < pi) ++right;
        }
    }
    EXPECT_EQ(all, 20U * 150U);
    EXPECT_NEAR(static_cast<double>(upper) / static_cast<double>(all), 0.5, 0.04);
    EXPECT_NEAR(static_cast<double>(right) / static_cast<double>(all), 0.5, 0.04);
}

TEST(Patches, OverlapByAFifthAtMost) {
    PatchStyle style = warts();
    style.size = 0.08;
    const std::vector<Patch> found = patches(style, 3, purposes::warts);
    for (std::size_t i = 0; i < found.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const auto place = [](const Patch& p) {
                const double tilt = p.sigma * 0.5 * pi;
                const double r = sine(tilt);
                return std::array<double, 3>{r * cosine(p.theta), cosine(tilt), r * sine(p.theta)};
            };
            const auto a = place(found[i]), b = place(found[j]);
            const double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            const double apart = std::acos(std::min(1.0, dot)) / (0.5 * pi);
            if (found[i].radius > 0.0 && found[j].radius > 0.0) {
                EXPECT_GT(apart, 0.76 * (found[i].radius + found[j].radius));
            }
        }
}

TEST(Patches, DependOnTheSeed) {
    const std::vector<Patch> once = patches(warts(), 5, purposes::warts);
    const std::vector<Patch> again = patches(warts(), 5, purposes::warts);
    ASSERT_EQ(once.size(), again.size());
    for (std::size_t i = 0; i < once.size(); ++i) EXPECT_TRUE(same(once[i], again[i]));
    EXPECT_FALSE(same(once[0], patches(warts(), 6, purposes::warts)[0]));
    EXPECT_FALSE(same(once[0], patches(warts(), 5, purposes::scales)[0]));
}

TEST(Patches, AreNoneForAnEmptyStyle) {
    PatchStyle style = warts();
    style.count = 0;
    EXPECT_TRUE(patches(style, 1, purposes::warts).empty());
    style.count = 10;
    style.from = style.to = 0.5;
    EXPECT_TRUE(patches(style, 1, purposes::warts).empty());
}

TEST(Patches, ASmallChangeOfStyleMovesThemLittle) {
    PatchStyle style = warts();
    const std::vector<Patch> before = patches(style, 5, purposes::warts);
    style.size *= 1.001;
    const std::vector<Patch> after = patches(style, 5, purposes::warts);
    std::size_t j = 0;
    for (const Patch& patch : before) {
        while (j < after.size() && after[j].id < patch.id) ++j;
        const double radius = j < after.size() && after[j].id == patch.id ? after[j].radius : 0.0;
        EXPECT_NEAR(radius, patch.radius, 0.002);
    }
}

TEST(Patches, UnevenOnesAreAFewLargeAmongManyGranules) {
    PatchStyle style = warts();
    style.size = 0.01;  // none is crowded out
    const auto sizes = [&](double unevenness) {
        style.unevenness = unevenness;
        std::vector<double> drawn;
        for (const Patch& patch : patches(style, 5, purposes::warts)) drawn.push_back(patch.drawn);
        std::sort(drawn.begin(), drawn.end());
        return drawn;
    };
    const std::vector<double> alike = sizes(0.0), unlike = sizes(1.0), between = sizes(0.5);
    ASSERT_EQ(unlike.size(), alike.size()) << "no unevenness changes the number of vertices";
    const std::size_t middle = alike.size() / 2;
    EXPECT_LT(alike.back(), 2.4 * alike.front());
    EXPECT_GT(unlike.back(), 4.0 * unlike.front());
    EXPECT_LT(unlike[middle], 0.5 * unlike.back()) << "half of them are small";
    EXPECT_LT(between[middle], alike[middle]);
    EXPECT_GT(between[middle], unlike[middle]);
}

TEST(Patches, ShrinkToZeroWithTheAmount) {
    for (const Patch& patch : patches(warts(), 5, purposes::warts)) {
        EXPECT_EQ(patch_scale(patch, 0.0), 0.0);
        EXPECT_EQ(patch_scale(patch, 1.0), 1.0);
        double last = 0.0;
        for (double amount = 0.0; amount <= 1.0; amount += 0.01) {
            const double scale = patch_scale(patch, amount);
            EXPECT_GE(scale, last);
            EXPECT_LE(scale - last, 0.2);
            last = scale;
        }
        EXPECT_EQ(patch_scale(patch, patch.survival), 0.0);
    }
}

}  // namespace
}  // namespace sporeprint::individual_patches_test
