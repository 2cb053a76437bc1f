#include "core/grow/world/placements.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/grow/world/plot_bodies.h"
#include "core/grow/world/plot_of_world.h"
#include "core/grow/world/plot_parts.h"
#include "core/math/direction.h"
#include "core/world/tree_growth.h"
#include "tests/support/worlds.h"

namespace sporeprint::grow_placements_test {
namespace {

constexpr WorldTime autumn = time_of(80, 270) + ticks_of_day / 2;

const World& beech() {
    static const World world = world_over_its_ground(small_world("beech"));
    return world;
}

const ExecutionContext& services() {
    static const CachedParts cached;
    return cached.services;
}

std::vector<Placement> placed_in(const WorldBox& box, const PlacementChoice& choice = {}) {
    return placements_in(beech(), box, autumn, choice, atlas(), services()).rows;
}

constexpr WorldBox all_box{-24.0, -24.0, 24.0, 24.0};

const std::vector<Placement>& everything() {
    static const std::vector<Placement> rows = placed_in(all_box);
    return rows;
}

std::vector<std::uint64_t> ids_of(const std::vector<Placement>& rows) {
    std::vector<std::uint64_t> ids;
    for (const Placement& row : rows) ids.push_back(row.id);
    return ids;
}

TEST(Placements, AreSortedByIdAndOfAllKinds) {
    std::set<PlacementKind> kinds;
    for (const Placement& row : everything()) kinds.insert(row.kind);
    EXPECT_EQ(kinds.size(), placement_kind_count) << "a beech wood has them all in autumn";
    const std::vector<std::uint64_t> ids = ids_of(everything());
    EXPECT_TRUE(std::ranges::is_sorted(ids));
    EXPECT_EQ(std::set<std::uint64_t>(ids.begin(), ids.end()).size(), ids.size());
}

TEST(Placements, OfFourQuartersAreThoseOfTheWhole) {
    std::map<std::uint64_t, Placement> of_quarters;
    for (const WorldBox& quarter :
         {WorldBox{-24, -24, 0, 0}, {0, -24, 24, 0}, {-24, 0, 0, 24}, {0, 0, 24, 24}})
        for (const Placement& row : placed_in(quarter))
            EXPECT_TRUE(of_quarters.emplace(row.id, row).second);
    ASSERT_EQ(of_quarters.size(), everything().size());
    for (const Placement& row : everything()) {
        const Placement& other = of_quarters.at(row.id);
        EXPECT_EQ(row.place.translation, other.place.translation);
        EXPECT_EQ(row.place.rotation, other.place.rotation);
        EXPECT_EQ(row.place.scale, other.place.scale);
        EXPECT_EQ(row.host, other.host);
    }
}

TEST(Placements, AreWhereAPlotShowsThem) {
    const auto world = std::make_shared<const World>(beech());
    const auto is_central = [](const Placement& row) {
        const glm::dvec3& at = row.place.translation;
        return row.kind == PlacementKind::fungus && row.trunk == 0 && std::abs(at.x) < 16.0 &&
               std::abs(at.z) < 16.0;
    };
    const auto found = std::ranges::find_if(everything(), is_central);
    ASSERT_NE(found, everything().end());
    const glm::dvec3 middle = found->place.translation;
    const auto plot = plot_of_world(world, {middle.x, -middle.z, 16.0}, autumn, services());
    const PlotContent& content = plot->content;
    const std::vector<TreeFoot> feet = feet_of(content);
    const FloorHeights floor(*content.ground, content.seed, content.micro, feet);
    const PlotFrame frame(content, floor);
    std::map<std::uint64_t, const Placement*> rows;
    for (const Placement& row : everything()) rows[row.id] = &row;
    PlotOptions options;
    const PlotTrees trees = trees_of(content, options, frame, 100'000'000, atlas(), services());
    ASSERT_FALSE(trees.trees.empty());
    for (const PlotTrees::Placed& tree : trees.trees) {
        const Placement& row = *rows.at(tree.id);
        EXPECT_LT(glm::distance(tree.place.translation + frame.origin(), row.place.translation),
                  1e-9);
        EXPECT_EQ(tree.place.rotation, row.place.rotation);
        EXPECT_EQ(tree.place.scale, row.place.scale);
        EXPECT_EQ(trees.shapes[tree.shape].spec.params.seed, row.seed);
    }
    options.textures = Textures::none;
    const PlotBodies bodies = bodies_of(content, options, frame, 100'000'000, atlas(), services());
    std::size_t on_ground = 0;
    for (const PlotBodies::Placed& body : bodies.bodies) {
        const Placement& row = *rows.at(body.id);
        EXPECT_EQ(body.age, row.age);
        if (row.trunk != 0) continue;  // its log may be cut at the border of the plot
        ++on_ground;
        EXPECT_LT(glm::distance(body.place.translation + frame.origin(), row.place.translation),
                  1e-9);
        EXPECT_EQ(body.place.rotation, row.place.rotation);
    }
    EXPECT_GT(on_ground, 0U);
}

TEST(Placements, TurnTrunksAlongTheirModels) {
    for (const Placement& row : everything()) {
        if (row.kind != PlacementKind::snag && row.kind != PlacementKind::log) continue;
        const glm::dvec3 along = rotated(row.place.rotation, {0.0, 1.0, 0.0});
        if (row.kind == PlacementKind::snag) {
            EXPECT_GT(along.y, 0.99);
        } else {
            EXPECT_LT(std::abs(along.y), 0.6);
        }
        EXPECT_GT(row.length, 0.2);
        EXPECT_GT(row.diameter, 0.01);
    }
}

TEST(Placements, NameTheHostsOfFungi) {
    std::set<std::uint64_t> trees;
    const Block around = blocks_round(beech(), {-64, -64, 64, 64}, services());
    for (const StandTree& tree : around.trees) trees.insert(tree.id);
    std::size_t with_hosts = 0;
    for (const Placement& row : everything()) {
        if (row.kind != PlacementKind::fungus) continue;
        const FungusSpecies& species = beech().species[row.species];
        EXPECT_GE(row.age, 0.0);
        EXPECT_LE(row.age, 1.0);
        EXPECT_EQ(row.trunk != 0, species.ecology.guild == Guild::wood);
        if (species.ecology.guild != Guild::ectomycorrhizal) continue;
        EXPECT_TRUE(trees.contains(row.host)) << beech().species_ids[row.species];
        ++with_hosts;
    }
    EXPECT_GT(with_hosts, 0U);
}

TEST(Placements, AreOnlyWhatIsRequested) {
    for (std::size_t kind = 0; kind < placement_kind_count; ++kind) {
        PlacementChoice choice{{}, {}};
        choice.kinds[kind] = true;
        std::vector<std::uint64_t> wanted;
        for (const Placement& row : everything())
            if (static_cast<std::size_t>(row.kind) == kind) wanted.push_back(row.id);
        EXPECT_EQ(ids_of(placed_in(all_box, choice)), wanted);
    }
    PlacementChoice one{{false, false, false, true}, std::vector<bool>(beech().species.size())};
    for (const Placement& row : everything())
        if (row.kind == PlacementKind::fungus) one.species[row.species] = true;
    const auto first = std::ranges::find(one.species, true);
    ASSERT_NE(first, one.species.end());
    const auto index = static_cast<std::size_t>(first - one.species.begin());
    std::fill(one.species.begin(), one.species.end(), false);
    one.species[index] = true;
    const std::vector<Placement> rows = placed_in(all_box, one);
    EXPECT_FALSE(rows.empty());
    for (const Placement& row : rows) EXPECT_EQ(row.species, index);
}

// Draws belong to places of all worlds, whatever their extent. Which of the trees live depends on the wetness of the
// ground, compared with that of the mean of the world, and on the light that its hills leave.
TEST(Placements, OfTreesInWorldsOfOtherExtentsAreOftenTheSame) {
    const auto trees_of_extent = [](int extent) {
        WorldParams params = small_world("beech");
        params.extent.value = extent;
        params.terrain.erosion = 0.0;
        const World world = world_over_its_ground(params);
        const CachedParts cached;
        const PlacementChoice trees{{true, false, false, false}, {}};
        std::map<std::uint64_t, Placement> rows;
        for (const Placement& row :
             placements_in(world, {-64, -64, 64, 64}, autumn, trees, atlas(), cached.services).rows)
            rows[row.id] = row;
        return rows;
    };
    const std::map<std::uint64_t, Placement> small = trees_of_extent(256),
                                             large = trees_of_extent(1024);
    std::size_t both = 0;
    for (const auto& [id, row] : small) {
        const auto other = large.find(id);
        if (other == large.end()) continue;
        ++both;
        EXPECT_EQ(row.place.translation.x, other->second.place.translation.x);
        EXPECT_EQ(row.place.translation.z, other->second.place.translation.z);
        EXPECT_EQ(row.began, other->second.began);
    }
    EXPECT_GT(both, small.size() * 3 / 5);
}

TEST(Placements, HaveModelsOfTheTreesOfTheDay) {
    const Placements autumnal =
                         placements_in(beech(), {0, 0, 8, 8}, autumn, {}, atlas(), services()),
                     winter = placements_in(beech(), {0, 0, 8, 8}, time_of(80, 20), {}, atlas(),
                                            services());
    ASSERT_EQ(autumnal.trees.size(), beech().stand.kinds.size() * tree_shapes_of_kind);
    EXPECT_GT(autumnal.trees.front().params.look.leaves.per_tip, 0);
    EXPECT_EQ(winter.trees.front().params.look.leaves.per_tip, 0) << "beeches are bare";
    EXPECT_EQ(autumnal.trees[3].params.seed, 4U);
}

}  // namespace
}  // namespace sporeprint::grow_placements_test
