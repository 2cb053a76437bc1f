#include "core/scene/scene_mycelia.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "tests/support/scenes.h"

namespace sporeprint::scene_mycelia_test {
namespace {

std::shared_ptr<const SceneShape> shape_of(const scenes::Made& made) {
    return std::make_shared<const SceneShape>(shape_of_scene(made.shared()));
}

struct Grown {
    SceneHabitat habitat;
    FungusSpecies species;
    SceneEstablishment establishment;

    Grown(const std::shared_ptr<const SceneShape>& shape, FungusSpecies of)
        : habitat(scenes::habitat_in(shape)),
          species(std::move(of)),
          establishment(scene_spread(habitat, species)) {}
    [[nodiscard]] std::vector<SceneGenet> until(int year) const {
        return scene_genets(habitat, species, 0, establishment, year);
    }
};

/// Two planks that are 10 cm apart.
scenes::Made planks() {
    return scenes::Made()
        .box({-2, 0, -0.5F}, {-0.05F, 0.3F, 0.5F}, "beech wood")
        .box({0.05F, 0, -0.5F}, {2, 0.3F, 0.5F}, "beech wood");
}

TEST(SceneMycelia, OfAnEarlierYearAreTheFirstOfALaterOne) {
    const Grown grown(shape_of(planks()), scenes::wood_species());
    const auto early = grown.until(40), late = grown.until(90);
    ASSERT_GT(early.size(), 3U);
    ASSERT_GT(late.size(), early.size());
    EXPECT_TRUE(std::equal(early.begin(), early.end(), late.begin()));
    for (const SceneGenet& one : late) {
        EXPECT_LT(one.genet.born, one.genet.died);
        EXPECT_NE(one.genet.host, 0U);
        const Surfel& centre = grown.habitat.surfels()[one.surfel];
        EXPECT_NEAR(metres(one.genet.centre.x), static_cast<double>(centre.at.x), 1e-4);
        EXPECT_NEAR(metres(one.genet.centre.y), -static_cast<double>(centre.at.z), 1e-4);
    }
}

TEST(SceneMycelia, NeverPassAGap) {
    FungusSpecies species = scenes::wood_species();
    species.ecology.genet.reach = 6.0;
    species.ecology.genet.speed = 1.0;
    const Grown grown(shape_of(planks()), species);
    for (const int year : {30, 60, 90}) {
        const auto genets = grown.until(year);
        const Territory territory =
            territory_of(grown.habitat, species, genets, time_of(year, 200));
        std::size_t owned = 0;
        for (std::uint32_t i = 0; i < territory.owner.size(); ++i) {
            if (territory.owner[i] == Territory::nobody) continue;
            ++owned;
            const SceneGenet& owner = genets[territory.owner[i]];
            EXPECT_EQ(grown.habitat.surfels()[i].at.x > 0.0F,
                      grown.habitat.surfels()[owner.surfel].at.x > 0.0F);
        }
        EXPECT_GT(owned, 0U);
    }
}

TEST(SceneMycelia, HaveWhatTheyReachFirstAndDoNotGrowThroughEachOther) {
    const Grown grown(shape_of(planks()), scenes::wood_species());
    const WorldTime time = time_of(60, 1);
    const auto genets = grown.until(60);
    const Territory territory = territory_of(grown.habitat, grown.species, genets, time);
    std::set<std::uint32_t> owners;
    for (std::uint32_t i = 0; i < territory.owner.size(); ++i) {
        const std::uint32_t owner = territory.owner[i];
        if (owner == Territory::nobody) continue;
        owners.insert(owner);
        const Genet& genet = genets[owner].genet;
        EXPECT_TRUE(genet.lives_at(time));
        const auto away = static_cast<double>(territory.distance[i]);
        EXPECT_LE(away, radius_at(genet, time) + 1e-5);
        EXPECT_GE(away + 1e-5,
                  glm::length(glm::dvec3(grown.habitat.surfels()[i].at) -
                              glm::dvec3(grown.habitat.surfels()[genets[owner].surfel].at)));
        // All of it is connected: some neighbour nearer to the centre is its own.
        if (i == genets[owner].surfel) continue;
        bool is_joined = false;
        for (const SurfelGraph::Way& way : grown.habitat.shape->graph.ways(i))
            is_joined = is_joined || (territory.owner[way.to] == owner &&
                                      territory.distance[way.to] < territory.distance[i]);
        EXPECT_TRUE(is_joined);
    }
    EXPECT_GE(owners.size(), 2U);
}

TEST(SceneMycelia, DoNotBeginWhereAnOlderOneIs) {
    const Grown grown(shape_of(scenes::Made().floor(-4, -4, 4, 4, 0, "grass")),
                      scenes::grass_species());
    const auto genets = grown.until(200);
    ASSERT_GT(genets.size(), 3U);
    for (std::size_t i = 0; i < genets.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const Genet &young = genets[i].genet, &old = genets[j].genet;
            if (!old.lives_at(young.born)) continue;
            const double x = metres(young.centre.x) - metres(old.centre.x),
                         y = metres(young.centre.y) - metres(old.centre.y);
            const double away = std::sqrt(x * x + y * y);
            EXPECT_GE(away, founding_distance / 1.15);
            EXPECT_GE(1.12 * away, radius_at(old, young.born));
        }
}

TEST(SceneMycelia, ComeInFromOutsideAsPartsOfCircles) {
    FungusSpecies species = scenes::grass_species();
    species.ecology.genet.reach = 12.0;
    species.ecology.genet.speed = 0.6;
    const Grown grown(shape_of(scenes::Made().floor(-3, -3, 3, 3, 0, "grass")), species);
    const auto genets = grown.until(100);
    int outside = 0;
    for (int year = 0; year <= 100; year += 20) {
        const Territory territory = territory_of(grown.habitat, species, genets, time_of(year));
        for (std::uint32_t i = 0; i < territory.owner.size(); ++i) {
            if (territory.owner[i] == Territory::nobody) continue;
            const SceneGenet& owner = genets[territory.owner[i]];
            if (!owner.is_from_outside) continue;
            ++outside;
            const Surfel& surfel = grown.habitat.surfels()[i];
            const double x = static_cast<double>(surfel.at.x) - metres(owner.genet.centre.x),
                         y = -static_cast<double>(surfel.at.z) - metres(owner.genet.centre.y);
            const double away = std::sqrt(x * x + y * y);
            EXPECT_GE(static_cast<double>(territory.distance[i]), away - 1e-3);
            EXPECT_LE(static_cast<double>(territory.distance[i]), 1.12 * away + 0.1);
            EXPECT_LE(static_cast<double>(territory.distance[i]),
                      radius_at(owner.genet, time_of(year)) + 1e-3);
        }
    }
    EXPECT_GT(outside, 1000);
}

TEST(SceneMycelia, DoNotLiveWhereThereIsNothingToLiveOn) {
    const auto rock = shape_of(scenes::Made().floor(-2, -2, 2, 2, 0, "rock"));
    EXPECT_TRUE(Grown(rock, scenes::grass_species()).until(200).empty());
    const auto grass = shape_of(scenes::Made().floor(-2, -2, 2, 2, 0, "grass"));
    EXPECT_TRUE(Grown(grass, scenes::wood_species()).until(200).empty());
    EXPECT_TRUE(Grown(grass, scenes::litter_species()).until(200).empty());
}

}  // namespace
}  // namespace sporeprint::scene_mycelia_test
