#include "core/world/stand.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/math/elementary.h"
#include "core/world/tree_growth.h"

namespace sporeprint::stand_test {
namespace {

Stand stand_of(std::uint32_t seed, double density = 0.7) {
    Stand stand;
    stand.seed = seed;
    stand.params.density = density;
    stand.kinds.push_back({"broadleaf", 1.0, {}});
    return stand;
}

Site everywhere(WorldPoint) { return {}; }

/// Returns the trees of a square of blocks.
std::vector<StandTree> trees_of_square(const Stand& stand, int blocks) {
    std::vector<StandTree> out;
    for (int y = 0; y < blocks; ++y)
        for (int x = 0; x < blocks; ++x) {
            const std::vector<StandTree> trees = trees_of(stand, everywhere, {x, y});
            out.insert(out.end(), trees.begin(), trees.end());
        }
    return out;
}

double hectares(int blocks) { return blocks * blocks * block_side * block_side / 1e4; }

double distance(const StandTree& a, const StandTree& b) {
    const double x = metres(a.at.x - b.at.x), y = metres(a.at.y - b.at.y);
    return std::sqrt(x * x + y * y);
}

bool is_in_block(const StandTree& tree, CellIndex block) {
    const double x = metres(tree.at.x) - block.x * block_side,
                 y = metres(tree.at.y) - block.y * block_side;
    return x >= 0.0 && x < block_side && y >= 0.0 && y < block_side;
}

TEST(Stand, IsAsDenseAsAWoodThatNobodyManages) {
    constexpr int blocks = 4;
    const std::vector<StandTree> trees = trees_of_square(stand_of(7), blocks);
    for (const int year : {20, 180}) {
        const WorldTime now = time_of(year);
        std::vector<StandTree> tall;
        double basal_area = 0.0;
        for (const StandTree& tree : trees) {
            if (!tree.lives_at(now) || height_at(tree, now) < 5.0) continue;
            tall.push_back(tree);
            const double diameter = trunk_diameter(height_at(tree, now));
            basal_area += pi / 4.0 * diameter * diameter;
        }
        const double density = static_cast<double>(tall.size()) / hectares(blocks);
        EXPECT_GT(density, 230.0);
        EXPECT_LT(density, 420.0);
        EXPECT_GT(basal_area / hectares(blocks), 20.0);
        EXPECT_LT(basal_area / hectares(blocks), 40.0);
        // The index of Clark and Evans: 1 for places without any rule, more where they avoid each other.
        double sum = 0.0;
        for (const StandTree& tree : tall) {
            double nearest = 1e9;
            for (const StandTree& other : tall)
                if (other.id != tree.id) nearest = std::min(nearest, distance(tree, other));
            sum += nearest;
        }
        const double index =
            sum / static_cast<double>(tall.size()) * 2.0 * std::sqrt(density / 1e4);
        EXPECT_GT(index, 1.1);
        EXPECT_LT(index, 1.3);
    }
}

TEST(Stand, ThinsOutAsItsTrunksGrow) {
    // Nothing but competition kills these trees, and no storm comes soon.
    Stand stand = stand_of(7, 1.0);
    stand.params.patch_years = 400;
    stand.kinds[0].ecology.life = 1e4;
    constexpr int classes = 13;
    std::vector<double> count(classes, 0.0), squares(classes, 0.0);
    for (const StandTree& tree : trees_of_square(stand, 4))
        for (int year = 0; year < 200; year += 10) {
            if (!tree.lives_at(time_of(year))) continue;
            const auto age =
                static_cast<std::size_t>(years_between(tree.born, time_of(year)) / 10.0);
            if (age >= classes) continue;
            const double diameter = trunk_diameter(height_at(tree, time_of(year)));
            count[age] += 1.0;
            squares[age] += diameter * diameter;
        }
    // Numbers on the ground that has trees of an age, against the mean diameter at that age.
    std::vector<double> x, y;
    for (std::size_t age = 4; age < classes; ++age) {
        const double years = 10.0 * static_cast<double>(age) + 5.0, scale = 400.0 / 0.886227;
        x.push_back(std::log(std::sqrt(squares[age] / count[age])));
        y.push_back(std::log(count[age]) + years * years / (scale * scale));
    }
    double mean_x = 0.0, mean_y = 0.0, products = 0.0, squares_of_x = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        mean_x += x[i] / static_cast<double>(x.size());
        mean_y += y[i] / static_cast<double>(x.size());
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        products += (x[i] - mean_x) * (y[i] - mean_y);
        squares_of_x += (x[i] - mean_x) * (x[i] - mean_x);
    }
    EXPECT_NEAR(products / squares_of_x, -1.6, 0.15);
}

TEST(Stand, HasItsTreesByIdAndEachInOneBlockOnly) {
    std::set<std::uint64_t> ids;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const std::vector<StandTree> trees = trees_of(stand_of(3), everywhere, {x, y});
            EXPECT_TRUE(
                std::is_sorted(trees.begin(), trees.end(),
                               [](const StandTree& a, const StandTree& b) { return a.id < b.id; }));
            for (const StandTree& tree : trees) {
                EXPECT_TRUE(is_in_block(tree, {x, y}));
                EXPECT_LT(tree.born, tree.died);
                EXPECT_TRUE(ids.insert(tree.id).second) << tree.id;
            }
        }
}

