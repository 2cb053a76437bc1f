#include "core/world/mycelia.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/math/random.h"
#include "core/world/tree_growth.h"
#include "tests/support/fungi.h"

namespace sporeprint::mycelia_test {
namespace {

using namespace fungi;

constexpr int epoch = 2;

/// A stand that is old enough for the history of all species, five blocks by five about block (0, 0).
const Grove& stand() {
    static const Grove trees = stand_of(-2, -2, 2, 2, -130, 170);
    return trees;
}

/// Returns the trees and the wood of some blocks about one.
Grove near(const Grove& all, CellIndex block, int blocks) {
    const auto is_in = [&](WorldPoint place) {
        const CellIndex other = block_at(place);
        return std::abs(other.x - block.x) <= blocks && std::abs(other.y - block.y) <= blocks;
    };
    Grove out;
    for (const StandTree& tree : all.trees)
        if (is_in(tree.at)) out.trees.push_back(tree);
    for (const DeadWood& wood : all.wood)
        if (is_in(wood.at)) out.wood.push_back(wood);
    return out;
}

std::vector<Genet> living(const std::vector<Genet>& genets, WorldTime time) {
    std::vector<Genet> out;
    std::ranges::copy_if(genets, std::back_inserter(out),
                         [&](const Genet& genet) { return genet.lives_at(time); });
    return out;
}

/// Returns the mycelia of three blocks by three.
std::vector<Genet> genets_of_nine(const Fungi& fungi, int of_epoch = epoch) {
    std::vector<Genet> out;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const std::vector<Genet> genets = genets_of(fungi, {x, y}, of_epoch, stand().around());
            out.insert(out.end(), genets.begin(), genets.end());
        }
    return out;
}

TEST(Blocks, IncludeTheirSouthernAndWesternBorders) {
    EXPECT_EQ(block_at({0, 0}), (CellIndex{0, 0}));
    EXPECT_EQ(block_at({-1, 0}), (CellIndex{-1, 0}));
    EXPECT_EQ(block_at(point(63.999, 64.0)), (CellIndex{0, 1}));
    EXPECT_EQ(block_at(point(-64.0, -64.001)), (CellIndex{-1, -2}));
}

TEST(Kinds, AreAllIfAnEcologyNamesNone) {
    const std::vector<std::string> kinds{"beech", "birch", "spruce"};
    Ecology ecology;
    EXPECT_EQ(kinds_of(ecology, kinds), 0xFFFFFFFFU);
    ecology.trees = {Text<48>("birch"), Text<48>("pine")};
    EXPECT_EQ(kinds_of(ecology, kinds), 0b010U);
}

TEST(Suitability, IsTheLeastOfTheResponses) {
    Ecology ecology;
    ecology.light = {{0.0, 1.0}, {0.5, 1.0}};
    ecology.acidity = {{0.0, 1.0}, {0.0, 0.5}};
    const double best = suitability(ecology, {.light = 0.7, .wetness = 0.5, .acidity = 0.3});
    EXPECT_DOUBLE_EQ(best, 1.0);
    const double dark = suitability(ecology, {.light = 0.1, .wetness = 0.5, .acidity = 0.7});
    EXPECT_DOUBLE_EQ(dark, 0.2);
    const double sour = suitability(ecology, {.light = 0.4, .wetness = 0.5, .acidity = 0.9});
    EXPECT_DOUBLE_EQ(sour, 0.2);
}

TEST(Genets, AreAsDenseAsInMatureForestsAndApart) {
    const EvenHabitat habitat;
    const std::vector<FungusSpecies> species{boletus("a"), boletus("b"), boletus("c")};
    const std::vector<Genet> all = genets_of_nine({5, species, habitat});
    constexpr double hectares = 9.0 * 0.4096;
    for (const int year : {80, 95, 110, 119}) {
        const WorldTime time = time_of(year, 250);
        const std::vector<Genet> genets = living(all, time);
        std::map<int, int> counts;
        for (const Genet& a : genets) {
            ++counts[a.species];
            EXPECT_LE(2.0 * radius_at(a, time), 16.0);
            for (const Genet& b : genets) {
                if (a.species != b.species || a.born > b.born || a.id == b.id) continue;
                EXPECT_GE(distance(a.centre, b.centre), 1.5 - 1e-4);
                EXPECT_GE(distance(a.centre, b.centre), radius_at(a, b.born) - 1e-4);
            }
        }
        for (const auto& [which, count] : counts) {
            EXPECT_GE(count / hectares, 30.0) << which << " in year " << year;
            EXPECT_LE(count / hectares, 120.0) << which << " in year " << year;
        }
        EXPECT_EQ(counts.size(), 3U);
    }
}

TEST(Genets, LiveNoLongerThanTheirHostsAndBeginAmongItsRoots) {
    const EvenHabitat habitat;
    const std::vector<FungusSpecies> species{boletus()};
    std::map<std::uint64_t, StandTree> trees;
    for (const StandTree& tree : stand().trees) trees[tree.id] = tree;
    const std::vector<Genet> genets = genets_of_nine({5, species, habitat});
    ASSERT_GT(genets.size(), 100U);
    for (const Genet& genet : genets) {
        ASSERT_TRUE(trees.contains(genet.host));
        const StandTree& host = trees[genet.host];
        EXPECT_GE(years_between(host.born, genet.born), 12.0);
        EXPECT_LE(genet.died, host.died);
        EXPECT_LE(distance(host.at, genet.centre), 2.0 * crown_radius(height_at(host, genet.born)));
        EXPECT_LT(genet.born, time_of(120));
        EXPECT_GT(genet.died, time_of(80));
    }
}

TEST(Genets, AreTheSameFromTheEpochBefore) {
    const EvenHabitat habitat;
    const std::vector<FungusSpecies> species = forest_species();
    const Fungi fungi{5, species, habitat};
    std::vector<Genet> before = living(genets_of_nine(fungi, 1), time_of(80));
    std::vector<Genet> after = living(genets_of_nine(fungi, 2), time_of(80));
    // Those that live at the first moment of an epoch are among those of the one before if they were born then.
    std::erase_if(after, [](const Genet& genet) { return genet.born == time_of(80); });
    std::ranges::sort(before, {}, &Genet::id);
    std::ranges::sort(after, {}, &Genet::id);
    EXPECT_EQ(before, after);
    EXPECT_GT(after.size(), 500U);
}

TEST(Genets, DependOnNoOrderAndOnNothingBeyondNeighbours) {
    const EvenHabitat habitat;
    std::vector<FungusSpecies> species = forest_species();
    species.push_back(laccaria());
    const Fungi fungi{5, species, habitat};
    const std::vector<Genet> of_all = genets_of(fungi, {0, 0}, epoch, stand().around());
    Grove nine = near(stand(), {0, 0}, 1);
    std::ranges::reverse(nine.trees);
    std::ranges::reverse(nine.wood);
    EXPECT_EQ(genets_of(fungi, {0, 0}, epoch, nine.around()), of_all);
    EXPECT_TRUE(std::ranges::is_sorted(of_all, {}, &Genet::id));
    for (const Genet& genet : of_all) EXPECT_EQ(block_at(genet.centre), (CellIndex{0, 0}));
}

/// Places where spores arrive only within some metres of the block (0, 0).
class NearBlock : public EvenHabitat {
  public:
    explicit NearBlock(double most) : most_(most) {}
    [[nodiscard]] double establishment(std::size_t, WorldPoint place, WorldTime) const override {
        const double x = metres(place.x), y = metres(place.y);
        const bool is_near = x >= -most_ && y >= -most_ && x < 64.0 + most_ && y < 64.0 + most_;
        return is_near ? 1.0 : 0.0;
    }

