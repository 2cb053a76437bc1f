#include "core/world/ground.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/params/canonical.h"
#include "core/problems.h"
#include "core/world/drainage.h"
#include "core/world/erosion.h"
#include "core/world/weather.h"

namespace sporeprint {

namespace {

/// Returns a value between four nodes, linear in both directions.
template <class T>
double linear_at(const Grid& grid, const std::vector<T>& values, const Coordinate& x,
                 const Coordinate& y) {
    const T* const first = &values[grid.index(x.node, y.node)];
    const auto along = [&](const T* row) {
        const double west = row[0], east = row[1];
        return west + (east - west) * x.part;
    };
    const double south = along(first), north = along(first + grid.side);
    return south + (north - south) * y.part;
}

/// Returns the greatest difference of neighbours along rows and columns.
std::int32_t greatest_step(const Grid& grid, const std::vector<std::int32_t>& heights) {
    std::int32_t step = 0;
    for (int row = 0; row < grid.side; ++row)
        for (int column = 0; column < grid.side; ++column) {
            const std::int32_t here = heights[grid.index(column, row)];
            if (column > 0)
                step = std::max(step, std::abs(here - heights[grid.index(column - 1, row)]));
            if (row > 0)
                step = std::max(step, std::abs(here - heights[grid.index(column, row - 1)]));
        }
    return step;
}

/// Width of the cells in which water is followed at least, metres: in finer ones it would gather in threads, and the
/// wetness of a place would depend on the extent of its world.
constexpr double water_cell = 2.5;

/// Returns every so many values along rows and columns.
template <class T>
std::vector<T> thinned(const Grid& grid, const std::vector<T>& values, int step) {
    std::vector<T> out;
    for (int row = 0; row < grid.side; row += step)
        for (int column = 0; column < grid.side; column += step)
            out.push_back(values[grid.index(column, row)]);
    return out;
}

/// Returns values of a thinned grid at all nodes, linear between those it has and rounded to the nearest.
template <class T>
std::vector<T> filled_up(const Grid& grid, const Grid& coarse, const std::vector<T>& values,
                         int step) {
    if (step == 1) return values;
    std::vector<T> out(grid.nodes());
    const int whole = step * step;
    for (int row = 0; row < grid.side; ++row)
        for (int column = 0; column < grid.side; ++column) {
            const int i = std::min(column / step, coarse.side - 2),
                      j = std::min(row / step, coarse.side - 2), x = column - i * step,
                      y = row - j * step;
            const T* const south = &values[coarse.index(i, j)];
            const T* const north = south + coarse.side;
            const int sum = (step - y) * ((step - x) * south[0] + x * south[1]) +
                            y * ((step - x) * north[0] + x * north[1]);
            out[grid.index(column, row)] = static_cast<T>((sum + whole / 2) / whole);
        }
    return out;
}

/// Lets water run over the ground: sets its wetness and its streams.
void follow_water(Ground& ground) {
    const Grid& grid = ground.grid;
    const int step = std::max(1, static_cast<int>(std::lround(water_cell / grid.cell)));
    const Grid coarse{(grid.side - 1) / step + 1, step * grid.cell, grid.origin};
    const FloodedGround flood = flooded(coarse, thinned(grid, ground.heights, step));
    const std::vector<double> areas = catchments(coarse, flood);
    ground.wetness = filled_up(grid, coarse, wetness_index(coarse, flood, areas), step);
    ground.streams = filled_up(grid, coarse, streams(areas), step);
}

/// Sets what is known of the nodes within the world.
void measure(Ground& ground, const WorldBox& extent) {
    const Grid& grid = ground.grid;
    const auto is_within = [&](double place) {
        return place >= extent.west && place <= extent.east;
    };
    double sum = 0.0, count = 0.0;
    std::int32_t lowest = INT32_MAX, highest = INT32_MIN;
    for (int row = 0; row < grid.side; ++row)
        for (int column = 0; column < grid.side; ++column) {
            if (!is_within(grid.place(column)) || !is_within(grid.place(row))) continue;
            const std::size_t i = grid.index(column, row);
            sum += wetness_of(ground.wetness[i]);
            count += 1.0;
            lowest = std::min(lowest, ground.heights[i]);
            highest = std::max(highest, ground.heights[i]);
        }
    ground.mean_wetness = sum / count;
    // Of the weights of a spline in two directions, the negative ones add up to 9/32 at most: so far may a value
    // lie beyond its 16 nodes, whose values differ by six steps at most.
    const double beyond = 9.0 / 32.0 * 6.0 * greatest_step(grid, ground.heights);
    ground.lowest = std::floor((lowest - beyond) / height_units);
    ground.highest = std::max(std::ceil((highest + beyond) / height_units), ground.lowest + 1.0);
}

}  // namespace

WorldBox extent_of(const WorldParams& params) {
    const double half = 0.5 * params.extent;
    return {-half, -half, half, half};
}

std::size_t Ground::bytes() const {
    return sizeof(Ground) + heights.size() * sizeof(heights[0]) +
           wetness.size() * sizeof(wetness[0]) + streams.size() * sizeof(streams[0]);
}

Ground ground_of(const WorldParams& params, const TerrainMap* terrain) {
    if (!params.terrain.id.empty() && terrain == nullptr)
        throw InvalidInput("terrain.id", "the terrain " + params.terrain.id.string() +
                                             " is not stored; upload it again");
    Ground out;
    out.grid = world_grid(params.extent);
    out.heights = terrain != nullptr
                      ? heights_of(*terrain, params.extent)
                      : eroded(out.grid, heights_of(params.terrain, params.seed, params.extent),
                               params.terrain.erosion);
    follow_water(out);
    measure(out, extent_of(params));
    return out;
}

std::string ground_key(const WorldParams& params) {
    if (!params.terrain.id.empty())
        return "ground " + params.terrain.id.string() + ' ' + std::to_string(params.extent.value);
    std::string key =
        "ground " + std::to_string(params.seed) + ' ' + std::to_string(params.extent.value) + ' ';
    TerrainParams terrain = params.terrain;
    terrain.micro = 0.0;  // is added where the ground is shown
    canonical(terrain, key);
    return key;
}

Coordinate coordinate_at(const Grid& grid, double metres) {
    const double number = (metres - grid.origin) / grid.cell;
    // The grid reaches beyond the world, so that splines have their four nodes everywhere in it.
    const int node = std::clamp(static_cast<int>(std::floor(number)), 1, grid.side - 3);
    const double t = number - node, t2 = t * t, t3 = t2 * t;
    return {
        node,
        t,
        {-0.5 * t + t2 - 0.5 * t3, 1.0 - 2.5 * t2 + 1.5 * t3, 0.5 * t + 2.0 * t2 - 1.5 * t3,
         -0.5 * t2 + 0.5 * t3},
        {-0.5 + 2.0 * t - 1.5 * t2, -5.0 * t + 4.5 * t2, 0.5 + 4.0 * t - 4.5 * t2, -t + 1.5 * t2}};
}

Place place_at(const Ground& ground, const Coordinate& x, const Coordinate& y) {
    const std::int32_t* row = &ground.heights[ground.grid.index(x.node - 1, y.node - 1)];
    Place sum;
    for (std::size_t j = 0; j < 4; ++j, row += ground.grid.side) {
        const double h[] = {static_cast<double>(row[0]), static_cast<double>(row[1]),
                            static_cast<double>(row[2]), static_cast<double>(row[3])};
        const auto weighted = [&](const std::array<double, 4>& w) {
            return w[0] * h[0] + w[1] * h[1] + w[2] * h[2] + w[3] * h[3];
        };
        const double value = weighted(x.value);
        sum.height += y.value[j] * value;
        sum.east += y.value[j] * weighted(x.rise);
        sum.north += y.rise[j] * value;
    }
    const double per_metre = 1.0 / (height_units * ground.grid.cell);
    return {sum.height / height_units, sum.east * per_metre, sum.north * per_metre};
}

double wetness_index_at(const Ground& ground, const Coordinate& x, const Coordinate& y) {
    return linear_at(ground.grid, ground.wetness, x, y) / wetness_units - wetness_offset;
}

double stream_at(const Ground& ground, const Coordinate& x, const Coordinate& y) {
    return linear_at(ground.grid, ground.streams, x, y);
}

double wetness_on(const Ground& ground, double index, double soil_water) {
    constexpr double transmissivity_depth = 25.0, dry = 100.0;  // mm
    // Where there is hardly any water, hollows have none to gather.
    const double left = std::min(1.0, soil_water / 20.0);
    const double deficit =
        most_soil_water - soil_water + transmissivity_depth * (ground.mean_wetness - index);
    return left * std::clamp(1.0 - deficit / dry, 0.0, 1.0);
}

}  // namespace sporeprint
