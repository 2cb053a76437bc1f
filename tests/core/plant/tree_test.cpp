#include "core/plant/tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/math/elementary.h"
#include "core/mesh/measure.h"
#include "core/params/corners.h"
#include "tests/support/atlas.h"
#include "tests/support/effort.h"
#include "tests/support/refusals.h"

namespace sporeprint::plant_tree_test {
namespace {

// Returns a tree without variation and tropisms.
TreeShape plain(int order = 5) {
    TreeShape shape;
    shape.topology.matrix = MatrixKind::random_binary;
    shape.topology.order = order;
    shape.variation = shape.gravitropism = shape.phototropism = shape.plagiotropy = 0.0;
    return shape;
}

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)) * 180.0 / pi;
}

glm::dvec3 edge(const Tree& tree, std::uint32_t node) {
    return tree.skeleton.nodes[node + 1].place -
           tree.skeleton.nodes[tree.skeleton.segments[node].from].place;
}

// Calls `use` with the index of every inner node and the node.
void each_inner(const Tree& tree, const auto& use) {
    for (std::uint32_t i = 0; i < tree.ramification.nodes.size(); ++i)
        if (!tree.ramification.leaf(i)) use(i, tree.ramification.nodes[i]);
}

TEST(Tree, MatricesAreTheNamedOnesTheirBlendsOrOnesOwn) {
    TreeTopology topology;
    topology.order = 5;
    topology.matrix = MatrixKind::perfect;
    topology.toward = MatrixKind::random_binary;
    EXPECT_EQ(matrix_of(topology), perfect_matrix(5));
    topology.blend = 1.0;
    EXPECT_EQ(matrix_of(topology), random_binary_matrix(5));
    topology.matrix = MatrixKind::own;
    topology.blend = 0.0;
    topology.rows = {{0.25, 0.75}, {0.5, 0.25, 0.25}};
    EXPECT_EQ(matrix_of(topology).rows,
              (std::vector<std::vector<double>>{{0.25, 0.75}, {0.5, 0.25, 0.25}}));
}

TEST(Tree, HasTheExpectedNumberOfTips) {
    for (const int order : {1, 3, 6}) {
        TreeShape shape = plain(order);
        const Tree tree = grown_tree(shape, 3);
        EXPECT_EQ(static_cast<double>(tree.ramification.leaves()), expected_tips(shape.topology));
        EXPECT_EQ(tree.skeleton.nodes.size(), tree.ramification.nodes.size() + 1);
    }
    // Trees at the tips are sampled, so the mean of many is compared.
    TreeShape herb = plain(4);
    herb.topology.tip_order = 3;
    double sum = 0.0, squares = 0.0;
    const auto trees = static_cast<double>(effort(300, 60));
    for (std::uint32_t seed = 0; seed < static_cast<std::uint32_t>(trees); ++seed) {
        const auto tips = static_cast<double>(grown_tree(herb, seed).ramification.leaves());
        sum += tips;
        squares += tips * tips;
    }
    const double mean = sum / trees;
    EXPECT_NEAR(mean, expected_tips(herb.topology),
                5.0 * std::sqrt((squares / trees - mean * mean) / trees));
}

// [Viennot1989]: forks turn both branches by the same angle; a node of biorder (k, i) turns its
// main branch by c i / (k - 1) and its side branch by c' (k - i) / (k - 1).
TEST(Tree, BranchesTurnByTheirBiorderInOnePlane) {
    const TreeShape shape = plain();
    const Tree tree = grown_tree(shape, 4);
    each_inner(tree, [&](std::uint32_t i, const Ramification::Node& node) {
        const std::uint32_t main = node.children[0], side = node.children[1];
        const double k = node.order, lesser = tree.ramification.nodes[side].order;
        const bool fork = tree.ramification.nodes[main].order < node.order;
        const double main_turn = fork ? shape.fork_deg : shape.main_deg * lesser / (k - 1.0);
        const double side_turn = fork ? shape.fork_deg : shape.side_deg * (k - lesser) / (k - 1.0);
        EXPECT_NEAR(degrees_between(tree.headings[i], tree.headings[main]), main_turn, 1e-4);
        EXPECT_NEAR(degrees_between(tree.headings[i], tree.headings[side]), side_turn, 1e-4);
        EXPECT_NEAR(degrees_between(tree.headings[main], tree.headings[side]),
                    main_turn + side_turn, 1e-4);
    });
}