  private:
    double most_;
};

TEST(Genets, InfluenceEachOtherWithinThreeTimesTheirReach) {
    FungusSpecies fast = boletus();
    fast.ecology.genet.speed = 1.0;
    fast.ecology.genet.rate = 0.001;
    const std::vector<FungusSpecies> species{fast};
    const EvenHabitat everywhere;
    int changed = 0;
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        const auto genets = [&](const Habitat& habitat) {
            return genets_of({seed, species, habitat}, {0, 0}, epoch, stand().around());
        };
        const std::vector<Genet> all = genets(everywhere);
        EXPECT_EQ(genets(NearBlock(24.0)), all) << seed;
        if (genets(NearBlock(4.0)) != all) ++changed;
    }
    // The test can fail: neighbours within the reach do matter.
    EXPECT_GT(changed, 0);
}

TEST(Genets, NeedHostsSporesAndLight) {
    const std::vector<FungusSpecies> species = forest_species();
    EvenHabitat habitat;
    const auto count = [&](const Surroundings& around) {
        const Fungi fungi{5, species, habitat};
        std::vector<int> counts(species.size(), 0);
        for (const Genet& genet : genets_of(fungi, {0, 0}, epoch, around)) ++counts[genet.species];
        return counts;
    };
    habitat.site.light = 0.9;
    for (const int number : count(stand().around())) EXPECT_GT(number, 0);
    const std::vector<int> bare = count({});
    for (std::size_t i = 0; i < species.size(); ++i)
        EXPECT_EQ(bare[i] > 0, species[i].ecology.guild == Guild::grass) << i;
    habitat.site.light = 0.1;
    EXPECT_EQ(count(stand().around())[8], 0) << "turf in the shade";
    habitat.established = 0.0;
    for (const int number : count(stand().around())) EXPECT_EQ(number, 0);
}

