#include "core/world/drainage.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>

#include "core/math/elementary.h"
#include "core/problems.h"
#include "core/world/neighbours.h"

namespace sporeprint {

namespace {

/// Length of contour per cell that belongs to a neighbour of either kind.
constexpr double contour_straight = 0.5, contour_diagonal = 0.35355339059327379;

bool has_node(const Grid& grid, int column, int row) {
    return column >= 0 && row >= 0 && column < grid.side && row < grid.side;
}

/// Returns by how much flooded ground rises towards a node from one of its neighbours: 1 to 4 units
/// of height as the bits of its index decide, and half as much again to a diagonal one. Paths of
/// water over water would be straight lines along eight directions if all nodes rose alike.
std::int32_t rise_at(std::uint32_t node, std::size_t neighbour) {
    std::uint32_t bits = (node + 1) * 0x85EBCA77U;
    bits = (bits ^ (bits >> 15)) * 0xC2B2AE3DU;
    const auto rise = static_cast<std::int32_t>(bits >> 30) + 1;
    return is_diagonal(neighbour) ? (3 * rise + 1) / 2 : rise;
}

/// A queue of nodes by height for floods, in which no node is pushed that is not higher than those
/// taken last (a radix heap): bucket b holds heights whose highest bit that differs from the height
/// taken last is bit b - 1.
class NodeQueue {
  public:
    void push(std::int32_t height, std::uint32_t node) {
        const std::uint32_t key = static_cast<std::uint32_t>(height) ^ 0x80000000U;
        buckets_[static_cast<std::size_t>(std::bit_width(key ^ last_))].push_back({key, node});
    }

    /// Replaces `nodes` by all nodes of the lowest height, by index. Returns false if there are none.
    bool take_lowest(std::vector<std::uint32_t>& nodes) {
        nodes.clear();
        std::size_t bucket = 0;
        while (bucket < buckets_.size() && buckets_[bucket].empty()) ++bucket;
        if (bucket == buckets_.size()) return false;
        if (bucket > 0) {
            std::vector<Entry>& from = buckets_[bucket];
            last_ = std::min_element(from.begin(), from.end(), [](const Entry& a, const Entry& b) {
                        return a.key < b.key;
                    })->key;
            for (const Entry& one : from)
                buckets_[static_cast<std::size_t>(std::bit_width(one.key ^ last_))].push_back(one);
            from.clear();
        }
        for (const Entry& one : buckets_[0]) nodes.push_back(one.node);
        buckets_[0].clear();
        std::sort(nodes.begin(), nodes.end());
        return true;
    }

