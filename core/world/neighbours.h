// The eight neighbours of the nodes of a grid, and how water is divided among them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/world/height_field.h"

namespace sporeprint {

inline constexpr std::size_t neighbours = 8;

/// Columns and rows to each neighbour: first the four along rows and columns, then the diagonal
/// ones.
inline constexpr std::array<std::array<int, 2>, neighbours> neighbour_steps = {
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

[[nodiscard]] constexpr bool is_diagonal(std::size_t neighbour) { return neighbour >= 4; }

/// Differences of indices from an inner node to its neighbours.
using NeighbourOffsets = std::array<std::ptrdiff_t, neighbours>;
[[nodiscard]] inline NeighbourOffsets neighbour_offsets(const Grid& grid) {
    NeighbourOffsets offsets{};
    for (std::size_t k = 0; k < neighbours; ++k)
        offsets[k] =
            neighbour_steps[k][0] + static_cast<std::ptrdiff_t>(neighbour_steps[k][1]) * grid.side;
    return offsets;
}

/// Returns 1 for each node that is not on the border, otherwise 0.
[[nodiscard]] inline std::vector<std::uint8_t> inner_nodes(const Grid& grid) {
    std::vector<std::uint8_t> is_inner(grid.nodes(), 0);
    for (int row = 1; row + 1 < grid.side; ++row)
        std::fill_n(is_inner.begin() + static_cast<std::ptrdiff_t>(grid.index(1, row)),
                    grid.side - 2, std::uint8_t{1});
    return is_inner;
}

/// How water is divided among the lower neighbours of an inner node.
struct FlowWeights {
    std::array<double, neighbours> of{};  ///< 0 for those that are not lower
    double sum = 0.0;
};

/// Returns weights of slope times contour length, in quarters of a cell times units of height per
/// cell. A contour of 1/2 cell belongs to a neighbour along a row or column, one of sqrt(2)/4 =
/// 0.354 to a diagonal one, which is sqrt(2) times as far: for the same drop its weight is half.
/// Weights and sum are integers, so that their order does not matter.
///
/// here    height of the node in the heights of its grid
/// source  [Quinn1991]
[[nodiscard]] inline FlowWeights flow_weights(const std::int32_t* here,
                                              const NeighbourOffsets& offsets) {
    FlowWeights weights;
    for (std::size_t k = 0; k < neighbours; ++k) {
        const double drop = std::max(0, *here - here[offsets[k]]);
        weights.of[k] = is_diagonal(k) ? drop : 2.0 * drop;
        weights.sum += weights.of[k];
    }
    return weights;
}

}  // namespace sporeprint
