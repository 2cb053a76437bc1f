#include "core/world/erosion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/problems.h"
#include "core/world/drainage.h"
#include "core/world/neighbours.h"

namespace sporeprint {

namespace {

/// Erodibility K times the duration of a step; without unit, as the exponent of the area is 1/2.
constexpr double erodibility = 0.03;

/// Area that is added to each catchment, m^2: what stream power is on slopes without streams.
constexpr double slope_catchment = 900.0;

/// Share of the depth of water that sediment fills in a step.
constexpr double sedimentation = 0.12;

/// Deviation of the Gaussian by which changes are smoothed, metres: creep of the soil rounds what is
/// smaller.
constexpr double creep = 4.0;

/// Greatest depth to which the outlets of small depressions are cut, in cells: deeper cuts, one node
/// wide, would be trenches.
constexpr double most_cut = 0.25;

/// Share of the depth of depressions of the fine grid that sediment fills at last, and the strength
/// from which it is that much and outlets are cut as deep as they get.
constexpr double most_filled = 0.75, filling_strength = 0.5;

constexpr double root_two = 1.41421356237309504880;

double metres(std::int32_t height) { return height / static_cast<double>(height_units); }

/// Returns the level of an inner node after an implicit step of stream power. Water is divided as by
/// catchments(); a share of it that runs down a slope erodes with that share of the rate times the
/// slope.
///
/// surface  height of the flooded ground at the node
/// level    of the ground, or of the water above it, at the node: metres, lower neighbours first
/// rate     K sqrt(A) dt, metres
double lowered(const std::int32_t* surface, const double* level, const NeighbourOffsets& offsets,
               double rate, double cell) {
    const FlowWeights weights = flow_weights(surface, offsets);
    const double straight = rate / (weights.sum * cell);
    const double diagonal = straight / root_two;
    double height = *level, divisor = 1.0;
    for (std::size_t k = 0; k < neighbours; ++k) {
        const double share = weights.of[k] * (is_diagonal(k) ? diagonal : straight);
        height += share * level[offsets[k]];
        divisor += share;
    }
    return std::min(*level, height / divisor);
}

/// Erodes heights, metres, for one step.
///
/// duration  in units of a step, at most 1
void erode(const Grid& grid, double duration, std::vector<double>& heights) {
    std::vector<std::int32_t> quantised(heights.size());
    std::transform(heights.begin(), heights.end(), quantised.begin(), quantised_height);
    const FloodedGround ground = flooded(grid, quantised);
    const std::vector<double> areas = catchments(grid, ground);
    const NeighbourOffsets offsets = neighbour_offsets(grid);
    const std::vector<std::uint8_t> is_inner = inner_nodes(grid);
    std::vector<double> level = heights;
    for (const std::uint32_t node : ground.order) {
        if (is_inner[node] == 0) continue;
        if (ground.heights[node] > quantised[node]) level[node] = metres(ground.heights[node]);
        const double rate = erodibility * duration * std::sqrt(areas[node] + slope_catchment);
        level[node] = lowered(&ground.heights[node], &level[node], offsets, rate, grid.cell);
        const double depth = level[node] - heights[node];
        heights[node] += depth > 0.0 ? sedimentation * duration * depth : depth;
    }
}

/// Smooths the values of a line with weights 1/4, 1/2, 1/4; its ends stay.
void smooth_line(int count, auto value) {
    double before = value(0);
    for (int i = 1; i + 1 < count; ++i) {
        const double here = value(i);
        value(i) = 0.25 * (before + value(i + 1)) + 0.5 * here;
        before = here;
    }
}

/// Gives the border the changes of the nodes next to it, so that no wall stays there, and smooths
/// all changes.
void finish(const Grid& grid, std::vector<double>& change) {
    const int last = grid.side - 1;
    for (int row = 0; row <= last; ++row)
        for (int column = 0; column <= last; ++column)
            if (column == 0 || row == 0 || column == last || row == last)
                change[grid.index(column, row)] = change[grid.index(std::clamp(column, 1, last - 1),
                                                                    std::clamp(row, 1, last - 1))];
    // Each pass adds half a squared cell to the variance.
    const double passes = std::max(1.0, std::floor(2.0 * creep * creep / (grid.cell * grid.cell)));
    for (int pass = 0; pass < static_cast<int>(passes); ++pass) {
        for (int row = 0; row <= last; ++row)
            smooth_line(grid.side, [&](int i) -> double& { return change[grid.index(i, row)]; });
        for (int column = 0; column <= last; ++column)
            smooth_line(grid.side, [&](int j) -> double& { return change[grid.index(column, j)]; });
    }
}

/// Returns the value halfway between the middle two of four equally spaced ones.
double halfway(double a, double b, double c, double d) {
    return 0.5625 * (b + c) - 0.0625 * (a + d);
}

/// Interpolates N values from each second one of them.
///
/// value  returns a reference to the value of a number, 0 <= number < N
void fill_between(int count, auto value) {
    const auto extended = [&](int i) {
        if (i < 0) return 2.0 * value(0) - value(-i);
        if (i >= count) return 2.0 * value(count - 1) - value(2 * (count - 1) - i);
        return 1.0 * value(i);
    };
    for (int i = 1; i < count; i += 2)
        value(i) = halfway(extended(i - 3), value(i - 1), value(i + 1), extended(i + 3));
}

/// Returns the next node on the way from an inner node to the border: of the neighbours to which
/// flooded ground falls, the one with the lowest ground.
///
/// source  heights before the flood
std::uint32_t downstream_of(const FloodedGround& ground, const std::vector<std::int32_t>& source,
                            const NeighbourOffsets& offsets, std::uint32_t node) {
    std::uint32_t lowest = node;
    for (const std::ptrdiff_t offset : offsets) {
        const auto other = static_cast<std::uint32_t>(node + offset);
        if (ground.heights[other] >= ground.heights[node]) continue;
        if (lowest == node || source[other] < source[lowest]) lowest = other;
    }
    return lowest;
}

/// Cuts the outlets of depressions to the height of their lowest nodes, where that is not deeper
/// than `most` units of height.
void cut_outlets(const Grid& grid, std::int32_t most, std::vector<std::int32_t>& heights) {
    const FloodedGround ground = flooded(grid, heights);
    const NeighbourOffsets offsets = neighbour_offsets(grid);
    const std::vector<std::uint8_t> is_inner = inner_nodes(grid);
    std::vector<std::uint32_t> path;
    for (const std::uint32_t node : ground.order) {
        if (ground.heights[node] == heights[node] || is_inner[node] == 0) continue;
        const bool is_lowest = std::none_of(
            offsets.begin(), offsets.end(),
            [&](std::ptrdiff_t offset) { return heights[node + offset] < heights[node]; });
        if (!is_lowest) continue;
        path.clear();
        std::int32_t height = heights[node], depth = 0;
        std::uint32_t at = node;
        while (is_inner[at] != 0 && depth <= most) {
            at = downstream_of(ground, heights, offsets, at);
            if (heights[at] < height) break;
            path.push_back(at);
            --height;
            depth = std::max(depth, heights[at] - height);
        }
        if (depth > most) continue;
        height = heights[node];
        for (const std::uint32_t one : path) heights[one] = --height;
    }
}

}  // namespace

Grid erosion_grid(const Grid& grid) {
    if (grid.side < 5 || grid.side % 2 == 0)
        throw InvalidInput("", "the side of an eroded grid is odd and at least 5");
    return {(grid.side + 1) / 2, 2.0 * grid.cell, grid.origin};
}

std::vector<double> erosion_change(const Grid& grid, std::span<const std::int32_t> heights,
                                   double strength) {
    require_values(grid, heights.size());
    if (!(strength >= 0.0 && strength <= 1.0))
        throw InvalidInput("erosion", "is not between 0 and 1");
    const Grid coarse = erosion_grid(grid);
    std::vector<double> before(coarse.nodes());
    for (int row = 0; row < coarse.side; ++row)
        for (int column = 0; column < coarse.side; ++column)
            before[coarse.index(column, row)] = metres(heights[grid.index(2 * column, 2 * row)]);
    std::vector<double> after = before;
    const double time = strength * most_erosion_steps;
    const int steps = static_cast<int>(std::ceil(time));
    for (int step = 0; step < steps; ++step) erode(coarse, time / steps, after);
    for (std::size_t i = 0; i < after.size(); ++i) after[i] -= before[i];
    if (steps > 0) finish(coarse, after);
    return after;
}

std::vector<double> interpolated(const Grid& grid, std::span<const double> coarse) {
    const Grid from = erosion_grid(grid);
    require_values(from, coarse.size());
    std::vector<double> out(grid.nodes());
    for (int row = 0; row < from.side; ++row) {
        for (int column = 0; column < from.side; ++column)
            out[grid.index(2 * column, 2 * row)] = coarse[from.index(column, row)];
        fill_between(grid.side, [&](int i) -> double& { return out[grid.index(i, 2 * row)]; });
    }
    for (int column = 0; column < grid.side; ++column)
        fill_between(grid.side, [&](int j) -> double& { return out[grid.index(column, j)]; });
    return out;
}

std::vector<std::int32_t> eroded(const Grid& grid, std::vector<std::int32_t> heights,
                                 double strength) {
    const std::vector<double> change = interpolated(grid, erosion_change(grid, heights, strength));
    const bool is_level = std::all_of(heights.begin(), heights.end(), [&](std::int32_t height) {
        return height == heights.front();
    });
    // The flood would give level ground the rise that makes it drain.
    if (is_level) return heights;
    for (std::size_t i = 0; i < heights.size(); ++i) heights[i] += quantised_height(change[i]);
    const double progress = std::min(1.0, strength / filling_strength);
    if (progress == 0.0) return heights;
    cut_outlets(grid, quantised_height(progress * most_cut * grid.cell), heights);
    const FloodedGround water = flooded(grid, heights);
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const double depth = water.heights[i] - heights[i];
        heights[i] += static_cast<std::int32_t>(std::floor(progress * most_filled * depth + 0.5));
    }
    return heights;
}

}  // namespace sporeprint