TEST(Stand, DependsOnNothingBeyondTwentyMetres) {
    const CellIndex block{-2, 3};
    const auto desert = [&](WorldPoint at) {
        const double x = metres(at.x) - block.x * block_side,
                     y = metres(at.y) - block.y * block_side;
        const bool is_near =
            x >= -20.0 && x < block_side + 20.0 && y >= -20.0 && y < block_side + 20.0;
        return Site{.wetness = is_near ? 0.5 : 2.0};  // no tree tolerates more than 1
    };
    EXPECT_EQ(trees_of(stand_of(5), everywhere, block), trees_of(stand_of(5), desert, block));
}

TEST(Stand, LeavesNoTreeWithinTheCircleOfAStrongerOne) {
    const WorldTime now = time_of(90);
    const std::vector<StandTree> trees = trees_of_square(stand_of(2), 2);
    std::size_t living = 0, covered = 0;
    for (const StandTree& tree : trees) {
        if (!tree.lives_at(now)) continue;
        ++living;
        // A tree that is ten years older is stronger, whatever the vigour of both.
        covered += std::any_of(trees.begin(), trees.end(), [&](const StandTree& other) {
            return other.lives_at(now) && other.born + 10 * ticks_of_year < tree.born &&
                   distance(tree, other) < crown_radius(height_at(other, now)) - 0.01;
        });
    }
    // Competition ends after a few rounds, before the last pairs have settled.
    EXPECT_LE(static_cast<double>(covered), 0.03 * static_cast<double>(living));
}

TEST(Stand, FallsPatchByPatchInStorms) {
    std::map<WorldTime, std::size_t> felled;
    for (const StandTree& tree : trees_of_square(stand_of(4), 3))
        if (tree.by_storm) ++felled[tree.died];
    ASSERT_FALSE(felled.empty());
    std::size_t most = 0;
    for (const auto& [moment, number] : felled) most = std::max(most, number);
    EXPECT_GT(most, 10U);
}

TEST(Stand, HasTheKindsThatSuitTheirPlaces) {
    Stand stand = stand_of(1);
    stand.kinds = {{"dry", 0.5, {}}, {"wet", 0.5, {}}};
    stand.kinds[0].ecology.wetness = {{0.0, 0.5}, {0.0, 0.4}};
    stand.kinds[1].ecology.wetness = {{0.5, 1.0}, {0.6, 1.0}};
    const auto wet_in_the_east = [](WorldPoint at) {
        return Site{.wetness = metres(at.x) < 32.0 ? 0.2 : 0.8};
    };
    std::set<int> kinds;
    for (const StandTree& tree : trees_of(stand, wet_in_the_east, {0, 0})) {
        EXPECT_EQ(tree.kind, metres(tree.at.x) < 32.0 ? 0 : 1);
        kinds.insert(tree.kind);
    }
    EXPECT_EQ(kinds.size(), 2U);
    const auto under_water = [](WorldPoint) { return Site{.wetness = 2.0}; };
    EXPECT_TRUE(trees_of(stand, under_water, {0, 0}).empty());
}

