#include "core/colony/habit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <vector>

namespace sporeprint::colony_habit_test {
namespace {

// A mushroom with a cap of 60 mm on a stem of 80 x 8 mm.
constexpr StemFit fit{0.004, 0.08, 0.085, 0.03};

ColonyTraits nature_of(Habit habit, bool capped = true) {
    ColonyTraits traits;
    traits.habit = habit;
    traits.capped = capped;
    if (habit == Habit::rooted) traits.roots = RootsShown::shown;
    return traits;
}

ColonySite site_of(const ColonyParams& params, const ColonyTraits& traits) {
    return colony_site(params, traits, colony_growth(params, traits, fit), {fit, fit});
}

TEST(ColonyHabit, OnRootsEveryStemIsThatOfTheSource) {
    ColonyParams params;
    params.count = 256;
    ColonyTraits traits = nature_of(Habit::rooted);
    traits.seed = 7;
    const ColonyRoots growth = colony_growth(params, traits, fit);
    const ColonySkeleton source = colony_skeleton(growth, traits.seed);
    const ColonySite site = colony_site(params, traits, growth, {fit, fit});
    ASSERT_EQ(site.places.size(), source.stems.size());
    ASSERT_EQ(site.ground.nodes.size(), source.root_nodes);
    EXPECT_EQ(site.ground.segments.size() + 1, site.ground.nodes.size()) << "a tree";
    std::map<std::uint32_t, const ColonySkeleton::Stem*> by_root;
    for (const ColonySkeleton::Stem& stem : source.stems) by_root[stem.root] = &stem;
    for (const ColonyPlace& place : site.places) {
        ASSERT_TRUE(by_root.contains(place.number));
        const ColonySkeleton::Stem& stem = *by_root[place.number];
        EXPECT_EQ(place.radius, stem.radius);
        const double last = static_cast<double>(stem.nodes.size());
        for (std::size_t i = 0; i < stem.nodes.size(); ++i) {
            const glm::dvec3 there = source.skeleton.nodes[stem.nodes[i]].place;
            EXPECT_LT(glm::distance(place.at((static_cast<double>(i) + 1.0) / last), there), 1e-12);
        }
        EXPECT_LT(glm::distance(glm::normalize(place.along(1.0)), stem.along), 1e-12);
    }
}

// With more stems than requested each remains with the same probability: over many seeds the
// remaining ones have the same mean position as all.
TEST(ColonyHabit, ThinningPrefersNoPlace) {
    ColonyParams params;
    ColonyTraits traits = nature_of(Habit::rooted);
    double all = 0.0, retained = 0.0;
    std::size_t stems = 0, places = 0;
    for (traits.seed = 1; traits.seed <= 300; ++traits.seed) {
        params.count = 256;
        for (const ColonyPlace& place : site_of(params, traits).places) {
            all += place.share;
            ++stems;
        }
        params.count = 6;
        const ColonySite thinned = site_of(params, traits);
        EXPECT_LE(thinned.places.size(), 6U);
        for (const ColonyPlace& place : thinned.places) {
            retained += place.share;
            ++places;
        }
    }
    ASSERT_GT(places, 1000U);
    // Shares are about uniform in 0..1: three standard deviations of their mean.
    EXPECT_NEAR(retained / static_cast<double>(places), all / static_cast<double>(stems),
                3.0 * 0.3 / std::sqrt(static_cast<double>(places)));
}

TEST(ColonyHabit, EveryOtherHabitPlacesTheRequestedCount) {
    for (const Habit habit : {Habit::tuft, Habit::troop, Habit::ring, Habit::tier})
        for (const bool capped : {true, false})
            for (const int count : {1, 2, 24, 256}) {
                ColonyParams params;
                params.count = count;
                const ColonySite site = site_of(params, nature_of(habit, capped));
                EXPECT_EQ(site.places.size(), static_cast<std::size_t>(count));
                for (const ColonyPlace& place : site.places) {
                    EXPECT_GT(place.radius, 0.0);
                    EXPECT_GE(place.share, 0.0);
                    EXPECT_LE(place.share, 1.0);
                    EXPECT_EQ(place.rise != glm::dvec3(0.0), capped);
                }
            }
}

// The youngest has half the height and a third of the radius of the oldest, the others what is between.
TEST(ColonyHabit, YoungStemsAreAsLowAndThinAsTheYoungestIs) {
    const StemFit young{fit.radius / 3.0, fit.height / 2.0, fit.length / 2.0, fit.cap_radius / 2.0};
    for (const Habit habit : {Habit::troop, Habit::ring, Habit::tier}) {
        ColonyParams params;
        params.count = 60;
        const ColonyTraits traits = nature_of(habit);
        const ColonyRoots growth = colony_growth(params, traits, fit);
        double youngest = 0.0;
        for (const ColonyPlace& place : colony_site(params, traits, growth, {fit, young}).places) {
            EXPECT_NEAR(place.radius / growth.root_radius, 1.0 - 2.0 / 3.0 * place.share, 0.13);
            EXPECT_NEAR(place.at(1.0).y / growth.stem_height - place.foot.y / growth.stem_height,
                        1.0 - 0.5 * place.share, 0.13);
            youngest = std::max(youngest, place.share);
        }
        EXPECT_GT(youngest, 0.9);
    }
}

TEST(ColonyHabit, ATuftRisesFromOneBaseAndLeansOut) {
    ColonyParams params;
    params.count = 10;
    const ColonyTraits traits = nature_of(Habit::tuft);
    const ColonySite site = site_of(params, traits);
    double foot = 0.0, top = 0.0;
    for (const ColonyPlace& place : site.places) {
        const glm::dvec3 head = place.at(1.0);
        const double in = glm::length(place.foot), out = std::hypot(head.x, head.z);
        foot = std::max(foot, in);
        top = std::max(top, out);
        if (place.share > 0.3) {
            EXPECT_GT(out, in);
        }
        // It points upwards again at its cap.
        EXPECT_GT(glm::normalize(place.along(1.0)).y, glm::normalize(place.along(0.0)).y - 1e-9);
        EXPECT_GT(glm::normalize(place.along(1.0)).y, 0.75);
    }
    EXPECT_LT(foot, 0.4 * top);
    // Fused: most stem bases overlap another.
    int fused = 0;
    for (const ColonyPlace& one : site.places) {
        double nearest = 1e9;
        for (const ColonyPlace& other : site.places)
            if (&one != &other)
                nearest = std::min(nearest,
                                   glm::distance(one.foot, other.foot) - one.radius - other.radius);
        fused += nearest < 0.5 * one.radius ? 1 : 0;
    }
    EXPECT_GE(fused, 6);
}

TEST(ColonyHabit, ATroopStandsInPatchesAtADistance) {
    ColonyParams params;
    params.count = 64;
    ColonyTraits traits = nature_of(Habit::troop);
    double pairs = 0.0, expected = 0.0;
    constexpr double near = 4.0;  // cap radii
    for (traits.seed = 1; traits.seed <= 12; ++traits.seed) {
        const ColonySite site = site_of(params, traits);
        double nearest = 1e9, sum = 0.0, square = 0.0;
        for (const ColonyPlace& one : site.places) {
            double own = 1e9;
            for (const ColonyPlace& other : site.places) {
                if (&one == &other) continue;
                const double apart = glm::distance(one.foot, other.foot) / fit.cap_radius;
                own = std::min(own, apart);
                pairs += apart < near ? 1.0 : 0.0;
            }
            nearest = std::min(nearest, own);
            sum += own;
            square += glm::dot(one.foot, one.foot) / (64.0 * fit.cap_radius * fit.cap_radius);
        }
        EXPECT_GT(nearest, 0.8);
        EXPECT_GT(sum / 64.0, 1.5) << "in the mean caps hardly touch";
        // As many places spread evenly over the disc of the same mean square distance from its
        // middle.
        expected += 64.0 * 63.0 * near * near / (2.0 * square);
    }
    EXPECT_GT(pairs, 1.2 * expected);
}

TEST(ColonyHabit, ARingStandsInArcs) {
    ColonyParams params;
    params.count = 48;
    ColonyTraits traits = nature_of(Habit::ring);
    for (traits.seed = 1; traits.seed <= 12; ++traits.seed) {
        const ColonySite site = site_of(params, traits);
        double mean = 0.0;
        for (const ColonyPlace& place : site.places) mean += glm::length(place.foot) / 48.0;
        EXPECT_GT(2.0 * 3.14159265 * mean, 48 * 1.8 * fit.cap_radius) << "room for all";
        std::vector<double> angles;
        for (const ColonyPlace& place : site.places) {
            EXPECT_NEAR(glm::length(place.foot), mean, 0.06 * mean + 1.5 * fit.cap_radius);
            angles.push_back(std::atan2(place.foot.z, place.foot.x));
        }
        std::sort(angles.begin(), angles.end());
        double gap = 2.0 * 3.14159265 + angles.front() - angles.back();
        for (std::size_t i = 1; i < angles.size(); ++i)
            gap = std::max(gap, angles[i] - angles[i - 1]);
        EXPECT_GT(gap, 1.8 * 2.0 * 3.14159265 / 48) << "arcs are apart";
        EXPECT_LT(gap, 0.25 * 2.0 * 3.14159265);
    }
}

TEST(ColonyHabit, AnotherSeedIsAnotherLayout) {
    ColonyParams params;
    for (const Habit habit : {Habit::tuft, Habit::troop, Habit::ring, Habit::tier}) {
        ColonyTraits traits = nature_of(habit);
        const ColonySite one = site_of(params, traits);
        traits.seed = 2;
        const ColonySite other = site_of(params, traits);
        double along = 0.0, own = 0.0;
        for (std::size_t i = 0; i < one.places.size(); ++i) {
            along += glm::distance(one.places[i].foot, other.places[i].foot);
            own += glm::length(one.places[i].foot);
        }
        EXPECT_GT(along, 0.04 * own) << static_cast<int>(habit);
    }
}

TEST(ColonyHabit, ATierStandsOnItsTrunk) {
    for (const bool capped : {true, false}) {
        ColonyParams params;
        params.trunk_radius = 0.11;
        ColonyTraits traits = nature_of(Habit::tier, capped);
        traits.lateral = !capped;
        const ColonySite site = site_of(params, traits);
        for (const ColonyPlace& place : site.places) {
            const glm::dvec3 from_axis = place.foot + glm::dvec3(0.0, 0.0, 0.11);
            EXPECT_NEAR(std::hypot(from_axis.x, from_axis.z), 0.11, 1e-12);
            EXPECT_GT(glm::dot(place.outwards, from_axis), 0.1099) << "it faces away from it";
            if (!capped) continue;
            EXPECT_GT(glm::dot(glm::normalize(place.along(0.0)), place.outwards), 0.999);
            EXPECT_GT(glm::normalize(place.along(1.0)).y, 0.95) << "stems turn up";
        }
    }
}

TEST(ColonyHabit, RequestedValuesOverrideThoseOfTheSpecies) {
    ColonyParams params;
    const ColonyTraits traits = nature_of(Habit::rooted);
    const ColonyRoots own = colony_growth(params, traits, fit);
    EXPECT_EQ(own.root_radius, fit.radius);
    EXPECT_EQ(own.stem_height, fit.height);
    params.growth.root_radius = 0.008;
    params.growth.stem_height = 0.2;
    params.growth.depth = 5;
    const ColonyRoots requested = colony_growth(params, traits, fit);
    EXPECT_EQ(requested.root_radius, 0.008);
    EXPECT_EQ(requested.stem_height, 0.2);
    EXPECT_EQ(requested.depth, 5);
    EXPECT_EQ(requested.segment_length, 2.0 * own.segment_length) << "caps are twice as wide";
}

}  // namespace
}  // namespace sporeprint::colony_habit_test