TEST(Tree, LengthsOfEdgesFollowTheirOrder) {
    for (const OrderLaw law :
         {OrderLaw::constant, OrderLaw::linear, OrderLaw::logarithmic, OrderLaw::geometric}) {
        TreeShape shape = plain();
        shape.length_law = law;
        shape.length_rise = 1.4;
        const Tree tree = grown_tree(shape, 4);
        for (std::uint32_t i = 1; i < tree.ramification.nodes.size(); ++i) {
            const double k = tree.ramification.nodes[i].order;
            const double wanted = law == OrderLaw::constant      ? 1.0
                                  : law == OrderLaw::linear      ? 1.0 + 1.4 * (k - 1.0)
                                  : law == OrderLaw::logarithmic ? 1.0 + 1.4 * std::log(k)
                                                                 : std::pow(1.4, k - 1.0);
            EXPECT_NEAR(glm::length(edge(tree, i)), shape.twig_length * wanted, 1e-9);
        }
        EXPECT_NEAR(glm::length(edge(tree, 0)),
                    shape.trunk + shape.twig_length * (law == OrderLaw::constant ? 1.0
                                                       : law == OrderLaw::linear ? 6.6
                                                       : law == OrderLaw::logarithmic
                                                           ? 1.0 + 1.4 * std::log(5.0)
                                                           : std::pow(1.4, 4.0)),
                    1e-9);
    }
}

// Pipe model: the powers of the radii of both branches sum to that of their parent; for exponent 2
// these are cross-sections.
TEST(Tree, PipesAddUp) {
    for (const double exponent : {1.0, 2.0, 2.7}) {
        TreeShape shape = plain();
        shape.width_law = OrderLaw::pipe;
        shape.width_rise = exponent;
        const Tree tree = grown_tree(shape, 4);
        const auto pipes = [&](std::uint32_t i) {
            return tree.ramification.leaf(i)
                       ? 1.0
                       : std::pow(tree.skeleton.nodes[i + 1].radius / shape.twig_radius, exponent);
        };
        each_inner(tree, [&](std::uint32_t i, const Ramification::Node& node) {
            EXPECT_NEAR(pipes(i), pipes(node.children[0]) + pipes(node.children[1]),
                        1e-9 * pipes(i));
        });
    }
}

TEST(Tree, RadiiByOrderGoEvenlyFromOneOrderToTheNext) {
    TreeShape shape = plain();
    shape.width_law = OrderLaw::geometric;
    shape.width_rise = 2.0;
    const Tree tree = grown_tree(shape, 4);
    each_inner(tree, [&](std::uint32_t i, const Ramification::Node& node) {
        const double radius = tree.skeleton.nodes[i + 1].radius;
        const double own = shape.twig_radius * std::pow(2.0, node.order - 1.0);
        EXPECT_LE(radius, own);
        EXPECT_GE(radius, 0.5 * own * (1.0 - 1e-12));
        // An axis ends at its fork with the radius of its children.
        if (tree.ramification.nodes[node.children[0]].order < node.order) {
            EXPECT_NEAR(radius, 0.5 * own, 1e-12);
        }
    });
}

TEST(Tree, BranchesTurnAboutTheirParentByTheirPhyllotaxis) {
    for (const double azimuth : {137.5, 180.0, 90.0}) {
        TreeShape shape = plain();
        shape.topology.matrix = shape.topology.toward = MatrixKind::fishbone;
        shape.azimuth_deg = azimuth;
        shape.main_deg = 0.0;
        const Tree tree = grown_tree(shape, 4);
        std::size_t seen = 0;
        each_inner(tree, [&](std::uint32_t i, const Ramification::Node& node) {
            const std::uint32_t next = node.children[0];
            if (tree.ramification.leaf(next) || tree.ramification.nodes[next].order != node.order)
                return;
            EXPECT_NEAR(degrees_between(tree.across[i], tree.across[next]), azimuth, 1e-4);
            ++seen;
        });
        EXPECT_GT(seen, 20U);
    }
}

