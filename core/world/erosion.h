// Erosion of a world's ground by running water, which cuts valleys into hills.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/world/height_field.h"

namespace sporeprint {

/// Steps of erosion at strength 1.
inline constexpr int most_erosion_steps = 50;

/// Returns the grid with every second node of `grid`, on which erosion is computed.
///
/// throws  InvalidInput if the side is even or below 5
[[nodiscard]] Grid erosion_grid(const Grid& grid);

/// Returns the change of heights by erosion. Stream power dz/dt = U - K A^(1/2) S is integrated
/// implicitly, from the border upstream; heights are relative to the border, which rises with the
/// uplift U. A is the catchment plus 900 m^2, so that slopes retreat too. In depressions sediment
/// fills a share of the depth of the water in each step, while their outlets are cut. At last the
/// border takes the changes of the nodes beside it, and creep smooths all changes over 4 m, or one
/// cell if that is more.
///
/// grid      side N, odd
/// heights   N*N heights in 1/height_units m
/// strength  0..1; the number of steps is 50 times that, rounded up, and all are equally long
/// returns   M*M changes on erosion_grid(), M = (N + 1) / 2, metres, above 0 where there is sediment
/// throws    InvalidInput if the strength is out of range (path "erosion"), or sizes do not fit
/// cost      a flood of the coarse grid, each step
/// source    [BraunWillett2013]; differs: the order is that of the flood, and water is divided
///           among all lower neighbours as by catchments(), since channels along eight directions
///           show
[[nodiscard]] std::vector<double> erosion_change(const Grid& grid,
                                                 std::span<const std::int32_t> heights,
                                                 double strength);

/// Returns values of every second node interpolated to all nodes of `grid` by Catmull-Rom splines;
/// beyond the border they continue linearly.
///
/// coarse   M*M values on erosion_grid(grid)
/// returns  N*N values; those of common nodes are equal
/// throws   InvalidInput if sizes do not fit
[[nodiscard]] std::vector<double> interpolated(const Grid& grid, std::span<const double> coarse);

/// Returns heights after erosion: each with the interpolated change, rounded to the nearest unit.
/// Then, up to strength 0.5 in proportion to it, outlets of depressions are cut where a quarter of a
/// cell is deep enough, and sediment fills three quarters of the depth of those that remain. Strength
/// 0 changes nothing, and level ground stays level.
///
/// heights  in 1/height_units m
/// throws   as erosion_change()
/// source   [Lindsay2016] for the cuts; differs: deep outlets are not cut at all
[[nodiscard]] std::vector<std::int32_t> eroded(const Grid& grid, std::vector<std::int32_t> heights,
                                               double strength);

}  // namespace sporeprint