TEST(Genets, OfOtherKindsOfTreesDoNotGrowHere) {
    const EvenHabitat habitat;
    std::vector<FungusSpecies> species = forest_species();
    for (FungusSpecies& one : species) one.kinds = 0b10;  // all trees are of kind 0
    for (const Genet& genet : genets_of({5, species, habitat}, {0, 0}, epoch, stand().around()))
        EXPECT_EQ(species[genet.species].ecology.guild, Guild::grass);
}

TEST(Genets, OnWoodLieOnTrunksWithinTheirWindowOfDecay) {
    const EvenHabitat habitat;
    const std::vector<FungusSpecies> species{hypholoma(), fomes()};
    std::map<std::uint64_t, DeadWood> trunks;
    for (const DeadWood& wood : stand().wood) trunks[wood.id] = wood;
    const std::vector<Genet> genets = genets_of_nine({5, species, habitat});
    std::array<int, 2> counts{};
    for (const Genet& genet : genets) {
        ASSERT_TRUE(trunks.contains(genet.host));
        const DeadWood& wood = trunks[genet.host];
        const Ecology& ecology = species[genet.species].ecology;
        ++counts[genet.species];
        // A tick is less than 1e-5 of a trunk.
        EXPECT_GE(mass_lost(wood, genet.born), ecology.decay.from - 1e-5);
        EXPECT_LE(mass_lost(wood, genet.died), ecology.decay.to + 1e-5);
        EXPECT_LE(genet.died, wood.gone);
        EXPECT_GE(genet.born, ecology.on_standing_wood ? wood.died : wood.fell);
        const double along = distance(wood.at, genet.centre);
        EXPECT_LE(along, wood.length + 1e-4);
        const WorldPoint on_axis{
            wood.at.x + static_cast<std::int32_t>(along * cosine(wood.direction) * units_of_metre),
            wood.at.y + static_cast<std::int32_t>(along * sine(wood.direction) * units_of_metre)};
        EXPECT_LT(distance(on_axis, genet.centre), 1e-3);
        for (const Genet& other : genets)
            if (other.host == genet.host && other.species == genet.species &&
                other.born < genet.born && other.died > genet.born) {
                EXPECT_GE(distance(other.centre, genet.centre),
                          radius_at(other, genet.born) - 1e-4);
            }
    }
    EXPECT_GT(counts[0], 100);
    EXPECT_GT(counts[1], 30);
}

TEST(Genets, OfPioneersBeginWithTheirHosts) {
    const EvenHabitat habitat;
    const std::vector<FungusSpecies> species{laccaria()};
    const std::vector<StandTree> trees{young_birch(time_of(0, 200))};
    int begun = 0;
    for (std::uint32_t seed = 0; seed < 100; ++seed)
        for (const Genet& genet : genets_of({seed, species, habitat}, {0, 0}, 0, {trees, {}})) {
            EXPECT_EQ(genet.centre, trees[0].at);
            EXPECT_EQ(genet.host, trees[0].id);
            EXPECT_LE(years_between(trees[0].born, genet.born), 0.25);
            ++begun;
        }
    // 1 - e^-5 of all.
    EXPECT_GE(begun, 96);
}