TEST(Tree, TropismsPullEachEdgeTowardsTheirVector) {
    TreeShape shape = plain();
    const auto mean_heading = [&](const TreeShape& pulled) {
        const Tree tree = grown_tree(pulled, 4);
        glm::dvec3 sum(0.0);
        for (const glm::dvec3& heading : tree.headings) {
            EXPECT_NEAR(glm::length(heading), 1.0, 1e-9);
            sum += heading;
        }
        return sum / static_cast<double>(tree.headings.size());
    };
    const glm::dvec3 none = mean_heading(shape);
    shape.gravitropism = 0.1;
    EXPECT_GT(mean_heading(shape).y, none.y + 0.05);
    shape.gravitropism = -0.1;
    EXPECT_LT(mean_heading(shape).y, none.y - 0.05);
    shape.gravitropism = 0.0;
    shape.phototropism = 0.1;
    shape.light_deg = 0.0;
    shape.light_azimuth_deg = 90.0;  // from +x
    EXPECT_GT(mean_heading(shape).x, none.x + 0.05);
    // For one edge h' = normalize(h + e (T - (T.h) h)), here for the trunk under horizontal light.
    const Tree tree = grown_tree(shape, 4);
    EXPECT_NEAR(tree.headings[0].x, 0.1 / std::sqrt(1.01), 1e-9);
    EXPECT_NEAR(tree.headings[0].y, 1.0 / std::sqrt(1.01), 1e-9);
}

TEST(Tree, PlagiotropyLaysTwigsLevel) {
    TreeShape shape = plain(6);
    const auto level = [&](double plagiotropy) {
        shape.plagiotropy = plagiotropy;
        const Tree tree = grown_tree(shape, 4);
        double sum = 0.0, count = 0.0;
        each_inner(tree, [&](std::uint32_t i, const Ramification::Node& node) {
            if (node.order != 2) return;
            // In a horizontal plane the direction across has no height.
            sum += std::abs(tree.across[i].y);
            count += 1.0;
        });
        return sum / count;
    };
    EXPECT_LT(level(1.0), 0.35 * level(0.0));
}

TEST(Tree, ShorteningMakesACone) {
    TreeShape shape = plain(3);
    shape.topology.matrix = MatrixKind::own;
    shape.topology.rows = {{0.9, 0.1}, {0.0, 0.9, 0.1}};
    shape.shortening = 0.8;
    const Tree tree = grown_tree(shape, 2);
    // First edges of side branches shorten linearly along the trunk.
    std::vector<double> lengths;
    each_inner(tree, [&](std::uint32_t, const Ramification::Node& node) {
        const std::uint32_t side = node.children[1];
        if (node.order == 3 && tree.ramification.nodes[side].order == 2)
            lengths.push_back(glm::length(edge(tree, side)));
    });
    ASSERT_GT(lengths.size(), 5U);
    for (std::size_t i = 1; i < lengths.size(); ++i) EXPECT_LT(lengths[i], lengths[i - 1]);
    const double full = shape.twig_length * (1.0 + shape.length_rise);
    const auto nodes = static_cast<double>(lengths.size());
    EXPECT_NEAR(lengths[0], full * (1.0 - 0.8 / nodes), 0.02 * full);
    EXPECT_NEAR(lengths.back(), full * 0.2, 1e-9);
}

TEST(Tree, RoundingShortensTheLowestBranchesOfTheTrunk) {
    TreeShape shape = plain(3);
    shape.topology.matrix = MatrixKind::own;
    shape.topology.rows = {{0.9, 0.1}, {0.0, 0.9, 0.1}};
    const auto lengths = [&] {
        const Tree tree = grown_tree(shape, 2);
        std::vector<double> found;
        each_inner(tree, [&](std::uint32_t, const Ramification::Node& node) {
            const std::uint32_t side = node.children[1];
            if (node.order == 3 && tree.ramification.nodes[side].order == 2)
                found.push_back(glm::length(edge(tree, side)));
        });
        return found;
    };
    const std::vector<double> before = lengths();
    shape.rounding = 0.8;
    const std::vector<double> rounded = lengths();
    ASSERT_EQ(rounded.size(), before.size());
    EXPECT_LT(rounded.front(), 0.6 * before.front());
    EXPECT_NEAR(rounded.back(), before.back(), 0.01 * before.back());
}

TEST(Tree, SpreadTurnsGreatBranchesAsFarAsTwigs) {
    TreeShape shape = plain();
    shape.spread = 1.0;
    const Tree tree = grown_tree(shape, 4);
    each_inner(tree, [&](std::uint32_t i, const Ramification::Node& node) {
        if (tree.ramification.nodes[node.children[0]].order < node.order) return;
        EXPECT_NEAR(degrees_between(tree.headings[i], tree.headings[node.children[1]]),
                    shape.side_deg, 1e-4);
    });
}

