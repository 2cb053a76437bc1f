#include "core/world/dispersal.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <cmath>

#include "core/math/elementary.h"

namespace sporeprint::dispersal_test {
namespace {

constexpr std::uint32_t test_purpose = 9999;

/// Speeds at which spores of clubmoss and of Ganoderma fall, m/s.
constexpr double lycopodium = 0.0194, ganoderma = 0.003;

WaldLaw some_law() {
    const double height = *rc::gen::inRange(1, 100) / 50.0;
    const double settling = *rc::gen::inRange(2, 200) / 10000.0;
    const double wind = *rc::gen::inRange(1, 40) / 20.0;
    return wald_law({height, settling, wind, 0.15});
}

TEST(Wald, IntegralOfItsDensityIsItsShareWithin) {
    rc::check([] {
        const WaldLaw law = some_law();
        const double far = law.mean * (*rc::gen::inRange(1, 60) / 20.0);
        // Midpoints in the logarithm of the distance, from where there is nothing.
        constexpr int parts = 4000;
        const double begin = std::log(far * 1e-8), step = std::log(1e8) / parts;
        double sum = 0.0;
        for (int i = 0; i < parts; ++i) {
            const double r = std::exp(begin + (i + 0.5) * step);
            sum += law.density(r) * r * step;
        }
        RC_ASSERT(std::abs(sum - law.within(far)) < 2e-4);
    });
}

TEST(Wald, ShareWithinRisesFromNothingToAll) {
    rc::check([] {
        const WaldLaw law = some_law();
        double before = 0.0;
        for (double r = 1e-6 * law.mean; r < 1e7 * law.mean; r *= 1.5) {
            const double here = law.within(r);
            RC_ASSERT(here >= before - 1e-6);
            RC_ASSERT(here <= 1.0);
            before = here;
        }
        RC_ASSERT(before > 0.999);
    });
}

TEST(Wald, MeanIsWindTimesHeightOverSettlingAndHalvesWithTwiceTheSettling) {
    const SporeRelease release{0.25, 0.003, 0.8, 0.15};
    SporeRelease heavy = release;
    heavy.settling *= 2.0;
    EXPECT_DOUBLE_EQ(wald_law(release).mean, 0.8 * 0.25 / 0.003);
    EXPECT_DOUBLE_EQ(wald_law(heavy).mean, 0.5 * wald_law(release).mean);
}

TEST(Wald, SamplesHaveItsMeanAndItsDistribution) {
    // Near the ground the tail is so long that means of samples need millions of them: this law has a moderate one.
    const WaldLaw law = wald_law({0.5, 0.02, 0.2, 0.15});
    Random random(1, test_purpose);
    constexpr int count = 200000;
    double sum = 0.0, within_half = 0.0, within_mean = 0.0, within_twice = 0.0;
    for (int i = 0; i < count; ++i) {
        const double r = law.sample(random);
        ASSERT_GT(r, 0.0);
        sum += r;
        within_half += r <= 0.5 * law.mean ? 1.0 : 0.0;
        within_mean += r <= law.mean ? 1.0 : 0.0;
        within_twice += r <= 2.0 * law.mean ? 1.0 : 0.0;
    }
    EXPECT_NEAR(sum / count / law.mean, 1.0, 0.03);
    EXPECT_NEAR(within_half / count, law.within(0.5 * law.mean), 0.005);
    EXPECT_NEAR(within_mean / count, law.within(law.mean), 0.005);
    EXPECT_NEAR(within_twice / count, law.within(2.0 * law.mean), 0.005);
}

TEST(Wald, MeanOfSamplesOfTwiceTheSettlingIsHalf) {
    const auto mean_of_samples = [](double settling) {
        const WaldLaw law = wald_law({0.5, settling, 0.2, 0.15});
        Random random(2, test_purpose);
        double sum = 0.0;
        for (int i = 0; i < 200000; ++i) sum += law.sample(random);
        return sum / 200000;
    };
    EXPECT_NEAR(mean_of_samples(0.04) / mean_of_samples(0.02), 0.5, 0.015);
}

TEST(Wald, WithoutWindStaysAtTheBody) {
    const WaldLaw law = wald_law({0.06, 0.0015, 0.0, 0.15});
    Random random(1, test_purpose);
    EXPECT_EQ(law.sample(random), 0.0);
    EXPECT_EQ(law.within(0.01), 1.0);
}

TEST(Dispersal, InStillAir95PercentFallWithin58Centimetres) {
    for (const double wind : {0.0, 0.01, 0.02, 0.03})
        for (const double height : {0.02, 0.06, 0.2})
            for (const double settling : {0.0003, 0.0015, 0.007}) {
                const double share = dispersal_kernel({height, settling, wind, 0.15}).within(0.58);
                EXPECT_GE(share, 0.94);
                EXPECT_LE(share, 0.96);
            }
}

TEST(Dispersal, InOpenGrassACloudLoses13To24PercentWithin10MetresHeavySporesMore) {
    const double heavy = dispersal_kernel({0.25, lycopodium, 0.8, 0.15}).within(10.0);
    const double light = dispersal_kernel({0.25, ganoderma, 0.8, 0.15}).within(10.0);
    EXPECT_GE(light, 0.13);
    EXPECT_LE(heavy, 0.24);
    EXPECT_GT(heavy, light);
}

TEST(Dispersal, EverySporeLandsOrIsGone) {
    rc::check([] {
        const double wind = *rc::gen::inRange(0, 100) / 20.0;
        const DispersalKernel kernel = dispersal_kernel({0.1, 0.0015, wind, 0.15});
        RC_ASSERT(std::abs(kernel.beside + kernel.carried + kernel.gone - 1.0) < 1e-12);
        RC_ASSERT(kernel.beside >= 0.0 && kernel.carried >= 0.0 && kernel.gone >= 0.0);
    });
}

TEST(Dispersal, StrongerWindTakesMoreAlongAndFarther) {
    const DispersalKernel calm = dispersal_kernel({0.06, 0.0015, 0.1, 0.15}),
                          windy = dispersal_kernel({0.06, 0.0015, 0.5, 0.15});
    EXPECT_GT(calm.beside, windy.beside);
    EXPECT_LT(calm.wald.mean, windy.wald.mean);
}

TEST(Dispersal, SamplesHaveTheSharesOfTheKernelAndGoWithTheWind) {
    ClimateParams climate;
    climate.wind_from_deg = 270;
    climate.wind_focus = 3.0;
    const WindRose rose = wind_rose(climate);
    const DispersalKernel kernel = dispersal_kernel({0.25, ganoderma, 0.3, 0.15});
    Random random(3, test_purpose);
    constexpr int count = 100000;
    double landed = 0.0, within_1 = 0.0, within_10 = 0.0, east = 0.0, north = 0.0, far = 0.0;
    for (int i = 0; i < count; ++i) {
        const std::optional<Landing> landing = sample(kernel, rose, random);
        if (!landing) continue;
        landed += 1.0;
        const double r = std::sqrt(landing->east * landing->east + landing->north * landing->north);
        within_1 += r <= 1.0 ? 1.0 : 0.0;
        within_10 += r <= 10.0 ? 1.0 : 0.0;
        if (r > 2.0) {
            far += 1.0;
            east += landing->east / r;
            north += landing->north / r;
        }
    }
    EXPECT_NEAR(landed / count, 1.0 - kernel.gone, 0.006);
    EXPECT_NEAR(within_1 / count, kernel.within(1.0), 0.006);
    EXPECT_NEAR(within_10 / count, kernel.within(10.0), 0.006);
    // The mean direction of a von Mises distribution of focus 3 is 0.81 long, a little less in sectors.
    EXPECT_NEAR(east / far, 0.75, 0.05);
    EXPECT_NEAR(north / far, 0.0, 0.02);
}

TEST(Dispersal, DensityOverThePlaneAddsUpToWhatLands) {
    ClimateParams climate;
    const WindRose rose = wind_rose(climate);
    const DispersalKernel kernel = dispersal_kernel({0.25, lycopodium, 0.3, 0.15});
    double sum = 0.0;
    const double step = std::log(1e7) / 1000;
    for (int i = 0; i < 1000; ++i) {
        const double r = std::exp(std::log(1e-3) + (i + 0.5) * step);
        for (int k = 0; k < 64; ++k) {
            const double angle = 2.0 * pi * k / 64;
            sum += kernel.density(rose, r * std::sin(angle), r * std::cos(angle)) * r * r * step *
                   (2.0 * pi / 64);
        }
    }
    EXPECT_NEAR(sum, kernel.beside + kernel.carried, 0.002);
}

}  // namespace
}  // namespace sporeprint::dispersal_test
