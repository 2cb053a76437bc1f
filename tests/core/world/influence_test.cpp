#include "core/world/influence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/forest.h"

namespace sporeprint::influence_test {
namespace {

using namespace fungi;

/// A stand whose trees may be as tall as those of the forest.
Stand tall_stand() {
    Stand stand;
    stand.kinds.push_back({"beech", 1.0, {}});
    return stand;
}

/// Returns what a forest has within the influence on a rectangle, and the fruit bodies there in a year.
std::vector<FruitBody> bodies_alone(const Forest& all, const Region& region, int year) {
    const Influence influence = influence_on(all.species, tall_stand());
    Grove near;
    for (const StandTree& tree : all.stand.trees)
        if (region.grown(influence.trees).contains(tree.at)) near.trees.push_back(tree);
    for (const DeadWood& wood : all.stand.wood)
        if (region.grown(influence.wood).contains(wood.at)) near.wood.push_back(wood);
    const std::vector<Genet> genets =
        genets_round(all.fungi(), region, epoch_of(year), near.around());
    return season_of(all.fungi(), {region, year, genets, near.around()},
                     conditions_in(all.species, beech, 7, year), 1.0);
}

TEST(Influence, IsAllThatFruitBodiesOfARectangleDependOn) {
    const Forest all;
    constexpr std::int32_t metre = units_of_metre;
    for (const int year : {80, 103}) {
        const std::vector<FruitBody> whole = all.bodies(year);
        for (const Region& region :
             {Region(20 * metre, 30 * metre, 30 * metre, 40 * metre),
              Region(0, 0, 3 * metre, 64 * metre), Region(50 * metre, 0, 64 * metre, 9 * metre)}) {
            std::vector<FruitBody> part;
            std::ranges::copy_if(whole, std::back_inserter(part),
                                 [&](const FruitBody& body) { return region.contains(body.at); });
            EXPECT_GT(part.size(), 5U);
            EXPECT_EQ(bodies_alone(all, region, year), part);
        }
    }
}

TEST(Influence, HasTheMyceliaOfItsBlocks) {
    const Forest all;
    const Region region = Region(CellIndex{0, 0});
    const std::vector<Genet> round = genets_round(all.fungi(), region, 2, all.stand.around());
    EXPECT_TRUE(std::ranges::is_sorted(round, {}, &Genet::id));
    std::vector<Genet> inside;
    std::ranges::copy_if(round, std::back_inserter(inside),
                         [&](const Genet& genet) { return region.contains(genet.centre); });
    EXPECT_EQ(inside, genets_of(all.fungi(), {0, 0}, 2, all.stand.around()));
    EXPECT_GT(round.size(), inside.size());
}

TEST(Influence, GrowsWithReachScatterAndTrunks) {
    std::vector<FungusSpecies> species{boletus()};
    const Influence before = influence_on(species, tall_stand());
    EXPECT_EQ(before.wood, 0.0);
    species[0].ecology.fruit.cluster_spread += 0.2;
    const Influence scattered = influence_on(species, tall_stand());
    EXPECT_NEAR(scattered.light - before.light, 0.6, 1e-9);
    species[0].ecology.genet.reach -= 2.0;
    EXPECT_NEAR(influence_on(species, tall_stand()).light, scattered.light - 6.0, 1e-9);
    species.push_back(hypholoma());
    EXPECT_GT(influence_on(species, tall_stand()).wood, longest_trunk(tall_stand()));
    // Bodies of a species without tufts stand farther apart.
    EXPECT_DOUBLE_EQ(spacing_of(species),
                     std::max(2.0 * core_of(species[0]), 2.0 * core_of(species[1])));
}

TEST(Influence, OfTurfIsThatOfItsOwnMycelia) {
    std::vector<FungusSpecies> species{species_of("ring", Guild::grass)};
    species[0].ecology.genet.reach = 20.0;
    EXPECT_GE(mycelia_within(species[0].ecology, spacing_of(species)), 20.0);
    EXPECT_EQ(influence_on(species, tall_stand()).light, 0.0);
}

}  // namespace
}  // namespace sporeprint::influence_test
