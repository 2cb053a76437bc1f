#include "core/individual/branch_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/math/elementary.h"
#include "tests/support/orders.h"
#include "tests/support/refusals.h"

namespace sporeprint::individual_branch_graph_test {
namespace {

Branched forks(int spec, MatrixKind matrix = MatrixKind::perfect) {
    Branched shape;
    shape.ramification.matrix = matrix;
    shape.ramification.order = spec;
    return shape;
}

BranchGraph grown(const Branched& shape, std::uint32_t seed = 1,
                  const BranchGraphProportions& own = {}, double bites = 0.0) {
    return branch_graph_of({{&shape, 1.0}}, own, bites, seed);
}

std::size_t tips_of(const BranchGraph& branch_graph) {
    std::size_t tips = 0;
    for (std::uint32_t i = 0; i < branch_graph.nodes.size(); ++i)
        tips += branch_graph.is_tip(i) ? 1 : 0;
    return tips;
}

double highest(const BranchGraph& branch_graph) {
    double high = 0.0;
    for (const BranchGraph::Node& node : branch_graph.nodes) high = std::max(high, node.place.y);
    return high;
}

double farthest(const BranchGraph& a, const BranchGraph& b) {
    double far = 0.0;
    for (std::size_t i = 0; i < a.nodes.size(); ++i)
        far = std::max(far, glm::distance(a.nodes[i].place, b.nodes[i].place));
    return far;
}

TEST(BranchGraph, HasTheTipsOfItsMatrixPerTrunk) {
    for (const int spec : {2, 3, 5, 8}) {
        Branched shape = forks(spec);
        shape.segments.trunks = spec == 8 ? 1 : 3;
        const BranchGraph branch_graph = grown(shape);
        const auto trunks = static_cast<std::size_t>(shape.segments.trunks);
        EXPECT_EQ(tips_of(branch_graph), trunks << (spec - 1));
        EXPECT_EQ(branch_graph.nodes.size(), 2 * tips_of(branch_graph) - trunks);
        int borne = 0;
        for (const std::uint32_t root : branch_graph.roots) borne += branch_graph.nodes[root].tips;
        EXPECT_EQ(static_cast<std::size_t>(borne), tips_of(branch_graph));
    }
    const Branched random = forks(4, MatrixKind::random_binary);
    EXPECT_EQ(static_cast<double>(tips_of(grown(random))), expected_tips(random.ramification));
}

TEST(BranchGraph, HasTheStatedHeightForAllAngles) {
    for (const double fork : {0.0, 30.0, 75.0})
        for (std::uint32_t seed = 1; seed < 20; ++seed) {
            Branched shape = forks(6, MatrixKind::tokunaga);
            shape.ramification.blend = 0.8;
            shape.ramification.toward = MatrixKind::perfect;
            shape.segments.fork_deg = shape.segments.tip_fork_deg = fork;
            shape.segments.height = 0.05;
            EXPECT_NEAR(highest(grown(shape, seed)), 0.05, 1e-12) << fork << ' ' << seed;
            EXPECT_NEAR(highest(grown(shape, seed, {.size = 3.0})), 0.15, 1e-12);
        }
}

TEST(BranchGraph, RadiiArePowersOfTheNumberOfTips) {
    Branched shape = forks(7);
    shape.segments.trunk_radius = 0.008;
    shape.segments.tip_radius = 0.001;
    const BranchGraph branch_graph = grown(shape);
    // 64 tips make the radius 8 times as large: the square root.
    for (const BranchGraph::Node& node : branch_graph.nodes)
        EXPECT_NEAR(node.radius, 0.001 * std::sqrt(node.tips), 1e-12);
}

TEST(BranchGraph, UnfoldsFromTheLowestForkUpwards) {
    Branched shape = forks(6);
    const auto present = [&](double unfolding) {
        shape.segments.unfolding = unfolding;
        double left = 0.0;
        for (const BranchGraph& branch_graph = grown(shape);
             const std::uint32_t root : branch_graph.roots)
            left += branch_graph.nodes[root].left;
        return left;
    };
    EXPECT_EQ(present(0.0), 1.0);
    EXPECT_EQ(present(1.0), 32.0);
    double last = 1.0;
    for (double unfolding = 0.02; unfolding <= 1.0; unfolding += 0.02) {
        const double now = present(unfolding);
        EXPECT_GE(now, last);
        last = now;
    }
    // At a fifth the lowest fork is complete, and no other has begun.
    EXPECT_NEAR(present(0.2), 2.0, 1e-9);
    // Absent segments have neither length nor radius.
    shape.segments.unfolding = 0.2;
    const BranchGraph branch_graph = grown(shape);
    for (const BranchGraph::Node& node : branch_graph.nodes) {
        if (node.presence > 0.0) continue;
        EXPECT_EQ(node.radius, 0.0);
        EXPECT_LT(glm::distance(node.place - node.beside, branch_graph.nodes[node.parent].place),
                  1e-12);
    }
}

TEST(BranchGraph, WeightsKeepTheNodesAndWeightOneReproducesTheSpecies) {
    const Branched coral = forks(6), antler = forks(3, MatrixKind::random_binary);
    const BranchGraph one = grown(coral, 5), other = grown(antler, 5);
    const auto mixed = [&](double t) {
        return branch_graph_of({{&coral, 1.0 - t}, {&antler, t}}, {}, 0.0, 5);
    };
    const BranchGraph first = mixed(0.0), last = mixed(1.0);
    EXPECT_GE(first.nodes.size(), std::max(one.nodes.size(), other.nodes.size()));
    EXPECT_LE(first.nodes.size(), one.nodes.size() + other.nodes.size());
    EXPECT_NEAR(first.reach, one.reach, 1e-9);
    EXPECT_NEAR(last.reach, other.reach, 1e-9);
    const auto there = [](const BranchGraph& branch_graph) {
        double left = 0.0;
        for (const std::uint32_t root : branch_graph.roots) left += branch_graph.nodes[root].left;
        return left;
    };
    EXPECT_NEAR(there(first), there(one), 1e-9);
    EXPECT_NEAR(there(last), there(other), 1e-9);
    BranchGraph before = first;
    for (int step = 1; step <= 64; ++step) {
        const BranchGraph now = mixed(step / 64.0);
        ASSERT_EQ(now.nodes.size(), before.nodes.size());
        EXPECT_LT(farthest(before, now), 0.08 * now.height) << step;
        before = now;
    }
}

TEST(BranchGraph, TheOrderOfSpeciesDoesNotMatter) {
    const Branched coral = forks(5), antler = forks(4, MatrixKind::random_increasing);
    const BranchGraph there = branch_graph_of({{&coral, 0.3}, {&antler, 0.7}}, {}, 0.0, 3);
    const BranchGraph back = branch_graph_of({{&antler, 0.7}, {&coral, 0.3}}, {}, 0.0, 3);
    EXPECT_NEAR(there.height, back.height, 1e-12);
    EXPECT_NEAR(there.reach, back.reach, 1e-12);
    EXPECT_EQ(there.nodes.size(), back.nodes.size());
}

TEST(BranchGraph, BitesShortenTheSameTipsProgressively) {
    const Branched shape = forks(7);
    const BranchGraph whole = grown(shape);
    std::vector<double> last(whole.nodes.size(), 0.0);
    for (const double bites : {0.2, 0.5, 1.0}) {
        const BranchGraph branch_graph = grown(shape, 1, {}, bites);
        std::size_t eaten = 0;
        for (std::uint32_t i = 0; i < branch_graph.nodes.size(); ++i) {
            if (!branch_graph.is_tip(i)) {
                EXPECT_EQ(branch_graph.nodes[i].place, whole.nodes[i].place);
                continue;
            }
            EXPECT_GE(branch_graph.nodes[i].eaten, last[i]);
            last[i] = branch_graph.nodes[i].eaten;
            eaten += last[i] > 0.0 ? 1 : 0;
        }
        EXPECT_GT(eaten, 0U) << bites;
    }
}

TEST(BranchGraph, ColourCoordinatesRunFromTheTrunkTopToEveryTip) {
    const BranchGraph branch_graph = grown(forks(5, MatrixKind::tokunaga));
    for (std::uint32_t i = 0; i < branch_graph.nodes.size(); ++i) {
        const BranchGraph::Node& node = branch_graph.nodes[i];
        if (node.parent == BranchGraph::none) {
            EXPECT_EQ(node.from_tip, 1.0);
        } else {
            EXPECT_LE(node.from_tip, branch_graph.nodes[node.parent].from_tip);
        }
        if (branch_graph.is_tip(i)) {
            EXPECT_EQ(node.from_tip, 0.0);
        }
    }
}

TEST(Branched, TooManyTipsAndNoForkAreRefused) {
    Branched shape = forks(11);
    EXPECT_EQ(problems_in(shape).at(0).path, "/ramification/order");
    EXPECT_NE(problems_in(shape).at(0).message.find("1024 tips"), std::string::npos);
    shape = forks(1);
    EXPECT_EQ(problems_in(shape).at(0).path, "/ramification/order");
    shape = forks(8);
    shape.segments.trunks = 9;
    EXPECT_FALSE(problems_in(shape).empty());
    shape.segments.trunks = 4;
    EXPECT_TRUE(problems_in(shape).empty());
}

}  // namespace
}  // namespace sporeprint::individual_branch_graph_test