TEST(Tree, WeepingTwigsHangWhileTheTrunkStands) {
    const auto height = [](double weeping, int order) {
        TreeShape shape = plain();
        shape.weeping = weeping;
        const Tree tree = grown_tree(shape, 4);
        double sum = 0.0, count = 0.0;
        for (std::uint32_t i = 0; i < tree.ramification.nodes.size(); ++i) {
            if (tree.ramification.nodes[i].order != order) continue;
            sum += tree.headings[i].y;
            count += 1.0;
        }
        return sum / count;
    };
    EXPECT_EQ(height(0.3, 5), height(0.0, 5));
    EXPECT_LT(height(0.3, 1), height(0.0, 1) - 0.2);
}

TEST(Tree, LeavesOfShortenedTwigsAreSmaller) {
    TreeShape shape = plain(4);
    LeafStyle style;
    style.size_spread = 0.0;
    for (const PlacedLeaf& leaf : placed_leaves(grown_tree(shape, 4), style, 1))
        ASSERT_EQ(leaf.size, style.leaf_size);
    shape.shortening = 0.75;
    const Tree tree = grown_tree(shape, 4);
    for (const PlacedLeaf& leaf : placed_leaves(tree, style, 1))
        ASSERT_NEAR(std::pow(leaf.size / style.leaf_size, 4.0), tree.scales[leaf.twig], 1e-12);
}

TEST(Tree, EvenAxesAreEquallyLong) {
    TreeShape shape = plain(3);
    shape.topology.matrix = MatrixKind::own;
    shape.topology.rows = {{0.8, 0.2}, {0.0, 0.9, 0.1}};
    const auto spread = [&] {
        const Tree tree = grown_tree(shape, 2);
        const std::vector<Ramification::Node>& nodes = tree.ramification.nodes;
        double sum = 0.0, squares = 0.0, count = 0.0;
        for (std::uint32_t i = 1; i < nodes.size(); ++i) {
            if (nodes[i].order != 2 || nodes[nodes[i].parent].order == 2) continue;
            double length = 0.0;
            double edges = 0.0;
            for (std::uint32_t at = i; nodes[at].order == 2; at = nodes[at].children[0]) {
                length += glm::length(edge(tree, at));
                edges += 1.0;
            }
            if (edges < 2.0 || edges > 14.0)
                continue;  // of a mean of 5: none is stretched beyond three times
            sum += length;
            squares += length * length;
            count += 1.0;
        }
        EXPECT_GE(count, 5.0);
        const double mean = sum / count;
        return std::sqrt(std::max(0.0, squares / count - mean * mean)) / mean;
    };
    EXPECT_GT(spread(), 0.2);
    shape.evenness = 1.0;
    EXPECT_NEAR(spread(), 0.0, 1e-6);
}

TEST(Tree, BarkIsClosedAtEveryLevelOfDetail) {
    for (const TreePreset& preset : tree_presets()) {
        SCOPED_TRACE(preset.id.string());
        EXPECT_EQ(tree_preset(preset.id.string()), &preset);
        ASSERT_NE(leaf_preset(preset.leaf.id), nullptr);
        const Tree tree = grown_tree(preset.shape, 1);
        std::size_t before = 400'000;
        for (int lod = 0; lod < tree_lods; ++lod) {
            const Mesh bark = bark_of(tree, lod).mesh;
            const std::vector<std::string> found = defects(bark);
            EXPECT_TRUE(found.empty()) << lod << ": " << found.front();
            EXPECT_GT(volume(bark), 0.0);
            EXPECT_EQ(bark.tangents.size(), bark.positions.size());
            EXPECT_LE(bark.triangles(), before);
            before = bark.triangles();
        }
    }
    EXPECT_EQ(tree_preset("palm"), nullptr);
}

TEST(Tree, TreesAtTheEndsOfTheirRangesAreClosedOrRefused) {
    TreeShape shape;
    shape.topology.order = 4;
    walk_corners(shape, Info{.name = ""}, "", [&](const std::string& path) {
        std::vector<Problem> problems;
        check(shape, Info{.name = ""}, "", problems);
        if (!problems.empty()) return;
        try {
            const Mesh bark = bark_of(grown_tree(shape, 1), 0).mesh;
            const std::vector<std::string> found = defects(bark);
            EXPECT_TRUE(found.empty()) << path << ": " << found.front();
        } catch (const Impossible& refused) {
            EXPECT_TRUE(names(refused.problems(), "/order", "leaves")) << path;
        }
    });
}