TEST(Genets, OfNoRateAreNone) {
    const EvenHabitat habitat;
    std::vector<FungusSpecies> species = forest_species();
    species.push_back(laccaria());
    for (FungusSpecies& one : species) one.ecology.genet.rate = 0.0;
    EXPECT_TRUE(genets_of({5, species, habitat}, {0, 0}, epoch, stand().around()).empty());
}

TEST(Genets, DifferBetweenSeedsAndSpecies) {
    const EvenHabitat habitat;
    const std::vector<FungusSpecies> species{boletus("a"), boletus("b")};
    std::set<std::uint64_t> ids;
    std::size_t number = 0;
    for (const std::uint32_t seed : {1U, 2U, 3U})
        for (const Genet& genet :
             genets_of({seed, species, habitat}, {0, 0}, epoch, stand().around())) {
            ids.insert(genet.id);
            ++number;
        }
    EXPECT_EQ(ids.size(), number);
    EXPECT_GT(number, 60U);
}

Genet genet_at(WorldPoint centre, WorldTime born, std::uint64_t id) {
    Genet genet;
    genet.id = id;
    genet.centre = centre;
    genet.born = born;
    genet.died = born + 100 * ticks_of_year;
    genet.speed = 0.2;
    genet.reach = 8.0;
    return genet;
}

TEST(Radius, GrowsWithTheSpeedUpToTheReach) {
    const Genet genet = genet_at({0, 0}, time_of(10), 1);
    EXPECT_EQ(radius_at(genet, time_of(9)), 0.0);
    EXPECT_EQ(radius_at(genet, time_of(10)), 0.0);
    for (int year = 11; year < 50; ++year)
        EXPECT_DOUBLE_EQ(radius_at(genet, time_of(year)), 0.2 * (year - 10));
    EXPECT_DOUBLE_EQ(radius_at(genet, time_of(60)), 8.0);
    EXPECT_EQ(arrival(genet, 8.1), std::numeric_limits<double>::infinity());
    EXPECT_DOUBLE_EQ(arrival(genet, 3.0), 25.0);
}

TEST(Owner, IsTheFirstThatArrives) {
    Random random(3, 1);
    std::vector<Genet> genets;
    for (std::uint64_t i = 0; i < 12; ++i) {
        const double x = random.uniform(0.0, 12.0), y = random.uniform(0.0, 12.0);
        const int year = static_cast<int>(random.uniform(0.0, 40.0));
        genets.push_back(genet_at(point(x, y), time_of(year), i + 1));
    }
    const WorldTime time = time_of(45);
    int owned = 0;
    for (int i = 0; i < 500; ++i) {
        const double x = random.uniform(-2.0, 14.0), y = random.uniform(-2.0, 14.0);
        const WorldPoint place = point(x, y);
        const Genet* owner = owner_of(genets, 0, place, time);
        const bool is_reached = std::ranges::any_of(genets, [&](const Genet& genet) {
            return distance(genet.centre, place) < radius_at(genet, time) - 1e-9;
        });
        EXPECT_EQ(owner != nullptr, is_reached);
        if (owner == nullptr) continue;
        ++owned;
        for (const Genet& genet : genets)
            EXPECT_LE(arrival(*owner, distance(owner->centre, place)),
                      arrival(genet, distance(genet.centre, place)));
    }
    EXPECT_GT(owned, 200);
    EXPECT_EQ(owner_of(genets, 1, genets[0].centre, time), nullptr) << "of another species";
}

TEST(Owner, ChangesOnceWhereTwoMarginsMet) {
    // Of equal age, on the bisector; the older one has as much more as it is ahead.
    const std::vector<Genet> genets{genet_at(point(0.0, 0.0), time_of(0), 1),
                                    genet_at(point(6.0, 0.0), time_of(5), 2)};
    for (int i = 0; i <= 60; ++i) {
        const double x = 0.1 * i;
        const Genet* owner = owner_of(genets, 0, point(x, 0.0), time_of(60));
        ASSERT_NE(owner, nullptr);
        if (std::abs(x - 3.5) > 0.05) {
            EXPECT_EQ(owner->id, x < 3.5 ? 1U : 2U) << x;
        }
    }
    // What is dead has nothing.
    EXPECT_EQ(owner_of(genets, 0, point(0.0, 0.0), time_of(103))->id, 2U);
}

