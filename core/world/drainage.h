// Water on the ground of a world: how it runs off a grid of integer heights, where it gathers, and
// how wet places are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/world/height_field.h"

namespace sporeprint {

/// Ground on which every place drains to the border of the grid.
struct FloodedGround {
    /// Heights in 1/height_units m, not below those of the ground. From every inner node a path of
    /// neighbours leads to the border on which each is lower than the one before.
    std::vector<std::int32_t> heights;
    /// All nodes from the lowest to the highest, equal heights by index: every node stands behind
    /// the lower ones that its water runs to.
    std::vector<std::uint32_t> order;
};

/// Fills depressions up to their outlets, and a little more the farther nodes are from these
/// (Priority-Flood with epsilon): 1 to 4 units of height for each node on the way, half as much
/// again for diagonal ones, so that the paths of water wind. Ground that drains already does not
/// change.
///
/// grid     side N >= 3
/// heights  N*N heights in 1/height_units m, |height| < 2^30
/// throws   InvalidInput if there are not N*N heights or N is too small
/// cost     O(n log h) for n nodes and h units between the lowest and the highest
/// source   [Barnes2014] algorithm 3; differs: cells of depressions pass through the same queue,
///          ordered by height and index, and the rise is a few units of an integer. The queue is
///          that of [Ahuja1990]
[[nodiscard]] FloodedGround flooded(const Grid& grid, std::span<const std::int32_t> heights);

/// Returns the catchment of each node: the area whose water runs through it, its own cell included.
/// Water of an inner node runs to all lower neighbours, in proportion to slope times contour length:
/// 1/2 cell for the four along rows and columns, sqrt(2)/4 = 0.354 for the diagonal ones. Water
/// leaves the world at nodes of the border.
///
/// returns  N*N areas, m^2; the sum of those of the border is the whole area
/// throws   InvalidInput if the sizes differ
/// source   [Quinn1991]
[[nodiscard]] std::vector<double> catchments(const Grid& grid, const FloodedGround& ground);

/// The fixed point of stored wetness indices: (index + wetness_offset) * wetness_units, so -8 to
/// 23.999 in steps of 1/2048.
inline constexpr double wetness_offset = 8.0, wetness_units = 2048.0;

/// The least slope (tan) that a wetness index is computed with.
inline constexpr double least_slope = 0.005;

/// Returns the topographic wetness index ln(a / tan(beta)) of each node. The specific catchment area
/// a is the catchment over the length of the contour that its water crosses, metres; tan(beta) is
/// the mean slope to the lower neighbours weighted with those lengths, at least `least_slope`. At
/// the border, where water leaves, the contour is one cell and the slope that of the ground.
///
/// areas    from catchments()
/// returns  N*N indices as fixed-point numbers, see wetness_units
/// throws   InvalidInput if the sizes differ
/// source   [BevenKirkby1979] for the index, [Quinn1991] for its terms
[[nodiscard]] std::vector<std::uint16_t> wetness_index(const Grid& grid,
                                                       const FloodedGround& ground,
                                                       std::span<const double> areas);

/// Returns a stored wetness index as a number.
[[nodiscard]] constexpr double wetness_of(std::uint16_t stored) {
    return stored / wetness_units - wetness_offset;
}

/// The catchment from which water runs in a stream, m^2: 2 ha.
inline constexpr double stream_catchment = 20000.0;

/// Returns 1 for each node whose catchment is larger than stream_catchment, otherwise 0.
[[nodiscard]] std::vector<std::uint8_t> streams(std::span<const double> areas);

/// Throws InvalidInput if a grid has fewer than 3 nodes a side or not one value for each node.
void require_values(const Grid& grid, std::size_t values);

}  // namespace sporeprint
