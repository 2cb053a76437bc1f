#include "core/grow/scene/scene_placements.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <set>
#include <vector>

#include "core/math/direction.h"
#include "tests/support/scene_parts.h"

namespace sporeprint::grow_scene_placements_test {
namespace {

std::vector<bool> lateral() { return lateral_species(species_of(scenes::garden_spec()), atlas()); }

TEST(ScenePlacements, TurnBracketsOutwardsAndLetAllOthersStand) {
    SceneBody body;
    body.at = {1.0, 2.0, 3.0};
    body.out = glm::normalize(glm::dvec3(1.0, 0.2, -0.5));
    body.record.id = 77;
    body.record.trunk = 5;
    const GlbTransform bracket = place_of(body, true), stem = place_of(body, false);
    EXPECT_EQ(bracket.translation, body.at);
    // The model is attached at its origin and looks along +z.
    EXPECT_NEAR(glm::length(rotated(bracket.rotation, {0.0, 0.0, 1.0}) - body.out), 0.0, 1e-9);
    EXPECT_GT(rotated(bracket.rotation, {0.0, 1.0, 0.0}).y, 0.9);
    EXPECT_NEAR(rotated(stem.rotation, {0.0, 1.0, 0.0}).y, 1.0, 1e-12);
    body.record.trunk = 0;
    EXPECT_NEAR(rotated(place_of(body, true).rotation, {0.0, 1.0, 0.0}).y, 1.0, 1e-12);
}

TEST(ScenePlacements, KnowWhichSpeciesGrowFromTheirSide) {
    EXPECT_EQ(lateral(), (std::vector<bool>{true, false, false, true}));
    EXPECT_EQ(lateral_species({"nothing"}, atlas()), std::vector<bool>{false});
}

TEST(ScenePlacements, ListWhatStandsAtAMoment) {
    const WorldTime time = scenes::garden_time();
    const auto rows =
        placements_on(scenes::garden_fungi(), scenes::garden_bodies(), time, lateral());
    ASSERT_GT(rows.size(), 5U);
    std::set<std::uint64_t> ids;
    for (const ScenePlacement& one : rows) {
        ids.insert(one.row.id);
        EXPECT_EQ(one.row.kind, PlacementKind::fungus);
        EXPECT_LE(one.row.began, time);
        EXPECT_GT(one.row.age, 0.0);
        EXPECT_LT(one.row.age, 1.0);
        EXPECT_EQ(one.soil, one.row.species == 2 ? Soil::grass : Soil::wood);
        EXPECT_EQ(one.row.trunk != 0, one.row.species != 2);
        EXPECT_EQ(one.row.host, one.row.trunk) << "a mycelium on wood fruits on its wood";
        EXPECT_LE(std::abs(one.row.place.translation.x), 2.5);
    }
    EXPECT_EQ(ids.size(), rows.size());
    EXPECT_TRUE(std::ranges::is_sorted(rows, {}, [](const auto& one) { return one.row.id; }));
    const auto grass = placements_on(scenes::garden_fungi(), scenes::garden_bodies(), time,
                                     lateral(), {false, false, true, false});
    EXPECT_LT(grass.size(), rows.size());
    for (const ScenePlacement& one : grass) EXPECT_EQ(one.row.species, 2);
}

}  // namespace
}  // namespace sporeprint::grow_scene_placements_test
