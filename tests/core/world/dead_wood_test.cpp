#include "core/world/dead_wood.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <vector>

#include "core/math/elementary.h"
#include "core/world/tree_growth.h"

namespace sporeprint::dead_wood_test {
namespace {

Stand wood() {
    Stand stand;
    stand.seed = 7;
    stand.kinds.push_back({"broadleaf", 1.0, {}});
    return stand;
}

struct Block {
    std::vector<StandTree> trees;
    std::vector<DeadWood> dead;
};

/// Returns a square of blocks, on ground of one slope.
Block blocks_of(const Stand& stand, const FallSite& slope, double downwind) {
    const auto site = [&](WorldPoint) { return slope; };
    std::map<CellIndex, std::vector<StandTree>> trees;
    std::map<CellIndex, Falls> falls;
    for (int y = -1; y < 3; ++y)
        for (int x = -1; x < 3; ++x) {
            const CellIndex at{x, y};
            trees[at] = trees_of(
                stand, [](WorldPoint) { return Site{}; }, at);
            falls[at] = falls_of(stand, trees[at], site, downwind);
        }
    Block out;
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x) {
            std::vector<const Falls*> near;
            for (int k = 0; k < 9; ++k) near.push_back(&falls.at({x + k % 3 - 1, y + k / 3 - 1}));
            const std::vector<DeadWood> dead =
                dead_wood_of(stand, trees.at({x, y}), near, site, downwind);
            out.trees.insert(out.trees.end(), trees[{x, y}].begin(), trees[{x, y}].end());
            out.dead.insert(out.dead.end(), dead.begin(), dead.end());
        }
    return out;
}

/// Returns a place along a log, metres.
glm::dvec2 place_on(const DeadWood& log, double along) {
    return {metres(log.at.x) + along * std::cos(log.direction),
            metres(log.at.y) + along * std::sin(log.direction)};
}

/// Returns whether a log lies in the trunk of a tree.
bool lies_in(const DeadWood& log, const StandTree& tree, WorldTime time) {
    const glm::dvec2 foot(metres(log.at.x), metres(log.at.y));
    if (tree.id == log.tree ||
        glm::distance(foot, {metres(tree.at.x), metres(tree.at.y)}) > log.length + 1.0)
        return false;
    const double trunk = 0.5 * trunk_diameter(height_at(tree, time));
    const glm::dvec2 at(metres(tree.at.x), metres(tree.at.y));
    for (double along = 0.0; along < length_at(log, time); along += 0.05) {
        const double own = radius_at(log, time) * taper_at(log, along);
        if (glm::distance(place_on(log, along), at) < own + trunk) return true;
    }
    return false;
}

constexpr double area = 4.0 * block_side * block_side / 1e4;  // hectares

/// Returns the volume of what is left of a dead trunk, a frustum.
double volume(const DeadWood& wood, WorldTime time) {
    const double length = length_at(wood, time), foot = radius_at(wood, time),
                 top = foot * taper_at(wood, length);
    return pi / 3.0 * (foot * foot + foot * top + top * top) * length;
}

/// Returns the places of a log and of another one at which they cross, as shares of what is left of each; nothing if they
/// lie beside each other.
std::optional<glm::dvec2> crossing(const DeadWood& a, const DeadWood& b, WorldTime time) {
    const auto along = [&](const DeadWood& log) {
        return length_at(log, time) * glm::dvec2(std::cos(log.direction), std::sin(log.direction));
    };
    const auto cross = [](const glm::dvec2& p, const glm::dvec2& q) {
        return p.x * q.y - p.y * q.x;
    };
    const glm::dvec2 p = along(a), q = along(b), between = place_on(b, 0.0) - place_on(a, 0.0);
    const double turn = cross(p, q);
    if (std::abs(turn) < 1e-9) return std::nullopt;
    const glm::dvec2 at(cross(between, q) / turn, cross(between, p) / turn);
    if (at.x < 0.0 || at.x > 1.0 || at.y < 0.0 || at.y > 1.0) return std::nullopt;
    return at;
}

TEST(DeadWood, IsAsMuchAsInAWoodThatNobodyManages) {
    const Block block = blocks_of(wood(), {}, 0.0);
    double sum = 0.0;
    for (const DeadWood& one : block.dead)
        if (one.died <= time_of(60) && time_of(60) < one.gone) sum += volume(one, time_of(60));
    EXPECT_GT(sum / area, 20.0);
    EXPECT_LT(sum / area, 150.0);
}

TEST(DeadWood, LosesItsMassByTheLawOfItsKind) {
    DeadWood beech;
    beech.died = time_of(-3);
    beech.decay = 0.054;
    beech.radius = 0.2;
    EXPECT_EQ(mass_lost(beech, time_of(-5)), 0.0);
    EXPECT_NEAR(1.0 - mass_lost(beech, time_of(7)), std::exp(-0.54), 1e-12);
    EXPECT_NEAR(radius_at(beech, time_of(7)), 0.2 * std::exp(-0.27), 1e-12);
}

TEST(DeadWood, IsThereFromTheDeathOfATreeUntilItHasDecayed) {
    const Block block = blocks_of(wood(), {}, 0.0);
    std::map<std::uint64_t, StandTree> trees;
    for (const StandTree& tree : block.trees) trees[tree.id] = tree;
    ASSERT_GT(block.dead.size(), 50U);
    for (const DeadWood& one : block.dead) {
        const StandTree& tree = trees.at(one.tree);
        EXPECT_EQ(one.died, tree.died);
        EXPECT_EQ(one.at, tree.at);
        EXPECT_EQ(one.fell == one.died, tree.by_storm);
        EXPECT_LE(years_between(one.died, one.fell), 15.0);
        EXPECT_NEAR(mass_lost(one, one.gone), 0.85, 0.001);
        EXPECT_LT(one.length, height_at(tree, tree.died));
    }
}

TEST(DeadWood, LiesDownwindAndOnSlopesAlsoDownhill) {
    const auto mean_direction = [](const std::vector<DeadWood>& dead) {
        double x = 0.0, y = 0.0;
        for (const DeadWood& one : dead) {
            x += std::cos(one.direction);
            y += std::sin(one.direction);
        }
        return std::atan2(y, x);
    };
    EXPECT_NEAR(mean_direction(blocks_of(wood(), {}, 1.0).dead), 1.0, 0.1);
    // The ground rises to the east, so that downhill is west; half of the trunks go there.
    double west = 0.0, all = 0.0;
    for (const DeadWood& one : blocks_of(wood(), {0.5, 0.0}, 0.0).dead) {
        west += std::cos(one.direction) < 0.0 ? 1.0 : 0.0;
        all += 1.0;
    }
    EXPECT_NEAR(west / all, 0.5, 0.08);
}

TEST(DeadWood, LiesBesideTreesThatLive) {
    const Block block = blocks_of(wood(), {}, 0.7);
    const WorldTime time = time_of(90);
    std::vector<StandTree> alive;
    for (const StandTree& tree : block.trees)
        if (tree.lives_at(time)) alive.push_back(tree);
    const auto lies_in_one = [&](const DeadWood& log) {
        for (const StandTree& tree : alive)
            if (lies_in(log, tree, time)) return true;
        return false;
    };
    std::size_t logs = 0, in_trunks = 0, would = 0;
    for (const DeadWood& log : block.dead) {
        if (!log.lies_at(time)) continue;
        ++logs;
        DeadWood turned = log;
        turned.direction += 0.2;
        in_trunks += lies_in_one(log) ? 1 : 0;
        would += lies_in_one(turned) ? 1 : 0;
    }
    EXPECT_GT(logs, 80U);
    EXPECT_GT(would * 14, logs) << "Hardly a log has a tree beside it.";
    EXPECT_LT(in_trunks * 25, logs);
}

TEST(DeadWood, HardlyEverLiesAcrossAnOlderTrunk) {
    const Block block = blocks_of(wood(), {}, 0.7);
    const WorldTime time = time_of(90);
    std::vector<DeadWood> logs;
    for (const DeadWood& log : block.dead)
        if (log.lies_at(time)) logs.push_back(log);
    std::size_t across = 0, would = 0;
    for (const DeadWood& log : logs)
        for (const DeadWood& other : logs) {
            if (log.id >= other.id) continue;
            DeadWood turned = log;
            turned.direction += 0.5 * pi;
            across += crossing(log, other, time) ? 1 : 0;
            would += crossing(turned, other, time) ? 1 : 0;
        }
    EXPECT_GT(would * 2, logs.size());
    EXPECT_LT(across * 12, logs.size())
        << "Trunks of other blocks turn without each other's knowledge.";
}

TEST(DeadWood, FallsAsTheWindBlowsWhereNothingStands) {
    const auto site = [](WorldPoint) { return FallSite{}; };
    const std::vector<StandTree> trees =
        trees_of(wood(), [](WorldPoint) { return Site{}; }, {0, 0});
    const Falls falls = falls_of(wood(), trees, site, 0.7);
    const std::array<const Falls*, 1> all = {&falls};
    std::map<std::uint64_t, DeadWood> among;
    for (const DeadWood& one : dead_wood_of(wood(), trees, all, site, 0.7)) among[one.id] = one;
    std::size_t turned = 0, broken = 0;
    for (const StandTree& tree : trees) {
        const std::vector<DeadWood> alone = dead_wood_of(wood(), {&tree, 1}, {}, site, 0.7);
        if (alone.empty()) continue;
        const auto nominal = std::ranges::find(falls.fallen, alone[0].id, &FallenTrunk::id);
        ASSERT_NE(nominal, falls.fallen.end());
        EXPECT_LT(glm::distance(place_on(alone[0], alone[0].length) - place_on(alone[0], 0.0),
                                glm::dvec2(nominal->east, nominal->north)),
                  1e-5);
        DeadWood same = among.at(alone[0].id);
        turned += same.direction != alone[0].direction ? 1 : 0;
        broken += same.length != alone[0].length ? 1 : 0;
        EXPECT_LE(same.length, alone[0].length);
        EXPECT_GE(same.length, std::min(1.0, alone[0].length));
        same.direction = alone[0].direction;
        same.length = alone[0].length;
        EXPECT_EQ(same, alone[0]) << "All else does not depend on what stands round it.";
    }
    EXPECT_EQ(among.size(), falls.fallen.size());
    EXPECT_GT(turned * 4, among.size());
    EXPECT_GT(broken * 20, among.size());
}

TEST(DeadWood, IsTakenAwayOrLastsLongerAsTheParameterSays) {
    const std::size_t all = blocks_of(wood(), {}, 0.0).dead.size();
    Stand managed = wood();
    managed.params.dead_wood = 0.25;
    EXPECT_NEAR(static_cast<double>(blocks_of(managed, {}, 0.0).dead.size()),
                0.25 * static_cast<double>(all), 0.06 * static_cast<double>(all));
    managed.params.dead_wood = 0.0;
    EXPECT_TRUE(blocks_of(managed, {}, 0.0).dead.empty());
    managed.params.dead_wood = 2.0;
    const TreeEcology& ecology = managed.kinds[0].ecology;
    EXPECT_NEAR(years_of_decay(managed.params, ecology),
                2.0 * years_of_decay(wood().params, ecology), 1e-9);
}

}  // namespace
}  // namespace sporeprint::dead_wood_test
