#include "core/grow/world/parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "core/grow/world/plot.h"
#include "core/world/tree_growth.h"
#include "tests/support/worlds.h"

namespace sporeprint::world_parts_test {
namespace {

WorldParams beech() {
    WorldParams params = params_of(*atlas().find_world("beech"));
    params.seed = 7;
    params.extent.value = 256;
    return params;
}

World world_with(const WorldParams& params) {
    static const auto ground = std::make_shared<const Ground>(ground_of(beech()));
    return world_of(params, lookup_in(atlas()), ground);
}

/// Returns services that the tests of one world share.
const ExecutionContext& shared() {
    static CachedParts cached;
    return cached.services;
}

TEST(WorldParts, HaveAsManyFruitBodiesAsAWoodOfTheSpecies) {
    const World world = world_with(beech());
    constexpr int first = 80, years = 6;
    double bodies = 0.0;
    for (int year = first; year < first + years; ++year) {
        const auto season = season_of_world(world, {0, 0}, year, shared());
        for (const FruitBody& body : season->bodies)
            if (body.emerged >= time_of(year) && body.emerged < time_of(year + 1)) bodies += 1.0;
    }
    const double per_plot = bodies / years / (block_side * block_side / 100.0);
    // Between those of a pine wood and of an evergreen oak wood, per 100 m² and year, and a quarter beyond.
    EXPECT_GT(per_plot, 28.0 * 0.75);
    EXPECT_LT(per_plot, 84.0 * 1.25);
}

TEST(WorldParts, OfAYearHaveWhatStillStandsFromTheYearBefore) {
    const World world = world_with(beech());
    const auto before = season_of_world(world, {0, 0}, 80, shared()),
               after = season_of_world(world, {0, 0}, 81, shared());
    std::map<std::uint64_t, FruitBody> now;
    for (const FruitBody& body : after->bodies) {
        EXPECT_TRUE(now.emplace(body.id, body).second) << "each body is there once";
        EXPECT_GT(body.gone, time_of(81));
        EXPECT_LT(body.emerged, time_of(82));
    }
    std::size_t stayed = 0;
    for (const FruitBody& body : before->bodies)
        if (body.emerged < time_of(81) && body.gone > time_of(81)) {
            ASSERT_TRUE(now.contains(body.id));
            EXPECT_EQ(now.at(body.id), body);
            ++stayed;
        }
    EXPECT_GT(stayed, 10U) << "brackets and candlesnuffs stay through the winter";
}

TEST(WorldParts, AreTheSameInEveryRectangleAndOrder) {
    const World world = world_with(beech());
    CachedParts other;
    const WorldTime time = time_of(80, 270);
    const WorldBox whole{20, 40, 60, 70};
    const std::vector<FruitBody> all = bodies_in(world, whole, time, shared());
    std::vector<FruitBody> parts;
    // Cut within a block and at the border of two.
    for (const WorldBox& box : {WorldBox{50, 64, 60, 70}, WorldBox{50, 40, 60, 64},
                                WorldBox{20, 55, 50, 70}, WorldBox{20, 40, 50, 55}}) {
        const std::vector<FruitBody> some = bodies_in(world, box, time, other.services);
        parts.insert(parts.end(), some.begin(), some.end());
    }
    std::sort(parts.begin(), parts.end(),
              [](const FruitBody& a, const FruitBody& b) { return a.id < b.id; });
    EXPECT_FALSE(all.empty());
    EXPECT_EQ(parts, all);
}

TEST(WorldParts, HaveNoBodyButBracketsWithoutRain) {
    WorldParams params = beech();
    params.climate.rain = 0.0;
    const World world = world_with(params);
    CachedParts cached;
    const auto season = season_of_world(world, {0, 0}, 80, cached.services);
    for (const FruitBody& body : season->bodies)
        EXPECT_TRUE(world.species[body.species].ecology.body.perennial);
}

TEST(WorldParts, OfTreesAreThoseOfAllBlocksThatMayShadeARectangle) {
    const World world = world_with(beech());
    const Block around = blocks_round(world, {30, 30, 40, 40}, shared());
    EXPECT_TRUE(std::is_sorted(around.trees.begin(), around.trees.end(),
                               [](const StandTree& a, const StandTree& b) { return a.id < b.id; }));
    std::map<CellIndex, std::size_t> found;
    for (const StandTree& tree : around.trees) ++found[block_at(tree.at)];
    EXPECT_EQ(found.size(), 9U) << "42 m are more than to the next block in all directions";
    for (const auto& [block, number] : found)
        EXPECT_EQ(number, trees_of_world(world, block, shared())->trees.size());
    EXPECT_LT(blocks_round(world, {-5, -5, 5, 5}, shared()).trees.size(), around.trees.size());
}

TEST(WorldParts, OfAMomentAreThoseThatAreThereThen) {
    const World world = world_with(beech());
    const WorldBox box{-8, 0, 0, 8};
    const WorldTime time = time_of(80, 270);
    Block all = blocks_round(world, box, shared());
    std::erase_if(all.trees, [&](const StandTree& tree) { return !tree.lives_at(time); });
    std::erase_if(all.dead, [&](const DeadWood& wood) {
        return !wood.stands_at(time) && !wood.lies_at(time);
    });
    const Block present = present_round(world, box, time, shared());
    EXPECT_FALSE(present.trees.empty());
    EXPECT_EQ(present.trees, all.trees);
    EXPECT_EQ(living_round(world, box, time, shared()), all.trees);
    EXPECT_EQ(trees_round(world, box, shared()), blocks_round(world, box, shared()).trees);
    EXPECT_FALSE(present.dead.empty());
    EXPECT_EQ(present.dead, all.dead);
}

TEST(WorldParts, OfASmallRectangleAreThoseOfItsBlock) {
    const World world = world_with(beech());
    for (const int year : {0, 80}) {
        const auto block = season_of_world(world, {0, 0}, year, shared());
        for (const WorldBox& box : {WorldBox{3, 50, 20, 60.5}, WorldBox{60, 60, 63, 63}}) {
            std::vector<FruitBody> inside;
            for (const FruitBody& body : block->bodies)
                if (contains(box, body.at)) inside.push_back(body);
            CachedParts other;
            EXPECT_EQ(bodies_of_year(world, box, year, other.services), inside) << year;
        }
    }
}

TEST(WorldParts, LookUpSpeciesWithTheirMonths) {
    const WorldLookup lookup = lookup_in(atlas());
    EXPECT_EQ(lookup.tree("no_such_tree"), nullptr);
    EXPECT_FALSE(lookup.species("no_such_species").has_value());
    const std::optional<SpeciesRecord> deceiver = lookup.species("laccaria_amethystina");
    ASSERT_TRUE(deceiver.has_value());
    EXPECT_EQ(deceiver->months, 0xFE0) << "June to December";
    EXPECT_NEAR(deceiver->cap_radius, 0.0175, 1e-9) << "of caps of 1 to 6 cm";
}

/// Returns how many species a square has in the mean over all squares of that side in one of 160 m, in a year.
///
/// is_ours  which species are counted
double species_in(const World& world, std::span<const FruitBody> bodies, int side,
                  const std::function<bool(const FungusSpecies&)>& is_ours) {
    std::map<std::pair<int, int>, std::set<int>> found;
    for (const FruitBody& body : bodies)
        if (is_ours(world.species[body.species])) {
            const auto cell = [&](std::int32_t at) {
                return static_cast<int>(std::floor((metres(at) + 80.0) / side));
            };
            found[{cell(body.at.x), cell(body.at.y)}].insert(body.species);
        }
    std::size_t sum = 0;
    for (const auto& [cell, species] : found) sum += species.size();
    const double squares = (160.0 / side) * (160.0 / side);
    return static_cast<double>(sum) / squares;
}

/// Returns z of species = c area^z by least squares over squares of 100 to 25,600 m².
double species_area_exponent(const World& world, std::span<const FruitBody> bodies,
                             const std::function<bool(const FungusSpecies&)>& is_ours) {
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (int k = 0; k < 5; ++k) {
        const double area = k * std::log(4.0),
                     species = std::log(species_in(world, bodies, 10 << k, is_ours));
        x += area;
        y += species;
        xx += area * area;
        xy += area * species;
    }
    return (5.0 * xy - x * y) / (5.0 * xx - x * x);
}

// Islands of trees have 0.47 for ectomycorrhizal fungi and 0.32 for saprotrophs. These are nested plots of one wood, where
// those exponents are the greater that have fewer bodies: 0.35 and 0.41 in the mean of 14 woods.
TEST(WorldParts, HaveMoreSpeciesOnLargerPlots) {
    double mycorrhizal = 0.0, saprotrophic = 0.0;
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
        WorldParams params = params_of(*atlas().find_world("mixed"));
        params.seed = seed;
        params.extent.value = 256;
        const World world =
            world_of(params, lookup_in(atlas()), std::make_shared<const Ground>(ground_of(params)));
        const CachedParts cached;
        const std::vector<FruitBody> bodies =
            bodies_of_year(world, {-80, -80, 80, 80}, 80, cached.services);
        const auto is_mycorrhizal = [](const FungusSpecies& species) {
            return species.ecology.guild == Guild::ectomycorrhizal;
        };
        const double all =
            species_area_exponent(world, bodies, [](const FungusSpecies&) { return true; });
        EXPECT_GT(all, 0.15);
        EXPECT_LT(all, 0.55);
        mycorrhizal += species_area_exponent(world, bodies, is_mycorrhizal) / 3.0;
        saprotrophic += species_area_exponent(world, bodies,
                                              [&](const FungusSpecies& species) {
                                                  return !is_mycorrhizal(species);
                                              }) /
                        3.0;
    }
    EXPECT_NEAR(mycorrhizal, 0.4, 0.15);
    EXPECT_NEAR(saprotrophic, 0.35, 0.15);
}

World edited(const WorldParams& params, WorldEdits edits) {
    static const auto ground = std::make_shared<const Ground>(ground_of(beech()));
    return world_of(params, lookup_in(atlas()), ground, in_turn,
                    std::make_shared<const WorldEdits>(std::move(edits)));
}

TEST(WorldParts, AreTheSameWithMasksThatAreWhite) {
    const auto white =
        std::make_shared<const WorldMask>(WorldMask{256, 2, std::vector<std::uint16_t>(4, 65535)});
    WorldEdits edits;
    edits.masks[mask_of_trees] = edits.masks[mask_of_fungi] = white;
    edits.masks["boletus_edulis"] = white;
    const World masked = edited(beech(), edits);
    ASSERT_FALSE(masked.masks.empty());
    CachedParts own;
    const WorldBox box{-20, -20, 20, 20};
    EXPECT_EQ(bodies_of_year(masked, box, 80, own.services),
              bodies_of_year(world_with(beech()), box, 80, shared()));
    EXPECT_EQ(blocks_round(masked, box, own.services).trees,
              blocks_round(world_with(beech()), box, shared()).trees);
}

TEST(WorldParts, HaveNoBodiesWhereAMaskIsBlack) {
    // Squares of 8 m as on a chessboard, for all; stripes of 4 m for one species.
    WorldMask squares{256, 32, {}}, stripes{256, 64, {}};
    for (int row = 0; row < 32; ++row)
        for (int column = 0; column < 32; ++column)
            squares.values.push_back(static_cast<std::uint16_t>((row + column) % 2 * 65535));
    for (int row = 0; row < 64; ++row)
        for (int column = 0; column < 64; ++column)
            stripes.values.push_back(static_cast<std::uint16_t>(row % 2 * 65535));
    WorldEdits edits;
    edits.masks[mask_of_fungi] = std::make_shared<const WorldMask>(squares);
    edits.masks["hypholoma_fasciculare"] = std::make_shared<const WorldMask>(stripes);
    const World masked = edited(beech(), settled(std::move(edits)));
    std::size_t of_stripes = 0;
    const std::vector<FruitBody> bodies = bodies_of_year(masked, {-64, -64, 64, 64}, 80, shared());
    for (const FruitBody& body : bodies) {
        ASSERT_GT(squares.at(body.at), 0.0);
        if (masked.species_ids[body.species] == "hypholoma_fasciculare") {
            ASSERT_GT(stripes.at(body.at), 0.0);
            ++of_stripes;
        }
    }
    EXPECT_GT(bodies.size(), 100U);
    EXPECT_GT(of_stripes, 0U);
}

TEST(WorldParts, FruitInTheMonthsOfTheirOwnEcologies) {
    WorldParams params = beech();
    params.climate.temperature = 7.0;  // so that July is cool enough for all
    params.climate.rain = 1500.0;
    const WorldLookup lookup = lookup_in(atlas());
    WorldEdits edits;
    std::vector<Problem> problems;
    for (const std::string& id : species_in(params.fungi.species, "", problems))
        edits.ecologies[id] = {lookup.species(id)->ecology, {7}};
    const World july = edited(params, settled(std::move(edits)));
    std::size_t counted = 0;
    for (int year = 80; year < 84; ++year)
        for (const FruitBody& body : bodies_of_year(july, {-32, -32, 32, 32}, year, shared())) {
            if (july.species[body.species].ecology.body.perennial) continue;
            const int day = day_of_year(body.emerged);
            // July begins on day 182; ten days before and after it, and four days to emerge.
            EXPECT_GE(day, 182 - 10);
            EXPECT_LE(day, 212 + 10 + 4);
            ++counted;
        }
    EXPECT_GT(counted, 20U);
}

TEST(WorldParts, OfAMeadowWithOneFounderHaveItsSpeciesNearIt) {
    WorldParams params = small_world("meadow");
    params.fungi.species = Text<620>("marasmius_oreades");
    WorldEdits edits;
    edits.founders["marasmius_oreades"] = {{-80.0, 0.0, 60}};
    const World world =
        world_of(params, lookup_in(atlas()), std::make_shared<const Ground>(ground_of(params)),
                 in_turn, std::make_shared<const WorldEdits>(settled(std::move(edits))));
    CachedParts own;
    std::size_t near = 0, far = 0;
    for (int year = 118; year < 124; ++year)
        for (const FruitBody& body :
             bodies_of_year(world, {-128, -64, 128, 64}, year, own.services))
            ++(metres(body.at.x) < 0.0 ? near : far);
    EXPECT_GT(near, 0U);
    EXPECT_LT(10 * far, near);
    EXPECT_TRUE(bodies_of_year(world, {-128, -64, 128, 64}, 50, own.services).empty());
}

}  // namespace
}  // namespace sporeprint::world_parts_test
