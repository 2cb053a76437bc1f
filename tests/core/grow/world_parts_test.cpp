#include "core/grow/world_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>

#include "core/world/tree_growth.h"

namespace sporeprint::world_parts_test {
namespace {

const Atlas& atlas() {
    static const std::shared_ptr<const Atlas> atlas = built_in_atlas();
    return *atlas;
}

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

/// Services whose caches have no bound.
class Cached {
  public:
    Cached() {
        services.caches.blocks = [this](const std::string& key, const auto& make) {
            return get(blocks_, key, make);
        };
        services.caches.mycelia = [this](const std::string& key, const auto& make) {
            return get(mycelia_, key, make);
        };
    }
    ExecutionContext services;

  private:
    template <class T>
    static std::shared_ptr<const T> get(std::map<std::string, std::shared_ptr<const T>>& cache,
                                        const std::string& key,
                                        const std::function<std::shared_ptr<const T>()>& make) {
        std::shared_ptr<const T>& value = cache[key];
        if (!value) value = make();
        return value;
    }
    std::map<std::string, std::shared_ptr<const Block>> blocks_;
    std::map<std::string, std::shared_ptr<const BlockMycelia>> mycelia_;
};

/// Returns services that the tests of one world share.
const ExecutionContext& shared() {
    static Cached cached;
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
    Cached other;
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
    Cached cached;
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
        EXPECT_EQ(number, block_of_world(world, block, shared())->trees.size());
    EXPECT_LT(blocks_round(world, {-5, -5, 5, 5}, shared()).trees.size(), around.trees.size());
}

TEST(WorldParts, OfASmallRectangleAreThoseOfItsBlock) {
    const World world = world_with(beech());
    for (const int year : {0, 80}) {
        const auto block = season_of_world(world, {0, 0}, year, shared());
        for (const WorldBox& box : {WorldBox{3, 50, 20, 60.5}, WorldBox{60, 60, 63, 63}}) {
            std::vector<FruitBody> inside;
            for (const FruitBody& body : block->bodies)
                if (contains(box, body.at)) inside.push_back(body);
            Cached other;
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

}  // namespace
}  // namespace sporeprint::world_parts_test
