// Parameters of a branching structure: its ramification matrices, its order, and how it is grown
// from them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/params/describe.h"
#include "core/ramification/ramification.h"

namespace sporeprint {

/// Named matrices (see ramification.h), or user-defined rows.
enum class MatrixKind { perfect, random_binary, random_increasing, fishbone, tokunaga, own };

constexpr const char* name(MatrixKind kind) {
    switch (kind) {
        case MatrixKind::perfect:
            return "perfect";
        case MatrixKind::random_binary:
            return "random_binary";
        case MatrixKind::random_increasing:
            return "random_increasing";
        case MatrixKind::fishbone:
            return "fishbone";
        case MatrixKind::tokunaga:
            return "tokunaga";
        case MatrixKind::own:
            return "own";
    }
    return nullptr;
}

/// The way numbers of branches are chosen; JSON spells them as name() does. exact: exactly the
/// proportions of the matrix, with a size known in advance. sampled: random node by node, with any
/// size. spaced: as exact, and all branches of an order bear nearly the same number of others.
enum class TreeGrowth { exact, sampled, spaced };

constexpr const char* name(TreeGrowth growth) {
    switch (growth) {
        case TreeGrowth::exact:
            return "dealt";
        case TreeGrowth::sampled:
            return "drawn";
        case TreeGrowth::spaced:
            return "spaced";
    }
    return nullptr;
}

/// Parameters of a branching structure.
struct TreeTopology {
    MatrixKind matrix = MatrixKind::random_increasing;
    MatrixKind toward = MatrixKind::random_binary;
    double blend = 0.0;
    double forks = 0.15;
    double tokunaga_a = 1.0;
    double tokunaga_c = 2.0;
    std::vector<std::vector<double>> rows;
    int order = 7;
    TreeGrowth growth = TreeGrowth::exact;
    MatrixKind tips = MatrixKind::fishbone;
    int tip_order = 1;

    static constexpr void fields(auto visit) {
        using T = TreeTopology;
        visit(&T::matrix, Info{.name = "matrix", .doc = "How often branches bear which others."});
        visit(&T::toward, Info{.name = "toward", .doc = "The matrix that `blend` goes towards."});
        visit(&T::blend,
              Info{.name = "blend", .min = 0, .max = 1, .doc = "From `matrix` to `toward`."});
        visit(&T::forks, Info{.name = "forks",
                              .min = 0.01,
                              .max = 1,
                              .doc = "Share of forks in a fishbone: long axes where it is low."});
        visit(&T::tokunaga_a, Info{.name = "tokunaga_a",
                                   .min = 0,
                                   .max = 6,
                                   .doc = "Side branches of the next lower order to a segment of "
                                          "a Tokunaga tree."});
        visit(&T::tokunaga_c, Info{.name = "tokunaga_c",
                                   .min = 0.2,
                                   .max = 5,
                                   .doc = "How many times more there are of each order below."});
        visit(&T::rows,
              Info{.name = "rows",
                   .min = 0,
                   .max = 1,
                   .most = most_order,
                   .doc = "The matrix called `own`, rows of order 2, 3 and so on: shares of nodes "
                          "with a side branch of order 1, 2 and so on, and at last of forks; each "
                          "sums to one."});
        visit(&T::order, Info{.name = "order",
                              .min = 1,
                              .max = most_order,
                              .doc = "Order of Horton and Strahler; each more bears about four "
                                     "times the leaves."});
        visit(&T::growth,
              Info{.name = "growth",
                   .doc = "Dealt to measure, drawn freely, or dealt so that all branches of "
                          "an order bear nearly as many others: a full crown."});
        visit(&T::tips, Info{.name = "tips", .doc = "Matrix of the small trees at the tips."});
        visit(&T::tip_order,
              Info{.name = "tip_order",
                   .min = 1,
                   .max = 4,
                   .doc = "Highest order of the small trees that take the place of twigs, as in "
                          "herbs; 1 for none."});
    }
    bool operator==(const TreeTopology&) const = default;

    /// Returns true when user-defined rows are used at all.
    [[nodiscard]] bool uses_rows() const {
        return matrix == MatrixKind::own || (toward == MatrixKind::own && blend > 0.0) ||
               (tips == MatrixKind::own && tip_order > 1);
    }
    /// Reports errors of user-defined rows, and rows that are missing for `order` or `tip_order`.
    void check(const std::string& path, std::vector<Problem>& problems) const;
};
static_assert(well_described<TreeTopology>());

/// Largest number of leaves and twigs of a tree.
inline constexpr std::size_t most_tips = 40'000;

/// Returns the matrix of a tree: `matrix` blended with `toward`. Its order is that of the topology,
/// at least 2.
///
/// pre  topology.check() reports nothing
[[nodiscard]] RamificationMatrix matrix_of(const TreeTopology& topology);

/// Returns the expected number of tips of a tree without growing it; the exact number for
/// TreeGrowth::exact and spaced without small trees at the tips.
[[nodiscard]] double expected_tips(const TreeTopology& topology);

/// Returns the matrix of the small trees at the tips; its order is tip_order, at least 2.
[[nodiscard]] RamificationMatrix tip_matrix(const TreeTopology& topology);

/// Grows the branching structure that a topology describes.
///
/// pre     topology.check() reports nothing
/// throws  Impossible (path "/order") naming the number of leaves if it exceeds `most`
[[nodiscard]] Ramification ramified(const TreeTopology& topology, std::uint32_t seed,
                                    std::size_t most);

}  // namespace sporeprint
