#include "core/ramification/ramification.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/effort.h"
#include "tests/support/refusals.h"

namespace sporeprint::ramification_ramification_test {
namespace {

constexpr std::size_t plenty = 1'000'000;

struct Named {
    std::string name;
    RamificationMatrix matrix;
};

std::vector<Named> catalogue(int order) {
    return {{"perfect", perfect_matrix(order)},
            {"random_binary", random_binary_matrix(order)},
            {"random_increasing", random_increasing_matrix(order)},
            {"fishbone", fishbone_matrix(order, 0.12)},
            {"tokunaga", tokunaga_matrix(order, 1.5, 1.2)},
            {"blend", blended(perfect_matrix(order), random_binary_matrix(order), 0.5)}};
}

// Expects that parents come first, both children refer to their parent, and orders are those of
// Horton and Strahler.
void expect_tree(const Ramification& tree) {
    ASSERT_FALSE(tree.nodes.empty());
    EXPECT_EQ(tree.nodes[0].parent, Ramification::none);
    std::size_t leaves = 0, wrong = 0;
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
        const Ramification::Node& node = tree.nodes[i];
        if (tree.leaf(i)) {
            ++leaves;
            wrong += node.order != 1;
            continue;
        }
        const Ramification::Node& first = tree.nodes[node.children[0]];
        const Ramification::Node& second = tree.nodes[node.children[1]];
        wrong += node.children[0] <= i || node.children[1] <= i;
        wrong += first.parent != i || second.parent != i;
        wrong += first.order < second.order;
        wrong += node.order != (first.order == second.order ? first.order + 1 : first.order);
    }
    EXPECT_EQ(wrong, 0U);
    EXPECT_EQ(leaves, tree.leaves());
}

TEST(Ramification, RowsOfTheCatalogueAreStochastic) {
    for (int order = 2; order <= most_order; ++order)
        for (const Named& one : catalogue(order)) {
            EXPECT_TRUE(validation_errors(one.matrix).empty()) << one.name;
            EXPECT_EQ(one.matrix.order(), order);
        }
}

TEST(Ramification, TheRandomBinaryMatrixHalvesFromSideToSide) {
    const RamificationMatrix matrix = random_binary_matrix(9);
    for (int k = 2; k <= 9; ++k) {
        for (int i = 1; i < k; ++i) EXPECT_NEAR(matrix.at(k, i), std::pow(0.5, i), 1e-12);
        EXPECT_NEAR(matrix.fork(k), std::pow(0.5, k - 1), 1e-12);
    }
}

TEST(Ramification, ThePerfectTreeHasTwoToThePowerOfItsOrderLessOneLeaves) {
    for (int order = 1; order <= most_order; ++order) {
        const std::size_t leaves = std::size_t{1} << (order - 1);
        const RamificationMatrix matrix = perfect_matrix(std::max(order, 2));
        EXPECT_EQ(sampled_ramification(matrix, order, 3, plenty).leaves(), leaves);
        EXPECT_EQ(exact_ramification(matrix, order, 3, plenty).leaves(), leaves);
        EXPECT_EQ(expected_leaves(matrix, order), static_cast<double>(leaves));
    }
}

TEST(Ramification, TreesAreConsistent) {
    for (const Named& one : catalogue(6))
        for (std::uint32_t seed = 0; seed < 20; ++seed) {
            SCOPED_TRACE(one.name);
            expect_tree(sampled_ramification(one.matrix, 6, seed, plenty));
            expect_tree(exact_ramification(one.matrix, 6, seed, plenty));
        }
}

// Each entry is a mean of Bernoulli samples: within five standard deviations.
TEST(Ramification, ASampledForestHasTheFrequenciesOfItsMatrix) {
    for (const Named& one : catalogue(6)) {
        SCOPED_TRACE(one.name);
        BiorderCounts all;
        for (int k = 2; k <= 6; ++k) all.rows.emplace_back(static_cast<std::size_t>(k));
        for (std::uint32_t seed = 0; seed < effort(200, 60); ++seed) {
            const BiorderCounts found =
                measured_biorders(sampled_ramification(one.matrix, 6, seed, plenty));
            ASSERT_EQ(found.rows.size(), 5U);
            for (std::size_t row = 0; row < 5; ++row)
                for (std::size_t i = 0; i < found.rows[row].size(); ++i)
                    all.rows[row][i] += found.rows[row][i];
        }
        for (int k = 2; k <= 6; ++k) {
            double nodes = 0.0;
            for (const std::size_t count : all.rows[static_cast<std::size_t>(k - 2)])
                nodes += static_cast<double>(count);
            for (int i = 1; i <= k; ++i) {
                const double wanted = one.matrix.at(k, i);
                EXPECT_NEAR(all.matrix().at(k, i), wanted,
                            5.0 * std::sqrt(wanted * (1.0 - wanted) / nodes) + 1e-12)
                    << k << ", " << i;
            }
        }
    }
}

TEST(Ramification, AnExactTreeHasExactlyTheFrequenciesOfItsMatrix) {
    for (const Named& one : catalogue(7)) {
        SCOPED_TRACE(one.name);
        const Ramification tree = exact_ramification(one.matrix, 7, 11, plenty);
        EXPECT_EQ(static_cast<double>(tree.leaves()), exact_leaves(one.matrix, 7));
        const BiorderCounts found = measured_biorders(tree);
        ASSERT_EQ(found.rows.size(), 6U);
        for (int k = 2; k <= 7; ++k) {
            const auto& row = found.rows[static_cast<std::size_t>(k - 2)];
            // Every segment ends in one fork; the numbers of its other nodes are rounded shares of
            // segments / r(k, k).
            const auto segments = static_cast<double>(row.back());
            for (int i = 1; i < k; ++i)
                EXPECT_EQ(static_cast<double>(row[static_cast<std::size_t>(i - 1)]),
                          std::floor(one.matrix.at(k, i) * (segments / one.matrix.fork(k)) + 0.5))
                    << k << ", " << i;
        }
    }
}

TEST(Ramification, ExactTreesDifferInArrangementOnly) {
    const RamificationMatrix matrix = random_binary_matrix(6);
    const Ramification one = exact_ramification(matrix, 6, 1, plenty);
    const Ramification other = exact_ramification(matrix, 6, 2, plenty);
    EXPECT_EQ(one.nodes, exact_ramification(matrix, 6, 1, plenty).nodes);
    EXPECT_NE(one.nodes, other.nodes);
    EXPECT_EQ(measured_biorders(one).rows, measured_biorders(other).rows);
}

// Spaced trees have the same numbers, and all axes of an order but its rounding the same of side
// branches.
TEST(Ramification, SpacedTreesBearEquallyManyBranchesOnEveryAxis) {
    for (const Named& one : catalogue(6)) {
        SCOPED_TRACE(one.name);
        const Ramification exact = exact_ramification(one.matrix, 6, 11, plenty);
        const Ramification tree = exact_ramification(one.matrix, 6, 11, plenty, true);
        expect_tree(tree);
        EXPECT_EQ(measured_biorders(tree).rows, measured_biorders(exact).rows);
        for (int k = 2; k <= 5; ++k) {
            std::size_t fewest = plenty, most = 0;
            for (std::uint32_t i = 1; i < tree.nodes.size(); ++i) {
                if (tree.nodes[i].order != k || tree.nodes[tree.nodes[i].parent].order == k)
                    continue;
                std::size_t length = 0;
                for (std::uint32_t at = i; tree.nodes[at].order == k;
                     at = tree.nodes[at].children[0])
                    ++length;
                fewest = std::min(fewest, length);
                most = std::max(most, length);
            }
            EXPECT_LE(most, fewest + 1) << k;
        }
    }
}

// A tree of order 7 of the random binary matrix has 2731 leaves on average.
TEST(Ramification, MeanNumbersOfLeavesFollowTheFormula) {
    EXPECT_NEAR(expected_leaves(random_binary_matrix(7), 7), 2731.0, 1e-6);
    EXPECT_EQ(exact_leaves(random_binary_matrix(7), 7), 2731.0);
    for (const Named& one : catalogue(4)) {
        double sum = 0.0, squares = 0.0;
        const auto trees = static_cast<double>(effort(4000, 400));
        for (std::uint32_t seed = 0; seed < static_cast<std::uint32_t>(trees); ++seed) {
            const auto leaves =
                static_cast<double>(sampled_ramification(one.matrix, 4, seed, plenty).leaves());
            sum += leaves;
            squares += leaves * leaves;
        }
        const double mean = sum / trees;
        const double deviation = std::sqrt(std::max(0.0, squares / trees - mean * mean) / trees);
        EXPECT_NEAR(mean, expected_leaves(one.matrix, 4), 5.0 * deviation + 1e-9) << one.name;
    }
}

TEST(Ramification, TipsReplaceLeavesAndKeepOrdersRight) {
    const Ramification tree = exact_ramification(random_binary_matrix(5), 5, 4, plenty);
    const Ramification branched = with_tips(tree, fishbone_matrix(3, 0.3), 3, 9, plenty);
    expect_tree(branched);
    EXPECT_GT(branched.leaves(), tree.leaves());
    EXPECT_EQ(with_tips(tree, fishbone_matrix(3, 0.3), 1, 9, plenty).nodes, tree.nodes);
    EXPECT_THROW((void)with_tips(tree, fishbone_matrix(3, 0.3), 3, 9, tree.leaves()), Impossible);
}

TEST(Ramification, TooManyLeavesAreRefusedWithTheExpectedNumber) {
    const auto grown =
        refusal([] { (void)sampled_ramification(random_binary_matrix(9), 9, 1, 1000); });
    EXPECT_TRUE(names(grown, "/order", "about 43691 leaves; at most 1000"));
    const auto too_many =
        refusal([] { (void)exact_ramification(random_binary_matrix(9), 9, 1, 1000); });
    EXPECT_TRUE(names(too_many, "/order", "about 43691 leaves; at most 1000"));
    // The least share of forks at the highest order: more leaves than an integer can count, still
    // refused at once.
    const auto endless = refusal([] {
        (void)exact_ramification(fishbone_matrix(most_order, least_fork), most_order, 1, 1000);
    });
    EXPECT_TRUE(names(endless, "/order", "leaves"));
}

TEST(Ramification, ErrorsOfMatricesAreNamed) {
    EXPECT_TRUE(names(validation_errors(RamificationMatrix{}), "/matrix", "0 rows"));
    EXPECT_TRUE(names(validation_errors({{{0.5, 0.5}, {1.0}}}), "/matrix/1",
                      "1 entries; the row of order 3 has 3"));
    EXPECT_TRUE(names(validation_errors({{{0.6, 0.5}}}), "/matrix/0", "sum to 1.1"));
    EXPECT_TRUE(names(validation_errors({{{-0.5, 1.5}}}), "/matrix/0/0", "-0.5 is outside 0..1"));
    EXPECT_TRUE(names(validation_errors({{{1.0, 0.0}}}), "/matrix/0/1", "would hardly ever end"));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(validation_errors({{{nan, 1.0}}}).empty());
    EXPECT_TRUE(names(refusal([] { (void)sampled_ramification(perfect_matrix(3), 4, 1, plenty); }),
                      "/order", "4 is outside 1..3"));
    EXPECT_TRUE(names(refusal([] { (void)exact_ramification(perfect_matrix(3), 0, 1, plenty); }),
                      "/order", "0 is outside 1..3"));
}

}  // namespace
}  // namespace sporeprint::ramification_ramification_test
