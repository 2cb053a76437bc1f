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

World edited(const WorldParams& params, WorldEdits edits) {
    return world_of(params, lookup(), ground(), in_turn,
                    std::make_shared<const WorldEdits>(settled(std::move(edits))));
}

/// Returns the greatest share of a species at one of the moments that are stored.
int most_common(const World& world, std::size_t species, std::size_t moment) {
    const std::vector<std::uint8_t>& shares = world.establishment[species].shares[moment];
    return *std::max_element(shares.begin(), shares.end());
}

TEST(World, WithoutEditsHasTheKeyOfItsParameters) {
    const WorldParams params = params_of("turf+wood");
    EXPECT_EQ(edited(params, {}).key, world(params).key);
    WorldEdits edits;
    edits.founders["turf"] = {{1.0, 2.0, 3}};
    EXPECT_NE(edited(params, edits).key, world(params).key);
    EXPECT_EQ(edited(params, edits).key, edited(params, edits).key);
}

TEST(World, HasOnlyTheFoundersOfItsEditsOfASpeciesThatTheyName) {
    const WorldParams params = params_of("turf+wood");
    WorldEdits edits;
    edits.founders["turf"] = {{-60.0, 0.0, 150}};
    const World made = edited(params, edits), drawn = world(params);
    EXPECT_EQ(made.establishment[1].shares, drawn.establishment[1].shares);
    EXPECT_GT(most_common(drawn, 0, 7), 0);
    EXPECT_EQ(most_common(made, 0, 7), 0) << "year 140";
    const auto share = [&](double x, double year) {
        return establishment_at(made.establishment[0], x, 0.0, year);
    };
    EXPECT_GT(share(-60.0, 160.0), 0.2);
    EXPECT_GT(share(-60.0, 160.0), 4.0 * share(-20.0, 160.0));
    EXPECT_GE(share(-20.0, 160.0), share(100.0, 160.0));
    EXPECT_GT(share(-20.0, 200.0), share(-20.0, 160.0));
}

TEST(World, HasASpeciesDownwindOfItsFounder) {
    WorldParams params = params_of("turf");
    params.climate.wind_focus = 5.0;
    WorldEdits edits;
    edits.founders["turf"] = {{0.0, 0.0, 100}};
    const auto middle_with_wind_from = [&](double deg) {
        params.climate.wind_from_deg = deg;
        const Establishment spread = edited(params, edits).establishment[0];
        double sum = 0.0, all = 0.0;
        for (int row = 0; row < spread.grid.side; ++row)
            for (int column = 0; column < spread.grid.side; ++column) {
                const double share = spread.shares[7][spread.grid.index(column, row)];
                sum += share * spread.grid.place(column);
                all += share;
            }
        return sum / all;
    };
    EXPECT_GT(middle_with_wind_from(270.0), 3.0);
    EXPECT_LT(middle_with_wind_from(90.0), -3.0);
}

TEST(World, HasTheEcologiesOfItsEdits) {
    const WorldParams params = params_of("pine_wood+turf");
    WorldEdits edits;
    edits.ecologies["turf"].months = {7};
    edits.ecologies["turf"].ecology.genet.speed = 0.5;
    edits.ecologies["pine_wood"].ecology.guild = Guild::ectomycorrhizal;
    edits.ecologies["pine_wood"].ecology.trees = {Text<48>("birch")};
    edits.ecologies["elsewhere"] = {};
    const World made = edited(params, edits);
    ASSERT_EQ(made.species.size(), 2U);
    EXPECT_EQ(made.species[1].months, 0x040);
    EXPECT_EQ(made.species[1].ecology.genet.speed, 0.5);
    EXPECT_EQ(most_common(world(params), 0, 10), 0);
    EXPECT_GT(most_common(made, 0, 10), 0) << "it has a host now";
}

TEST(World, MultipliesSuitabilityByItsMasks) {
    const WorldParams params = params_of("turf+wood");
    // The west is black for all, the north is half for turf: rows from north to south.
    const auto mask = [](std::vector<std::uint16_t> values) {
        return std::make_shared<const WorldMask>(WorldMask{256, 2, std::move(values)});
    };
    WorldEdits edits;
    edits.masks[mask_of_fungi] = mask({0, 65535, 0, 65535});
    edits.masks["turf"] = mask({13107, 13107, 65535, 65535});
    const World made = edited(params, edits);
    const WorldPoint north_east{units_of_metre, units_of_metre},
        south_east{units_of_metre, -units_of_metre}, west{-units_of_metre, 0};
    EXPECT_EQ(made.share_at(0, west), 0.0);
    EXPECT_EQ(made.share_at(1, west), 0.0);
    EXPECT_DOUBLE_EQ(made.share_at(0, north_east), 0.2);
    EXPECT_EQ(made.share_at(1, north_east), 1.0);
    EXPECT_EQ(made.share_at(0, south_east), 1.0);
    EXPECT_EQ(world(params).share_at(0, west), 1.0);
    for (std::size_t species = 0; species < 2; ++species) {
        const Establishment& spread = made.establishment[species];
        EXPECT_GT(most_common(made, species, 10), 0);
        for (int row = 0; row < spread.grid.side; ++row)
            for (int column = 0; column < spread.grid.side; ++column)
                if (spread.grid.place(column) < -spread.grid.cell) {
                    ASSERT_EQ(spread.shares[10][spread.grid.index(column, row)], 0);
                }
    }
    EXPECT_GT(made.bytes(), world(params).bytes());
}

TEST(World, ThinsItsTreesByAMask) {
    WorldEdits edits;
    edits.masks[mask_of_trees] = std::make_shared<const WorldMask>(
        WorldMask{256, 4, {0, 0, 0, 0, 0, 0, 65535, 0, 0, 0, 0, 0, 0, 0, 0, 0}});
    const World made = edited(params_of(""), edits);
    EXPECT_FALSE(block_of(made, {0, 0}).trees.empty());
    EXPECT_TRUE(block_of(made, {-1, 0}).trees.empty());
    EXPECT_TRUE(block_of(made, {0, 1}).trees.empty());
}

}  // namespace
}  // namespace sporeprint::world_test