  private:
    struct Entry {
        std::uint32_t key, node;
    };
    std::array<std::vector<Entry>, 33> buckets_;
    std::uint32_t last_ = 0;
};

/// How water leaves a node.
struct Outflow {
    double contour = 0.0;  ///< length of the contour that it crosses, cells
    double slope = 0.0;    ///< tan(beta), the mean over that contour
};

/// Returns how water leaves an inner node, given its height in the heights of its grid.
Outflow outflow_of(const std::int32_t* here, const NeighbourOffsets& offsets, double cell) {
    const FlowWeights weights = flow_weights(here, offsets);
    Outflow out;
    for (std::size_t k = 0; k < neighbours; ++k)
        if (weights.of[k] > 0.0)
            out.contour += is_diagonal(k) ? contour_diagonal : contour_straight;
    out.slope = 0.25 * weights.sum / (height_units * cell * out.contour);
    return out;
}

/// The rise of the ground to the east and to the north, metres per metre.
struct Gradient {
    double east = 0.0, north = 0.0;
};

/// Returns the gradient from the heights round a node, given as a function of the columns and rows
/// to it [Horn1981].
Gradient gradient_of(auto height, double cell) {
    const std::int64_t south_west = height(-1, -1), south = height(0, -1),
                       south_east = height(1, -1);
    const std::int64_t west = height(-1, 0), east = height(1, 0);
    const std::int64_t north_west = height(-1, 1), north = height(0, 1), north_east = height(1, 1);
    const std::int64_t to_east =
        (south_east + 2 * east + north_east) - (south_west + 2 * west + north_west);
    const std::int64_t to_north =
        (north_west + 2 * north + north_east) - (south_west + 2 * south + south_east);
    const double distance = 8.0 * height_units * cell;
    return {static_cast<double>(to_east) / distance, static_cast<double>(to_north) / distance};
}

/// Returns the gradient at a node. Beyond the border the ground continues linearly.
Gradient gradient_at(const Grid& grid, std::span<const std::int32_t> heights, int column, int row) {
    if (column > 0 && row > 0 && column + 1 < grid.side && row + 1 < grid.side) {
        const std::int32_t* const here = &heights[grid.index(column, row)];
        const std::ptrdiff_t side = grid.side;
        return gradient_of([&](int i, int j) { return std::int64_t{here[i + j * side]}; },
                           grid.cell);
    }
    const auto along_row = [&](int i, int j) -> std::int64_t {
        const int inside = std::clamp(i, 0, grid.side - 1);
        const std::int64_t border = heights[grid.index(inside, j)];
        return i == inside ? border : 2 * border - heights[grid.index(2 * inside - i, j)];
    };
    const auto height = [&](int east, int north) -> std::int64_t {
        const int j = row + north;
        const int inside = std::clamp(j, 0, grid.side - 1);
        const std::int64_t border = along_row(column + east, inside);
        return j == inside ? border : 2 * border - along_row(column + east, 2 * inside - j);
    };
    return gradient_of(height, grid.cell);
}

double slope_of(const Gradient& rise) {
    return std::sqrt(rise.east * rise.east + rise.north * rise.north);
}

}  // namespace

void require_values(const Grid& grid, std::size_t values) {
    if (grid.side < 3) throw InvalidInput("", "a grid needs three nodes a side");
    if (values != grid.nodes())
        throw InvalidInput("", std::to_string(values) + " values for a grid of " +
                                   std::to_string(grid.nodes()) + " nodes");
}

FloodedGround flooded(const Grid& grid, std::span<const std::int32_t> heights) {
    require_values(grid, heights.size());
    FloodedGround out{{heights.begin(), heights.end()}, {}};
    out.order.reserve(grid.nodes());
    const std::vector<std::uint8_t> is_inner = inner_nodes(grid);
    NodeQueue queue;
    std::vector<std::uint8_t> is_waiting = is_inner;
    for (std::uint32_t node = 0; node < grid.nodes(); ++node)
        if (is_inner[node] == 0) queue.push(heights[node], node);
    const auto reach = [&](std::uint32_t next, std::int32_t height, std::size_t neighbour) {
        if (is_waiting[next] == 0) return;
        is_waiting[next] = 0;
        if (out.heights[next] <= height) out.heights[next] = height + rise_at(next, neighbour);
        queue.push(out.heights[next], next);
    };
    const NeighbourOffsets offsets = neighbour_offsets(grid);
    std::vector<std::uint32_t> lowest;
    while (queue.take_lowest(lowest))
        for (const std::uint32_t node : lowest) {
            out.order.push_back(node);
            if (is_inner[node] != 0) {
                for (std::size_t k = 0; k < neighbours; ++k)
                    reach(static_cast<std::uint32_t>(node + offsets[k]), out.heights[node], k);
                continue;
            }
            const int column = static_cast<int>(node) % grid.side;
            const int row = static_cast<int>(node) / grid.side;
            for (std::size_t k = 0; k < neighbours; ++k)
                if (has_node(grid, column + neighbour_steps[k][0], row + neighbour_steps[k][1]))
                    reach(static_cast<std::uint32_t>(node + offsets[k]), out.heights[node], k);
        }
    return out;
}

std::vector<double> catchments(const Grid& grid, const FloodedGround& ground) {
    require_values(grid, ground.heights.size());
    require_values(grid, ground.order.size());
    const NeighbourOffsets offsets = neighbour_offsets(grid);
    const std::vector<std::uint8_t> is_inner = inner_nodes(grid);
    std::vector<double> areas(grid.nodes(), grid.cell * grid.cell);
    for (std::size_t rank = grid.nodes(); rank-- > 0;) {
        const std::uint32_t node = ground.order[rank];
        if (is_inner[node] == 0) continue;
        const FlowWeights weights = flow_weights(&ground.heights[node], offsets);
        const double per_weight = areas[node] / weights.sum;
        double* const here = &areas[node];
        for (std::size_t k = 0; k < neighbours; ++k) here[offsets[k]] += per_weight * weights.of[k];
    }
    return areas;
}

std::vector<std::uint16_t> wetness_index(const Grid& grid, const FloodedGround& ground,
                                         std::span<const double> areas) {
    require_values(grid, ground.heights.size());
    require_values(grid, areas.size());
    const NeighbourOffsets offsets = neighbour_offsets(grid);
    const std::vector<std::uint8_t> is_inner = inner_nodes(grid);
    std::vector<std::uint16_t> index(grid.nodes());
    for (int row = 0; row < grid.side; ++row)
        for (int column = 0; column < grid.side; ++column) {
            const std::size_t i = grid.index(column, row);
            const Outflow out =
                is_inner[i] != 0
                    ? outflow_of(&ground.heights[i], offsets, grid.cell)
                    : Outflow{1.0, slope_of(gradient_at(grid, ground.heights, column, row))};
            const double specific_catchment = areas[i] / (out.contour * grid.cell);
            const double twi = logarithm(specific_catchment / std::max(out.slope, least_slope));
            const double fixed = std::floor((twi + wetness_offset) * wetness_units + 0.5);
            index[i] = static_cast<std::uint16_t>(std::clamp(fixed, 0.0, 65535.0));
        }
    return index;
}

std::vector<std::uint8_t> streams(std::span<const double> areas) {
    std::vector<std::uint8_t> out(areas.size());
    std::transform(areas.begin(), areas.end(), out.begin(), [](double area) {
        return static_cast<std::uint8_t>(area > stream_catchment ? 1 : 0);
    });
    return out;
}

}  // namespace sporeprint
