#include "core/individual/damage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/math/elementary.h"
#include "core/silhouette/morph_set.h"
#include "tests/support/orders.h"

namespace sporeprint::individual_damage_test {
namespace {

constexpr std::uint32_t many_seeds = 40;

TEST(Damage, LieOnTheirPartWithAscendingOnset) {
    for (const DamageSpotKind kind :
         {DamageSpotKind::pit, DamageSpotKind::bruise, DamageSpotKind::dew, DamageSpotKind::lump})
        for (const CurveName part : curve_names)
            for (std::uint32_t seed = 0; seed < many_seeds; ++seed) {
                double onset = 0.0;
                for (const DamageSpot& spot : damage_spots(kind, part, seed)) {
                    EXPECT_GE(spot.sigma, 0.0);
                    EXPECT_LE(spot.sigma, 1.0);
                    EXPECT_GE(spot.theta, 0.0);
                    EXPECT_LT(spot.theta, 2.0 * pi);
                    EXPECT_GT(spot.radius, 0.0);
                    EXPECT_GE(spot.elongation, 1.0);
                    EXPECT_GE(spot.onset, onset);
                    EXPECT_LT(spot.onset, 1.0);
                    onset = spot.onset;
                }
            }
    EXPECT_TRUE(damage_spots(DamageSpotKind::pit, CurveName::hymenium, 1).empty())
        << "slugs rasp skin";
}

TEST(Damage, DependOnTheSeed) {
    const auto first = damage_spots(DamageSpotKind::bruise, CurveName::cap, 7),
               again = damage_spots(DamageSpotKind::bruise, CurveName::cap, 7),
               other = damage_spots(DamageSpotKind::bruise, CurveName::cap, 8),
               pits = damage_spots(DamageSpotKind::pit, CurveName::cap, 7);
    ASSERT_EQ(first.size(), again.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
        EXPECT_EQ(first[i].theta, again[i].theta);
        EXPECT_EQ(first[i].sigma, again[i].sigma);
        EXPECT_NE(first[i].theta, other[i].theta);
    }
    EXPECT_NE(first[0].theta, pits[0].theta) << "kinds do not share draws";
}

TEST(Damage, LiesElsewhereOnAnotherSpeciesOfTheSameSeed) {
    const SeedShares one = damage_shares(resolve(order_of("boletus_edulis", 0.6, 7), atlas())),
                     again = damage_shares(resolve(order_of("boletus_edulis", 0.9, 7), atlas())),
                     other = damage_shares(resolve(order_of("russula_emetica", 0.6, 7), atlas()));
    ASSERT_EQ(one.size(), 1U);
    EXPECT_EQ(one.front().weight, 1.0);
    EXPECT_EQ(one.front().seed, again.front().seed) << "no age moves it";
    EXPECT_NE(one.front().seed, other.front().seed);
    const auto here = damage_spots(DamageSpotKind::pit, CurveName::stem, one.front().seed),
               there = damage_spots(DamageSpotKind::pit, CurveName::stem, other.front().seed);
    EXPECT_NE(here.front().theta, there.front().theta);
}

TEST(Damage, OfAMixIsThatOfEachOfItsSpeciesAlone) {
    MushroomSpec spec = order_of("boletus_edulis", 0.6, 7);
    spec.mix = {{"boletus_edulis", 300}, {"russula_emetica", 700}};
    const SeedShares mixed = damage_shares(resolve(spec, atlas()));
    ASSERT_EQ(mixed.size(), 2U);
    EXPECT_NEAR(mixed[0].weight, 0.3, 0.01);
    EXPECT_NEAR(mixed[0].weight + mixed[1].weight, 1.0, 1e-12);
    for (const SeedShare& share : mixed) {
        const std::string id = &share == mixed.data() ? "boletus_edulis" : "russula_emetica";
        EXPECT_EQ(share.seed, damage_shares(resolve(order_of(id, 0.6, 7), atlas())).front().seed);
    }
}

TEST(Damage, GrowContinuouslyFromZeroToFullSize) {
    for (double onset = 0.0; onset < 0.9; onset += 0.07) {
        EXPECT_EQ(grown(onset, 0.0), 0.0);
        EXPECT_EQ(grown(onset, onset), 0.0);
        EXPECT_NEAR(grown(onset, 1.0), 1.0, 1e-12);
        for (int i = 0; i < 256; ++i) {
            const double step = grown(onset, (i + 1) / 256.0) - grown(onset, i / 256.0);
            EXPECT_GE(step, 0.0);
            EXPECT_LT(step, 2.1 / 256.0 / (1.0 - onset));
        }
    }
}

TEST(Damage, PitsBeginAsShallowPatches) {
    EXPECT_EQ(pit_depth(0.0), 0.0);
    EXPECT_EQ(pit_depth(1.0), 1.0);
    EXPECT_EQ(faded_in_size(1.0), 1.0);
    for (int i = 0; i < 100; ++i) {
        const double scale = i / 100.0;
        EXPECT_GE(faded_in_size(scale), 0.5) << "no pit is a dot";
        EXPECT_LE(faded_in_size(scale), faded_in_size(scale + 0.01));
        EXPECT_LE(pit_depth(scale), pit_depth(scale + 0.01));
        EXPECT_LT(pit_depth(scale + 0.01) - pit_depth(scale), 0.05);
    }
}

TEST(Damage, BitesAreRound) {
    const Notch notch{1.0, 0.3, 0.2, 0.0, true, 0};
    EXPECT_EQ(notch_profile(notch, 1.0), 1.0);
    EXPECT_NEAR(notch_profile(notch, 1.0 + 0.3 * 0.6), 0.8, 1e-12);
    EXPECT_NEAR(notch_profile(notch, 1.0 - 0.3 * 0.6), 0.8, 1e-12);
    EXPECT_EQ(notch_profile(notch, 1.31), 0.0);
    EXPECT_EQ(notch_profile(notch, 1.0 + pi), 0.0);
    EXPECT_NEAR(notch_depth(notch, 0.25, 1.0 + 0.3 * 0.6), 0.2, 1e-12);
    EXPECT_EQ(lip_lift(notch, 1.0, 1.29), 0.0);
}

TEST(Damage, SplitsPassThroughTheCornersOfTheirLips) {
    for (std::uint32_t seed = 0; seed < many_seeds; ++seed)
        for (const Notch& split : splits(seed)) {
            EXPECT_EQ(notch_profile(split, split.theta), 1.0);
            for (const std::size_t side : {0U, 1U}) {
                const double sign = side == 0 ? -1.0 : 1.0;
                double across = 0.0, deep = 1.0;
                for (const Lip::Corner& corner : split.lips[side].corners) {
                    EXPECT_GT(corner.across, across);
                    EXPECT_LT(corner.deep, deep);
                    EXPECT_NEAR(notch_profile(split, split.theta + sign * corner.across),
                                corner.deep, 1e-9);
                    across = corner.across;
                    deep = corner.deep;
                }
                EXPECT_EQ(deep, 0.0) << "on the margin";
                EXPECT_LE(across, split.half_width * (1.0 + 1e-12));
                EXPECT_EQ(notch_profile(split, split.theta + sign * 1.01 * across), 0.0);
            }
        }
}

TEST(Damage, SplitsAreNarrowMostlyShortAndTheirLipsDiffer) {
    std::size_t all = 0, shorter = 0, longer = 0;
    double difference = 0.0;
    for (std::uint32_t seed = 0; seed < many_seeds; ++seed)
        for (const Notch& split : splits(seed)) {
            ++all;
            shorter += split.depth < 0.2 ? 1 : 0;
            longer += split.depth > 0.35 ? 1 : 0;
            const auto& [one, other] = split.lips;
            const double mouth = one.corners.back().across + other.corners.back().across;
            EXPECT_LT(mouth, 0.55 * split.depth);
            // Half-way to the tip less than half of the mouth is open.
            const double middle = one.corners[1].across + other.corners[1].across;
            EXPECT_LT(middle, 0.7 * mouth);
            difference += std::abs(one.corners[1].across / one.corners.back().across -
                                   other.corners[1].across / other.corners.back().across);
        }
    EXPECT_GT(2 * shorter, all);
    EXPECT_LT(4 * longer, all);
    EXPECT_GT(longer, 0U);
    EXPECT_GT(difference / static_cast<double>(all), 0.08);
}

TEST(Damage, TheTipOfAGrowingSplitAdvancesAndItsLipsMoveApart) {
    const Notch split = splits(3).front();
    double before = 0.0, width_before = 0.0;
    for (int i = 0; i <= 64; ++i) {
        const double size = i / 64.0;
        const double deep = notch_depth(split, size, split.theta);
        EXPECT_NEAR(deep, size, 1e-12);
        double width = 0.0;
        constexpr int steps = 400;
        for (int k = -steps; k <= steps; ++k) {
            const double theta = split.theta + split.half_width * k / steps;
            const double here = notch_depth(split, size, theta);
            EXPECT_LE(here, notch_profile(split, theta));
            width += here > 0.0 ? 1.0 : 0.0;
        }
        EXPECT_GE(deep, before);
        EXPECT_GE(width, width_before);
        before = deep;
        width_before = width;
    }
}

TEST(Damage, LipsAreRaisedBesideASplitOnly) {
    for (std::uint32_t seed = 0; seed < many_seeds; ++seed)
        for (const Notch& split : splits(seed)) {
            EXPECT_EQ(lip_lift(split, 1.0, split.theta), 0.0) << "not at its tip";
            EXPECT_EQ(lip_lift(split, 0.0, split.theta + split.half_width), 0.0);
            EXPECT_EQ(lip_lift(split, 1.0, split.theta + pi), 0.0);
            for (const double theta : {split.theta - 0.02, split.theta + 0.02}) {
                EXPECT_GE(lip_lift(split, 1.0, theta), 0.0);
                EXPECT_LE(lip_lift(split, 1.0, theta), 1.0);
            }
        }
}

TEST(Damage, NotchesStayOutsideTheStem) {
    for (std::uint32_t seed = 0; seed < many_seeds; ++seed)
        for (const auto& list : {bites(seed), splits(seed)})
            for (const Notch& notch : list) {
                EXPECT_GT(notch.depth, 0.0);
                EXPECT_LT(notch.depth, 0.6);
                EXPECT_GT(notch.half_width, 0.0);
                EXPECT_LE(notch.half_width, most_notch_width);
            }
}

TEST(Damage, ABiteIsThreeScallopsThatMeetInCusps) {
    for (std::uint32_t seed = 0; seed < many_seeds; ++seed)
        for (const Notch& bite : bites(seed)) {
            const auto depth = [&](double place) {
                return notch_profile(bite, bite.theta + place * bite.half_width);
            };
            EXPECT_NEAR(depth(bite.scallops[1].middle), 1.0, 1e-9) << "the middle one is deepest";
            EXPECT_EQ(depth(-1.0), 0.0);
            EXPECT_EQ(depth(1.0), 0.0);
            for (const std::size_t side : {0U, 1U}) {
                const Scallop& outer = bite.scallops[2 * side];
                const double end =
                    side == 0 ? outer.middle - outer.half_width : outer.middle + outer.half_width;
                EXPECT_NEAR(end, side == 0 ? -1.0 : 1.0, 1e-9) << "it reaches the end of the bite";
                const double cusp = bite.cusps[side];
                EXPECT_GT(depth(cusp), 0.0) << "no skin is left between two scallops";
                EXPECT_LE(depth(cusp), depth(outer.middle) + 1e-9);
                EXPECT_LE(depth(cusp), 1.0);
            }
            EXPECT_LT(bite.cusps[0], bite.cusps[1]);
            EXPECT_GT(1.0 + bite.undercut, 0.5);
        }
}

TEST(Damage, CracksOfANetMeetInTJunctions) {
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
        const std::vector<Crack> net = crack_net(seed);
        ASSERT_GT(net.size(), 25U);
        ASSERT_LT(net.size(), 200U);
        std::size_t ends = 0, met = 0;
        for (std::size_t i = 0; i < net.size(); ++i) {
            ASSERT_GE(net[i].points.size(), 2U);
            for (const CrackPoint& end : {net[i].points.front(), net[i].points.back()}) {
                if (end.x * end.x + end.y * end.y > 1.0) continue;  // left the face
                ++ends;
                bool touches = false;
                for (std::size_t j = 0; j < i && !touches; ++j)
                    for (const CrackPoint& p : net[j].points)
                        touches = touches || (p.x == end.x && p.y == end.y);
                if (touches) ++met;
            }
        }
        EXPECT_GT(static_cast<double>(met) / static_cast<double>(ends), 0.8)
            << "a crack ends where it meets another";
    }
}

TEST(Damage, RadialCracksStartAtTheMarginAndFewAreLong) {
    std::size_t longer = 0, all = 0;
    for (std::uint32_t seed = 0; seed < many_seeds; ++seed)
        for (const Crack& crack : radial_cracks(seed)) {
            const CrackPoint &outer = crack.points.front(), &inner = crack.points.back();
            EXPECT_NEAR(outer.x * outer.x + outer.y * outer.y, 1.0, 1e-12);
            const double rho = std::sqrt(inner.x * inner.x + inner.y * inner.y);
            EXPECT_GT(rho, 0.2);
            EXPECT_LT(rho, 0.9);
            ++all;
            if (rho < 0.6) ++longer;
        }
    EXPECT_LT(longer * 3, all);
    EXPECT_GT(longer * 20, all);
}

TEST(Damage, OpeningCapsCrackRadiallyAndSwellingOnesIntoIslands) {
    const auto face = [](double radius, double bend) {
        // The face is a piece of a sphere whose meridian turns by `bend`, margin to apex.
        std::vector<OutlineNode> nodes;
        const double sphere = radius / std::sin(bend);
        for (int i = 0; i <= 32; ++i) {
            const double angle = bend * (1.0 - i / 32.0);
            nodes.push_back({{sphere * std::sin(angle), sphere * std::cos(angle)},
                             {-sphere * bend * std::cos(angle), sphere * bend * std::sin(angle)}});
        }
        return SubCurve(nodes, {-1.0, 0.0});
    };
    const SubCurve button = face(0.02, 0.5 * pi);
    EXPECT_LT(radial_strain(button, button), 0.1);
    EXPECT_LT(radial_strain(button, face(0.05, 0.5 * pi)), 0.1) << "grown alike in all directions";
    EXPECT_GT(radial_strain(button, face(0.05, 0.15)), 0.9) << "opened flat";
}

TEST(Damage, FurrowsBeginAndEndOnTheStem) {
    for (std::uint32_t seed = 0; seed < many_seeds; ++seed)
        for (const Furrow& furrow : furrows(seed)) {
            EXPECT_LT(furrow.from, furrow.to);
            EXPECT_LE(furrow.split_to, 1.0);
            EXPECT_LT(furrow.split_from, furrow.split_to);
            for (double sigma = 0.0; sigma <= 1.0; sigma += 0.05) {
                EXPECT_GE(furrow_depth(furrow, sigma), 0.0);
                EXPECT_LE(furrow_depth(furrow, sigma), 1.0);
                EXPECT_NEAR(turn_between(furrow.theta, furrow_angle(furrow, sigma)), 0.0, 0.17);
            }
        }
}

}  // namespace
}  // namespace sporeprint::individual_damage_test
