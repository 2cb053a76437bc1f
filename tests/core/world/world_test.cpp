#include "core/world/world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>

#include "core/problems.h"

namespace sporeprint::world_test {
namespace {

/// Returns a lookup of one tree and two species: one of woods, one of turf.
WorldLookup lookup() {
    static const TreeEcology birch;
    WorldLookup lookup;
    lookup.tree = [](std::string_view id) { return id == "birch" ? &birch : nullptr; };
    lookup.species = [](std::string_view id) -> std::optional<SpeciesRecord> {
        SpeciesRecord record;
        record.months = 0x0C0;  // July and August
        record.ecology.guild = id == "wood" ? Guild::ectomycorrhizal : Guild::grass;
        if (id == "wood") record.ecology.trees = {Text<48>("birch")};
        if (id == "pine_wood") {
            record.ecology.guild = Guild::ectomycorrhizal;
            record.ecology.trees = {Text<48>("pine")};
        }
        if (id == "nothing") return std::nullopt;
        return record;
    };
    return lookup;
}

WorldParams params_of(std::string_view species) {
    WorldParams params;
    params.seed = 7;
    params.extent.value = 256;
    params.stand.kinds = Text<256>("birch");
    params.fungi.species = Text<620>(species);
    return params;
}

const std::shared_ptr<const Ground>& ground() {
    static const auto ground = std::make_shared<const Ground>(ground_of(params_of("")));
    return ground;
}

World world(const WorldParams& params) { return world_of(params, lookup(), ground()); }

TEST(World, HasTheKindsAndSpeciesOfItsParameters) {
    WorldParams params = params_of("turf+wood");
    params.stand.lone = Text<48>("birch");
    const World made = world(params);
    ASSERT_EQ(made.stand.kinds.size(), 1U);
    EXPECT_EQ(made.stand.kinds[0].share, 1.0);
    EXPECT_EQ(made.stand.lone, std::uint8_t{0});
    EXPECT_EQ(made.species_ids, (std::vector<std::string>{"turf", "wood"}));
    EXPECT_EQ(made.establishment.size(), 2U);
    EXPECT_GT(made.autumn_water, 0.0);
    EXPECT_LT(made.autumn_water, most_soil_water);
    EXPECT_GT(made.bytes(), 1'000'000U);
}

TEST(World, NamesWhatIsNotKnown) {
    const auto path_of = [](const WorldParams& params) {
        try {
            static_cast<void>(world(params));
        } catch (const InvalidInput& problem) {
            return problem.problems().front().path;
        }
        return std::string();
    };
    WorldParams params = params_of("");
    EXPECT_EQ(path_of(params), "");
    params.stand.lone = Text<48>("oak");
    EXPECT_EQ(path_of(params), "stand.lone");
    params.stand.kinds = Text<256>("birch+oak");
    EXPECT_EQ(path_of(params), "stand.kinds");
    EXPECT_EQ(path_of(params_of("nothing")), "fungi.species");
}

TEST(World, HasNoSpeciesWithoutItsHosts) {
    const World made = world(params_of("pine_wood+wood"));
    const auto most = [&](std::size_t species) {
        const std::vector<std::uint8_t>& last = made.establishment[species].shares.back();
        return *std::max_element(last.begin(), last.end());
    };
    EXPECT_EQ(most(0), 0);
    EXPECT_GT(most(1), 200);
}

TEST(World, HasSeasonsOfTheSouthSouthOfTheEquator) {
    WorldParams params = params_of("wood");
    EXPECT_EQ(world(params).species[0].months, 0x0C0);
    params.climate.latitude_deg = -50;
    EXPECT_EQ(world(params).species[0].months, 0x003);  // January and February
}

TEST(World, GivesPlacesBeyondItTheGroundOfItsRim) {
    const World made = world(params_of(""));
    const WorldPoint rim{128 * units_of_metre, 0}, beyond{300 * units_of_metre, 0};
    EXPECT_EQ(made.place_at(rim).height, made.place_at(beyond).height);
    const Site site = made.site_at(beyond);
    EXPECT_GE(site.wetness, 0.0);
    EXPECT_LE(site.wetness, 1.0);
    EXPECT_GT(site.light, 0.2);
    EXPECT_LE(site.light, 1.0);
}

TEST(World, HasTheBlocksOfARectangle) {
    EXPECT_EQ(blocks_of({0, 0, 64, 64}), (std::vector<CellIndex>{{0, 0}}));
    EXPECT_EQ(blocks_of({-1, 0, 64, 65}).size(), 4U);
    EXPECT_EQ(blocks_of({-64, -64, 0, 0}), (std::vector<CellIndex>{{-1, -1}}));
    EXPECT_TRUE(contains({0, 0, 1, 1}, {0, 0}));
    EXPECT_FALSE(contains({0, 0, 1, 1}, {units_of_metre, 0}));
}

TEST(World, HasDeadWoodOfItsTreesInABlock) {
    const World made = world(params_of(""));
    const Block block = block_of(made, {0, 0});
    std::set<std::uint64_t> trees;
    for (const StandTree& tree : block.trees) trees.insert(tree.id);
    ASSERT_GT(block.dead.size(), 10U);
    for (const DeadWood& wood : block.dead) EXPECT_TRUE(trees.contains(wood.tree));
    EXPECT_GT(block.bytes(), trees.size() * sizeof(StandTree));
}

}  // namespace
}  // namespace sporeprint::world_test
