// Ramification matrices: how often a branch of one order carries branches of another, and the
// binary trees that follow them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/problems.h"

namespace sporeprint {

/// Triangular stochastic matrix of a binary tree, by Horton-Strahler orders: leaves have order 1,
/// and a node whose children have orders i and j has order i + 1 if i = j, otherwise the greater.
/// The biorder of a node of order k >= 2 is (k, i) if it has one child of order k and one of order
/// i < k, and (k, k) if it forks into two children of order k - 1. Row k - 2 describes nodes of
/// order k: entry i - 1 is the share of them with biorder (k, i); the shares of a row sum to 1.
///
/// source  [Viennot1989] section 3
struct RamificationMatrix {
    std::vector<std::vector<double>> rows;

    /// Returns the highest order that it describes.
    [[nodiscard]] int order() const { return static_cast<int>(rows.size()) + 1; }
    /// Returns r(k, i), 2 <= k <= order(), 1 <= i <= k.
    [[nodiscard]] double at(int k, int i) const {
        return rows[static_cast<std::size_t>(k - 2)][static_cast<std::size_t>(i - 1)];
    }
    /// Returns the share of nodes of order k that fork into two children of order k - 1.
    [[nodiscard]] double fork(int k) const { return at(k, k); }
    bool operator==(const RamificationMatrix&) const = default;
};

/// Least share of forks: an axis has 1 / fork nodes on average, and never ends if the share is 0.
inline constexpr double least_fork = 0.0004;

/// Highest supported order.
inline constexpr int most_order = 12;

/// Returns the errors of a ramification matrix: no rows or an order above most_order, rows of wrong
/// length, entries outside 0..1, sums that differ from 1 by more than 1e-6, and shares of forks
/// below least_fork. Their paths are `path`, '/' and the index of the row, from 0.
[[nodiscard]] std::vector<Problem> validation_errors(const RamificationMatrix& matrix,
                                                     const std::string& path = "/matrix");

/// Returns the matrix of perfect binary trees, which have forks only and 2^(order - 1) leaves.
[[nodiscard]] RamificationMatrix perfect_matrix(int order);
/// Returns the matrix of uniformly distributed binary trees of a size: r(k, i) = 2^-i, r(k, k) =
/// 2^-(k-1).
[[nodiscard]] RamificationMatrix random_binary_matrix(int order);
/// Returns the matrix of binary search trees of random permutations, which are bushier at the tips.
[[nodiscard]] RamificationMatrix random_increasing_matrix(int order);
/// Returns the matrix of long axes with single twigs: r(k, 1) = 1 - forks, r(k, k) = forks.
[[nodiscard]] RamificationMatrix fishbone_matrix(int order, double forks);
/// Returns the self-similar matrix in which a segment (a path of nodes of one order k) has on
/// average T(j) = a * c^(j - 1) side branches of order k - j. a = 1, c = 2 is the random binary
/// matrix.
///
/// source  [Tokunaga1978]
[[nodiscard]] RamificationMatrix tokunaga_matrix(int order, double a, double c);
/// Returns the linear interpolation (1 - weight) * first + weight * second, with the rows that both
/// have.
[[nodiscard]] RamificationMatrix blended(const RamificationMatrix& first,
                                         const RamificationMatrix& second, double weight);

/// Returns the expected number of leaves of a tree of an order: L(1) = 1, L(k) = 2 L(k-1) + sum
/// over i < k of r(k, i) L(i) / r(k, k).
///
/// order   1..matrix.order()
[[nodiscard]] double expected_leaves(const RamificationMatrix& matrix, int order);

/// A binary tree; node 0 is its root, and children come after their parents. Leaves have no
/// children.
struct Ramification {
    static constexpr std::uint32_t none = 0xffffffffU;
    struct Node {
        std::uint32_t parent = none;
        std::array<std::uint32_t, 2> children = {none, none};  ///< the one of greater order first
        int order = 1;
        bool operator==(const Node&) const = default;
    };
    std::vector<Node> nodes;

    /// Returns true if a node has no children.
    [[nodiscard]] bool leaf(std::uint32_t node) const { return nodes[node].children[0] == none; }
    /// Returns the number of leaves.
    [[nodiscard]] std::size_t leaves() const { return (nodes.size() + 1) / 2; }
};

/// Grows a tree from the root, sampling each node's biorder from its row. Its size varies widely
/// from seed to seed.
///
/// most    largest number of leaves
/// throws  Impossible (path "/order") naming the expected number if this tree would have more;
///         InvalidInput for an invalid matrix
/// cost    O(nodes)
/// source  [Viennot1989] section 4
[[nodiscard]] Ramification sampled_ramification(const RamificationMatrix& matrix, int order,
                                                std::uint32_t seed, std::size_t most);

/// Returns the number of leaves of every tree that exact_ramification() makes of a matrix and an
/// order, without making one.
[[nodiscard]] double exact_leaves(const RamificationMatrix& matrix, int order);

/// Grows a tree in which the number of nodes of each biorder is the one that the matrix prescribes,
/// rounded to an integer; only their arrangement is random.
///
/// most    largest number of leaves
/// spaced  whether all axes of an order have the same number of side branches but for one and their
///         mixture is as even; otherwise every arrangement is equally likely, and one axis has ten
///         times the branches of another
/// throws  Impossible (path "/order") naming the exact number if the tree would have more;
///         InvalidInput for an invalid matrix
[[nodiscard]] Ramification exact_ramification(const RamificationMatrix& matrix, int order,
                                              std::uint32_t seed, std::size_t most,
                                              bool spaced = false);

/// Replaces each leaf by a small tree of another matrix, with an order drawn uniformly from
/// 1..tip_order, as in herbaceous plants.
///
/// throws  Impossible (path "/order") naming the expected number if the result would have more than
///         `most` leaves; InvalidInput for an invalid matrix
[[nodiscard]] Ramification with_tips(const Ramification& tree, const RamificationMatrix& tips,
                                     int tip_order, std::uint32_t seed, std::size_t most);

/// Numbers of nodes of each biorder of a tree, arranged as the rows of a matrix.
struct BiorderCounts {
    std::vector<std::vector<std::size_t>> rows;  ///< rows 2..order of the root

    /// Returns the rows divided by their sums. An order that does not occur gives a row of forks.
    [[nodiscard]] RamificationMatrix matrix() const;
};

/// Counts the nodes of each biorder of a tree.
///
/// cost    O(nodes)
/// source  [Viennot1989] section 3
[[nodiscard]] BiorderCounts measured_biorders(const Ramification& tree);

}  // namespace sporeprint
