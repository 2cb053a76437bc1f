#include "core/surface/damage.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "core/surface/charts.h"
#include "core/surface/paint.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/paintings.h"

namespace sporeprint::surface_damage_test {
namespace {

using P = PaintedWeathering<Plain>;
struct Effect {
    const char* name;
    double P::*amount;
};
constexpr std::array<Effect, 12> effects = {{{"cracks", &P::cracks},
                                             {"creases", &P::creases},
                                             {"peel", &P::peel},
                                             {"splits", &P::splits},
                                             {"bites", &P::bites},
                                             {"bumps", &P::bumps},
                                             {"deliquescence", &P::deliquescence},
                                             {"fade", &P::fade},
                                             {"bruise", &P::bruise},
                                             {"dust", &P::dust},
                                             {"dew", &P::dew},
                                             {"wetness", &P::wetness}}};

/// Returns a plain mushroom whose colours differ strongly from those of its damage.
PaintParams clean() {
    PaintParams params = motley(HymeniumPattern::gills, 256);
    params.weathering = {};
    params.ornaments = {};
    params.surface.cap.ramp = {{150, 20, 20}};
    params.surface.flesh.colour = {250, 250, 250};
    params.surface.damage.bruise = {20, 20, 200};
    params.surface.damage.dust = {10, 200, 10};
    return params;
}

/// Returns the mean difference of two images over all bytes.
double difference(const Bytes& a, const Bytes& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::abs(static_cast<int>(a[i]) - static_cast<int>(b[i]));
    return sum / static_cast<double>(a.size());
}

TEST(PaintedDamage, EachEffectIsMoreVisibleWithItsAmount) {
    const RawImages before = paint_raw(clean());
    for (const Effect& effect : effects) {
        double last = 0.0;
        for (const double amount : {0.25, 0.6, 1.0}) {
            PaintParams params = clean();
            params.weathering.*effect.amount = amount;
            const RawImages after = paint_raw(params);
            const double now = difference(before.rgb[0], after.rgb[0]) +
                               difference(before.rgb[1], after.rgb[1]) +
                               difference(before.rgb[2], after.rgb[2]);
            EXPECT_GT(now, last) << effect.name << ' ' << amount;
            last = now;
        }
    }
}

TEST(PaintedDamage, TexelsDependContinuouslyOnAmounts) {
    for (const Effect& effect : effects)
        for (const double amount : {0.1, 0.5, 0.9}) {
            PaintParams params = clean();
            params.weathering.*effect.amount = amount;
            const RawImages before = paint_raw(params);
            params.weathering.*effect.amount = amount + 1.0 / 256.0;
            const RawImages after = paint_raw(params);
            EXPECT_LT(difference(before.rgb[0], after.rgb[0]), 0.8) << effect.name << ' ' << amount;
        }
}

TEST(PaintedDamage, AllEffectsAtOnceOnTheSmallestAtlasAreAnImage) {
    for (const int side : {16, 32, 512}) {
        PaintParams params = clean();
        params.side = side;
        for (const Effect& effect : effects) params.weathering.*effect.amount = 1.0;
        const RawImages images = paint_raw(params);
        for (const Bytes& image : images.rgb)
            EXPECT_EQ(image.size(), 3U * static_cast<std::size_t>(side * side));
    }
}

/// Instruction sets differ in texels per vector, so the result of overlapping marks must not depend
/// on which texels share one.
TEST(PaintedDamageOfEveryInstructionSet, IsEqualAloneAndInPairs) {
    for (std::size_t first = 0; first < effects.size(); ++first)
        for (std::size_t second = first; second < effects.size(); ++second)
            for (const int side : {32, 128}) {
                PaintParams params = motley(HymeniumPattern::gills, side);
                params.seed = static_cast<std::uint32_t>(100 * first + second);
                params.weathering = {};
                params.weathering.*effects[first].amount = 0.7;
                // Little of the second kind: small marks cross few texels of a vector.
                params.weathering.*effects[second].amount = 0.08;
                expect_equal_with_every_instruction_set([&] { return paint_raw(params); },
                                                        std::string(effects[first].name) + ' ' +
                                                            effects[second].name + ' ' +
                                                            std::to_string(side));
            }
}

TEST(PaintedDamage, ACrackDoesNotChangeTheHollowsBesideIt) {
    // Normals of the cap outside of cracks: texels that a vector or the window of a drop also
    // covers must not change.
    PaintParams params = clean();
    params.weathering.bumps = 1.0;
    const RawImages lumpy = paint_raw(params);
    for (const auto& [effect, amount] : {std::pair{&P::cracks, 0.3}, std::pair{&P::dew, 0.5}}) {
        PaintParams both = params, alone = clean();
        both.weathering.*effect = alone.weathering.*effect = amount;
        const RawImages worn = paint_raw(alone), plain = paint_raw(clean()),
                        mixed = paint_raw(both);
        const auto same = [](const RawImages& a, const RawImages& b, int x, int y, int around,
                             int levels) {
            const auto apart = [&](const Bytes& one, const Bytes& two, std::size_t at) {
                return std::abs(static_cast<int>(one[at]) - static_cast<int>(two[at])) > levels;
            };
            for (int j = y - around; j <= y + around; ++j)
                for (int i = x - around; i <= x + around; ++i) {
                    const std::size_t at = 3U * static_cast<std::size_t>(j * 256 + i);
                    for (std::size_t c = 0; c < 3; ++c)
                        if (apart(a.rgb[0], b.rgb[0], at + c) || apart(a.rgb[1], b.rgb[1], at + c))
                            return false;
                }
            return true;
        };
        int looked = 0;
        for (int y = 8; y < 120; ++y)
            for (int x = 8; x < 120; ++x) {
                if (!same(worn, plain, x, y, 2, 0)) continue;
                ++looked;
                // What rounds to nothing alone may be one level on the slope of a hollow.
                EXPECT_TRUE(same(mixed, lumpy, x, y, 0, 1)) << x << ' ' << y;
            }
        EXPECT_GT(looked, 1000);
    }
}

TEST(PaintedDamage, ABiteExposesFleshAtTheMarginOfBothFaces) {
    PaintParams params = clean();
    params.weathering.bites = 1.0;
    const RawImages before = paint_raw(clean()), after = paint_raw(params);
    const auto reddest = [&](const RawImages& images, int from_x) {
        int flesh = 0;
        for (int y = 0; y < 128; ++y)
            for (int x = from_x; x < from_x + 128; ++x) {
                const std::size_t at = 3U * static_cast<std::size_t>(y * 256 + x);
                if (images.rgb[0][at + 1] > 150 && images.rgb[0][at + 2] > 150) ++flesh;
            }
        return flesh;
    };
    EXPECT_GT(reddest(after, 0), reddest(before, 0) + 200);
}

TEST(PaintedDamage, CracksAreRadialWhereTheCapHasOpenedAndANetElsewhere) {
    // The centre of the cap is cracked by the net alone.
    const auto middle = [](int strain) {
        PaintParams params = clean();
        params.metrics.radial_strain = strain;
        const RawImages whole = paint_raw(params);
        params.weathering.cracks = 1.0;
        const RawImages cracked = paint_raw(params);
        int changed = 0;
        for (int y = 56; y < 72; ++y)
            for (int x = 56; x < 72; ++x) {
                const std::size_t at = 3U * static_cast<std::size_t>(y * 256 + x);
                if (std::abs(whole.rgb[0][at + 1] - cracked.rgb[0][at + 1]) > 20) ++changed;
            }
        return changed;
    };
    EXPECT_GT(middle(0), 10);
    EXPECT_EQ(middle(16), 0);
}

}  // namespace
}  // namespace sporeprint::surface_damage_test