TEST(Substrate, IsThatOfTheGuild) {
    const std::vector<StandTree> trees{young_birch(time_of(0)), StandTree{.id = 9,
                                                                          .at = point(36.0, 32.0),
                                                                          .born = time_of(-80),
                                                                          .died = time_of(80),
                                                                          .kind = 0,
                                                                          .height = 25.0}};
    DeadWood log;
    log.id = 5;
    log.at = point(10.0, 10.0);
    log.died = time_of(-10);
    log.fell = time_of(-5);
    log.gone = time_of(40);
    log.length = 12.0;
    log.radius = 0.2;
    log.decay = 0.05;
    const std::vector<DeadWood> wood{log};
    const Surroundings around{trees, wood};
    const auto at = [&](const FungusSpecies& species, double x, double y, int year) {
        return substrate_at(around, species, point(x, y), time_of(year));
    };
    EXPECT_EQ(at(boletus(), 33.0, 32.0, 5).record, 9U) << "a young birch is none of its hosts";
    EXPECT_EQ(at(laccaria(), 32.5, 32.0, 5).record, 4711U);
    EXPECT_FALSE(at(boletus(), 60.0, 60.0, 5).is_there);
    EXPECT_TRUE(at(clitocybe(), 40.0, 32.0, 5).is_there);
    EXPECT_FALSE(at(clitocybe(), 50.0, 32.0, 5).is_there);
    EXPECT_TRUE(at(marasmius(), 60.0, 60.0, 5).is_there);
    EXPECT_EQ(at(hypholoma(), 15.0, 10.3, 5).record, 5U);
    EXPECT_FALSE(at(hypholoma(), 15.0, 11.0, 5).is_there) << "beside the log";
    EXPECT_FALSE(at(hypholoma(), 15.0, 10.0, -7).is_there) << "it stands";
    EXPECT_FALSE(at(hypholoma(), 15.0, 10.0, 30).is_there) << "too far decayed";
    EXPECT_TRUE(at(fomes(), 10.0, 10.0, -7).is_there);
}

/// A habitat in which a place may have as much of each species as a function says.
class SharedHabitat : public EvenHabitat {
  public:
    double of_west = 1.0, of_east = 1.0;
    [[nodiscard]] double share(std::size_t, WorldPoint place) const override {
        return place.x < point(32.0, 0.0).x ? of_west : of_east;
    }
};

TEST(Genets, AreThoseOfASuitabilityThatTheShareMultiplies) {
    const std::vector<FungusSpecies> species{boletus("a"), species_of("turf", Guild::grass),
                                             species_of("wood", Guild::wood)};
    // Half of the light that they tolerate makes a suitability of a half.
    std::vector<FungusSpecies> halved = species;
    for (FungusSpecies& one : halved) one.ecology.light = {{0.0, 1.0}, {1.0, 1.0}};
    EvenHabitat dim;
    dim.site.light = 0.5;
    SharedHabitat shared;
    shared.of_west = shared.of_east = 0.5;
    const std::vector<Genet> some =
        genets_of({5, species, shared}, {0, 0}, epoch, stand().around());
    EXPECT_EQ(some, genets_of({5, halved, dim}, {0, 0}, epoch, stand().around()));
    EXPECT_FALSE(some.empty());
}

TEST(Genets, AreNowhereThatMayHaveNone) {
    const std::vector<FungusSpecies> species{boletus("a"), species_of("turf", Guild::grass),
                                             species_of("wood", Guild::wood)};
    SharedHabitat shared;
    shared.of_west = 0.0;
    const std::vector<Genet> genets =
        genets_of({5, species, shared}, {0, 0}, epoch, stand().around());
    EXPECT_FALSE(genets.empty());
    for (const Genet& genet : genets) EXPECT_GE(metres(genet.centre.x), 32.0);
}

}  // namespace
}  // namespace sporeprint::mycelia_test