TEST(Stand, IsTheSameWhereLightIsKnownOnlyIfItDecides) {
    Stand stand = stand_of(3, 0.6);
    stand.kinds[0].ecology.light = {{0.01, 1.0}, {0.3, 1.0}};
    stand.kinds[0].share = 0.5;
    stand.kinds.push_back({"birch", 0.3, {}});
    stand.kinds[1].ecology.light = {{0.1, 1.0}, {0.7, 1.0}};
    stand.kinds.push_back({"fern", 0.2, {}});
    stand.kinds[2].ecology.light = {{0.0, 0.9}, {0.0, 0.4}};
    int called = 0, dim = 0;
    const auto light_at = [](WorldPoint at) { return 0.5 + 0.5 * ((at.x >> 16 & 15) / 15.0); };
    const SiteAt site = [&](WorldPoint at) {
        ++called;
        return Site{.light = light_at(at)};
    };
    const std::vector<StandTree> trees = trees_of(stand, site, {1, -1});
    const int before = std::exchange(called, 0);
    EXPECT_EQ(trees_of(stand, site, {1, -1},
                       [&](WorldPoint at) {
                           ++dim;
                           return Site{.light = 0.5 * light_at(at)};
                       }),
              trees);
    EXPECT_EQ(dim, before);
    EXPECT_LT(called, before);
    EXPECT_GT(called, 0);
}

TEST(Stand, HasNoTreeAboveTheGreatestHeight) {
    const Stand stand = stand_of(3);
    double highest = 0.0;
    for (const StandTree& tree : trees_of(stand, everywhere, {0, 0}))
        highest = std::max(highest, tree.height);
    EXPECT_LE(highest, greatest_height(stand));
    EXPECT_GT(highest, 0.95 * greatest_height(stand));
}

TEST(Stand, HasAGladeAndALoneTree) {
    Stand stand = stand_of(1);
    stand.params.glade = 30.0;
    stand.lone = std::uint8_t{0};
    std::size_t at_the_centre = 0;
    for (const CellIndex block : {CellIndex{-1, -1}, {-1, 0}, {0, -1}, {0, 0}})
        for (const StandTree& tree : trees_of(stand, everywhere, block)) {
            const double away = distance(tree, {});
            if (away > 0.0) {
                EXPECT_GE(away, 30.0);
                continue;
            }
            ++at_the_centre;
            EXPECT_EQ(tree.born, 0);
            EXPECT_TRUE(tree.lives_at(time_of(5)));
        }
    EXPECT_EQ(at_the_centre, 1U);
    stand.params.density = 0.0;
    EXPECT_EQ(trees_of(stand, everywhere, {0, 0}).size(), 1U);
    EXPECT_TRUE(trees_of(stand, everywhere, {1, 1}).empty());
}

/// Returns a mask of squares of 16 m over a world of 256 m.
std::shared_ptr<const WorldMask> mask_of(const auto& value) {
    WorldMask mask{256, 16, {}};
    for (int row = 0; row < 16; ++row)
        for (int column = 0; column < 16; ++column)
            mask.values.push_back(static_cast<std::uint16_t>(value(column, row)));
    return std::make_shared<const WorldMask>(std::move(mask));
}

TEST(Stand, WithAMaskThatIsWhiteIsTheSame) {
    Stand masked = stand_of(7);
    masked.mask = mask_of([](int, int) { return 65535; });
    EXPECT_EQ(trees_of(masked, everywhere, {0, 0}), trees_of(stand_of(7), everywhere, {0, 0}));
}

TEST(Stand, OfAThirdOfTheSeedlingsIsOneOfAThirdOfTheDensity) {
    Stand masked = stand_of(7, 0.75);
    masked.mask = mask_of([](int, int) { return 21845; });
    EXPECT_EQ(trees_of(masked, everywhere, {0, 0}),
              trees_of(stand_of(7, 0.75 * (21845 / 65535.0)), everywhere, {0, 0}));
}

TEST(Stand, HasNoTreesWhereItsMaskIsBlack) {
    Stand masked = stand_of(7);
    // Every second square of 16 m, as on a chessboard.
    masked.mask = mask_of([](int column, int row) { return (column + row) % 2 * 65535; });
    std::size_t beside = 0;
    for (const StandTree& tree : trees_of_square(masked, 2)) {
        ASSERT_GT(masked.mask->at(tree.at), 0.0);
        ++beside;
    }
    EXPECT_GT(beside, 100U);
}

TEST(Stand, HasItsLoneTreeUnlessItsMaskIsBlackThere) {
    Stand stand = stand_of(7, 0.0);
    stand.lone = 0;
    stand.mask = mask_of([](int, int) { return 1; });
    EXPECT_EQ(trees_of(stand, everywhere, {0, 0}).size(), 1U);
    stand.mask = mask_of([](int, int) { return 0; });
    EXPECT_TRUE(trees_of(stand, everywhere, {0, 0}).empty());
}

}  // namespace
}  // namespace sporeprint::stand_test