TEST(Tree, TheSameSeedGivesTheSameTree) {
    const TreeShape& shape = tree_preset("broadleaf")->shape;
    const Tree one = grown_tree(shape, 7), again = grown_tree(shape, 7),
               other = grown_tree(shape, 8);
    EXPECT_EQ(one.headings, again.headings);
    EXPECT_NE(one.headings, other.headings);
    EXPECT_EQ(one.ramification.leaves(), other.ramification.leaves());
    EXPECT_EQ(bark_of(one, 2).mesh.positions, bark_of(again, 2).mesh.positions);
}

TEST(Foliage, LeavesHaveTheRequestedNumberAndFewTriangles) {
    const TreePreset& preset = *tree_preset("shrub");
    const Tree tree = grown_tree(preset.shape, 1);
    const std::vector<PlacedLeaf> leaves = placed_leaves(tree, preset.leaves, 1);
    EXPECT_EQ(leaves.size(),
              tree.ramification.leaves() * static_cast<std::size_t>(preset.leaves.per_tip));
    const Mesh leaf = foliage_leaf(leaf_preset(preset.leaf.id)->shape);
    const Mesh merged = merged_leaves(leaves, leaf);
    EXPECT_LE(merged.triangles(), 16 * leaves.size());
    EXPECT_TRUE(defects(merged).empty());
    std::set<std::uint32_t> ids;
    for (const PlacedLeaf& one : leaves) {
        ids.insert(one.id);
        EXPECT_NEAR(glm::dot(one.along, one.up), 0.0, 1e-9);
        EXPECT_NEAR(glm::length(one.along), 1.0, 1e-9);
    }
    EXPECT_EQ(ids.size(), leaves.size());
}

TEST(Foliage, TooManyLeavesAreRefusedWithTheirNumber) {
    TreeShape shape = plain(7);
    shape.topology.blend = 1.0;
    LeafStyle style;
    style.per_tip = 40;
    EXPECT_TRUE(names(refusal([&] { (void)placed_leaves(grown_tree(shape, 1), style, 1); }),
                      "/per_tip", "40 make 109240 leaves on 2731 twigs"));
}

TEST(Foliage, ThinningNestsAndKeepsTheArea) {
    const TreePreset& preset = *tree_preset("shrub");
    const std::vector<PlacedLeaf> leaves =
        placed_leaves(grown_tree(preset.shape, 1), preset.leaves, 1);
    const Mesh leaf = foliage_leaf(leaf_preset(preset.leaf.id)->shape, 8);
    const double whole = area(merged_leaves(leaves, leaf));
    for (const double share : {0.5, 0.25, 0.06}) {
        const std::vector<PlacedLeaf> fewer = thinned(leaves, share);
        EXPECT_EQ(fewer.size(),
                  static_cast<std::size_t>(std::ceil(share * static_cast<double>(leaves.size()))));
        EXPECT_NEAR(area(merged_leaves(fewer, leaf)) / whole, 1.0, 1e-4);
        for (std::size_t i = 0; i < fewer.size(); ++i) EXPECT_EQ(fewer[i].id, leaves[i].id);
    }
    EXPECT_TRUE(thinned(leaves, 0.0).empty());
}

TEST(Tree, ImpossibleTreesAreRefusedByName) {
    TreeShape shape = plain();
    shape.topology.order = 12;
    EXPECT_TRUE(names(refusal([&] { (void)grown_tree(shape, 1); }), "/order", "leaves"));
    shape.topology.order = 4;
    shape.topology.matrix = MatrixKind::own;
    shape.topology.rows = {{0.25, 0.7}, {0.5, 0.25, 0.25}};
    const auto own = refusal([&] { (void)grown_tree(shape, 1); });
    EXPECT_TRUE(names(own, "/rows/0", "sum to 0.95"));
    EXPECT_TRUE(names(own, "/order", "4 needs 3 rows of an own matrix; there are 2"));
    shape = plain();
    shape.width_rise = 0.5;
    EXPECT_TRUE(names(refusal([&] { (void)grown_tree(shape, 1); }), "/width_rise", "less than 1"));
    EXPECT_TRUE(names(refusal([&] { (void)bark_of(grown_tree(plain(2), 1), 4); }), "/lod", "0..3"));
}

}  // namespace
}  // namespace sporeprint::plant_tree_test
