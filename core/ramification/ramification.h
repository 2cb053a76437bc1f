// Ramification matrices: how often a branch of one order bears branches of another, and the binary trees that obey them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/problems.h"

namespace sporeprint {

/// Orders are those of Horton and Strahler, leaves being 1: a node whose children have orders i and j has order i + 1 if i = j,
/// else the greater. Row k - 2 tells of nodes of order k = 2.. : entry i - 1, for i < k, is the share that bears one child of
/// order k and one of order i; entry k - 1, the diagonal, the share that forks into two of order k - 1.
/// source [Viennot1989] section 3: a triangular stochastic matrix
struct RamificationMatrix {
    std::vector<std::vector<double>> rows;

    /// Highest order that it can grow.
    [[nodiscard]] int order() const { return static_cast<int>(rows.size()) + 1; }
    /// r(k, i), 2 <= k <= order(), 1 <= i <= k.
    [[nodiscard]] double at(int k, int i) const {
        return rows[static_cast<std::size_t>(k - 2)][static_cast<std::size_t>(i - 1)];
    }
    [[nodiscard]] double fork(int k) const { return at(k, k); }
    bool operator==(const RamificationMatrix&) const = default;
};

/// Least share of forks: an axis has 1 / fork nodes on average, and none ends where the share is nothing.
inline constexpr double least_fork = 0.0004;

/// Highest order that is grown.
inline constexpr int most_order = 12;

/// What keeps rows 2..order from being a ramification matrix: rows missing, of other lengths, negative, not summing to one within
/// 1e-6, without forks. Paths are those of the rows below `path`.
[[nodiscard]] std::vector<Problem> faults_of(const RamificationMatrix& matrix,
                                             const std::string& path = "/matrix");

/// Only forks: 2^(order - 1) leaves.
[[nodiscard]] RamificationMatrix perfect_matrix(int order);
/// All binary trees of a size equally likely: r(k, i) = 2^-i, r(k, k) = 2^-(k-1).
[[nodiscard]] RamificationMatrix random_binary_matrix(int order);
/// Binary search trees of random permutations: bushier at the tips.
[[nodiscard]] RamificationMatrix random_increasing_matrix(int order);
/// Long axes with single twigs: r(k, 1) = 1 - forks, r(k, k) = forks.
[[nodiscard]] RamificationMatrix fishbone_matrix(int order, double forks);
/// Self-similar: side branches of an order j below come a c^(j-1) to a segment. (1, 2) is the random binary matrix.
/// source [Tokunaga1978]
[[nodiscard]] RamificationMatrix tokunaga_matrix(int order, double a, double c);
/// (1 - weight) first + weight second, of the lower of their orders: from ordered to random.
[[nodiscard]] RamificationMatrix blended(const RamificationMatrix& first,
                                         const RamificationMatrix& second, double weight);

/// Mean number of leaves of a tree of that order: L(1) = 1, L(k) = 2 L(k-1) + sum over i < k of r(k, i) L(i) / r(k, k).
///
/// order   1..matrix.order()
[[nodiscard]] double expected_leaves(const RamificationMatrix& matrix, int order);

/// A binary tree, node 0 its root; children come after their parents. A leaf has none.
struct Ramification {
    static constexpr std::uint32_t none = 0xffffffffU;
    struct Node {
        std::uint32_t parent = none;
        std::array<std::uint32_t, 2> children = {none, none};  ///< the one of greater order first
        int order = 1;
        bool operator==(const Node&) const = default;
    };
    std::vector<Node> nodes;

    [[nodiscard]] bool leaf(std::uint32_t node) const { return nodes[node].children[0] == none; }
    [[nodiscard]] std::size_t leaves() const { return (nodes.size() + 1) / 2; }
};

/// Grows a tree from the root, drawing each node's biorder from its row. Its size varies widely from seed to seed.
///
/// most    of leaves
/// throws  Impossible (path "/order") naming the mean if this tree would have more; InvalidInput for a matrix with faults
/// source  [Viennot1989] section 4. O(nodes)
[[nodiscard]] Ramification grown_ramification(const RamificationMatrix& matrix, int order,
                                              std::uint32_t seed, std::size_t most);

/// Leaves of every tree that dealt_ramification() makes of a matrix and an order: known before any is made.
[[nodiscard]] double dealt_leaves(const RamificationMatrix& matrix, int order);

/// Deals the biorders like a deck: their counts are those of the matrix, rounded, and only their places are drawn.
///
/// throws  as grown_ramification()
[[nodiscard]] Ramification dealt_ramification(const RamificationMatrix& matrix, int order,
                                              std::uint32_t seed, std::size_t most);

/// Replaces each leaf by a small tree, of an order drawn evenly from 1..tip_order, of another matrix: herbaceous growth.
///
/// throws  Impossible if it would have more than `most` leaves
[[nodiscard]] Ramification with_tips(const Ramification& tree, const RamificationMatrix& tips,
                                     int tip_order, std::uint32_t seed, std::size_t most);

/// How many nodes of each biorder a tree has, laid out as the rows of a matrix.
struct BiorderCounts {
    std::vector<std::vector<std::size_t>> rows;  ///< rows 2..order of the root

    /// Rows divided by their sums. An order that the tree lacks gives a row of forks.
    [[nodiscard]] RamificationMatrix matrix() const;
};

/// source [Viennot1989] section 3. O(nodes)
[[nodiscard]] BiorderCounts measured_biorders(const Ramification& tree);

}  // namespace sporeprint
