#include "core/scene/scene_season.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <memory>
#include <set>
#include <vector>

#include "core/world/influence.h"
#include "tests/support/scenes.h"

namespace sporeprint::scene_season_test {
namespace {

constexpr int first_year = 20, last = 45;

/// A lawn with a log of beech on it, a rock, and a roof over a part of the lawn.
scenes::Made garden() {
    return scenes::Made()
        .floor(-3, -3, 3, 3, 0, "lawn")
        .box({-1.5F, -0.05F, 0.5F}, {1.5F, 0.35F, 0.9F}, "beech log")
        .box({1.8F, -0.1F, -2.6F}, {2.6F, 0.5F, -1.8F}, "rock")
        .box({-2.5F, 0.5F, -2.5F}, {-0.5F, 0.55F, -0.5F}, "metal");
}

std::vector<FungusSpecies> species() {
    FungusSpecies bracket = scenes::wood_species();
    bracket.stream = stream_of("bracket");
    bracket.ecology.body = {.days_to_mature = 400.0, .days_alive = 1500.0, .perennial = true};
    return {scenes::grass_species(), scenes::wood_species(), bracket};
}

SceneFungi grown(const SceneConditions& conditions, const Parallel& parallel = in_turn) {
    static const auto shape = std::make_shared<const SceneShape>(shape_of_scene(garden().shared()));
    return scene_fungi(std::make_shared<const SceneHabitat>(habitat_of(shape, conditions)),
                       species(), parallel);
}

SceneConditions usual() { return scenes::conditions_for(garden().scene); }

const SceneFungi& fungi() {
    static const SceneFungi one = grown(usual());
    return one;
}

/// Returns the bodies of some years.
const std::vector<SceneBody>& bodies() {
    static const std::vector<SceneBody> all = [] {
        std::vector<SceneBody> sum;
        for (int year = first_year; year < last; ++year) {
            const std::vector<SceneBody> of_year = scene_season(fungi(), year);
            sum.insert(sum.end(), of_year.begin(), of_year.end());
        }
        return sum;
    }();
    return all;
}

TEST(SceneSeason, HasBodiesOfEachSpeciesOnWhatItLivesOn) {
    std::array<int, 3> counts{};
    for (const SceneBody& body : bodies()) {
        ++counts[body.record.species];
        const Soil soil = fungi().habitat->substrates.soils[body.surfel];
        EXPECT_EQ(soil, body.record.species == 0 ? Soil::grass : Soil::wood);
        EXPECT_EQ(body.record.trunk != 0, body.record.species != 0);
    }
    for (const int count : counts) EXPECT_GT(count, 20);
}

TEST(SceneSeason, StandsOnTheSurface) {
    for (const SceneBody& body : bodies()) {
        const Surfel& nearest = fungi().habitat->surfels()[body.surfel];
        EXPECT_LE(glm::length(body.at - glm::dvec3(nearest.at)), 0.06);
        EXPECT_NEAR(glm::length(body.out), 1.0, 1e-9);
        if (body.record.species == 0) {
            EXPECT_NEAR(body.at.y, 0.0, 1e-6);
            EXPECT_GT(body.out.y, 0.99);
        } else {
            EXPECT_GT(body.out.y, -0.4) << "nothing grows from below";
        }
        EXPECT_NEAR(metres(body.record.at.x), body.at.x, 1e-4);
        EXPECT_NEAR(metres(body.record.at.y), -body.at.z, 1e-4);
        EXPECT_EQ(body.record.height, body.at.y);
    }
}

TEST(SceneSeason, FacesOutOfTheWood) {
    int sides = 0;
    for (const SceneBody& body : bodies()) {
        if (body.record.species == 0) continue;
        const double east = std::cos(body.record.facing) * std::cos(body.record.pitch),
                     north = std::sin(body.record.facing) * std::cos(body.record.pitch);
        EXPECT_NEAR(east, body.out.x, 1e-9);
        EXPECT_NEAR(north, -body.out.z, 1e-9);
        if (std::abs(body.out.y) < 0.1) {
            ++sides;
            EXPECT_TRUE(body.at.z > 0.89 || body.at.z < 0.51 || std::abs(body.at.x) > 1.49);
        }
    }
    EXPECT_GT(sides, 5);
}

TEST(SceneSeason, HasNoTwoBodiesInOnePlace) {
    for (int year = first_year; year < first_year + 5; ++year) {
        const std::vector<SceneBody> of_year = scene_season(fungi(), year);
        for (std::size_t i = 0; i < of_year.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const FruitBody &a = of_year[i].record, &b = of_year[j].record;
                EXPECT_NE(a.id, b.id);
                if (a.genet != b.genet || a.emerged >= b.gone || b.emerged >= a.gone) continue;
                EXPECT_GE(
                    glm::length(of_year[i].at - of_year[j].at),
                    core_of(fungi().species[a.species]) + core_of(fungi().species[b.species]));
            }
    }
}

TEST(SceneSeason, IsTheSameOnEachDayOfAYear) {
    for (int year = first_year; year < first_year + 3; ++year) {
        const std::vector<SceneBody> all = scene_bodies(fungi(), year);
        EXPECT_EQ(all, scene_bodies(fungi(), year));
        // What stands in the new year was there in the old one, with the same place and times.
        for (const SceneBody& body : scene_bodies(fungi(), year + 1)) {
            if (body.record.emerged >= time_of(year + 1)) continue;
            EXPECT_NE(std::ranges::find(all, body), all.end());
        }
    }
}

TEST(SceneSeason, WithoutRainHasBracketsAtMost) {
    SceneConditions dry = usual();
    dry.climate.rain = 0.0;
    const SceneFungi none = grown(dry);
    for (int year = first_year; year < last; ++year)
        for (const SceneBody& body : scene_season(none, year)) EXPECT_EQ(body.record.species, 2);
}

TEST(SceneSeason, HasFewerBelowTheRoof) {
    double below = 0.0, open = 0.0;
    for (const SceneBody& body : bodies()) {
        if (body.record.species != 0) continue;
        const bool is_below =
            body.at.x > -2.2 && body.at.x < -0.8 && body.at.z > -2.2 && body.at.z < -0.8;
        (is_below ? below : open) += 1.0;
    }
    EXPECT_LT(below / (1.4 * 1.4), 0.3 * open / (36.0 - 1.4 * 1.4));
}

TEST(SceneSeason, GrowsWithTheAbundanceAndKeepsWhatWasThere) {
    SceneConditions many = usual();
    many.abundance = 3.0;
    const SceneFungi more = grown(many);
    std::size_t few = 0, all = 0;
    for (int year = first_year; year < first_year + 6; ++year) {
        std::set<std::uint64_t> ids;
        for (const SceneBody& body : scene_season(more, year)) ids.insert(body.record.id);
        for (const SceneBody& body : scene_season(fungi(), year)) {
            ++few;
            EXPECT_TRUE(ids.contains(body.record.id));
        }
        all += ids.size();
    }
    EXPECT_GT(all, 2 * few);
    SceneConditions no = usual();
    no.abundance = 0.0;
    EXPECT_TRUE(scene_season(grown(no), first_year).empty());
}

TEST(SceneSeason, IsTheSameWithSeveralThreads) {
    const SceneFungi other = grown(usual(), scenes::by_threads);
    for (int year = first_year; year < first_year + 3; ++year)
        EXPECT_EQ(scene_season(other, year), scene_season(fungi(), year));
}

TEST(SceneSeason, HasAProbabilityOfPlaces) {
    const std::vector<float> lawn = scene_probability(fungi(), 0, 100);
    float most = 0.0F;
    for (std::size_t i = 0; i < lawn.size(); ++i) {
        most = std::max(most, lawn[i]);
        EXPECT_GE(lawn[i], 0.0F);
        EXPECT_LE(lawn[i], 1.0F);
        if (fungi().habitat->substrates.soils[i] != Soil::grass) {
            EXPECT_EQ(lawn[i], 0.0F);
        }
    }
    EXPECT_GT(most, 0.3F);
}

}  // namespace
}  // namespace sporeprint::scene_season_test
