#include "core/world/wind.h"

#include <algorithm>
#include <cmath>

#include "core/math/elementary.h"
#include "core/problems.h"
#include "core/world/drainage.h"

namespace sporeprint {

namespace {

/// Length over which slopes and curvatures are taken, metres: half of that of a hill.
constexpr double relief_length = 30.0;

/// The greatest slope and curvature are taken as at least these.
constexpr double gentle_slope = 0.15, gentle_curvature = 0.02;

/// Weights of slope and curvature, and attenuation of the wind among plants.
constexpr double slope_weight = 0.5, curvature_weight = 0.5, attenuation = 2.0;

/// Displacement and roughness of plants as shares of their height.
constexpr double displacement = 0.65, roughness = 0.1;

/// Height above plants at which the wind is that of the climate, metres.
constexpr double reference_height = 10.0;

constexpr double shape_units = 254.0;

std::int8_t quantised_shape(double value) {
    return static_cast<std::int8_t>(
        std::clamp(std::floor(value * shape_units + 0.5), -127.0, 127.0));
}

/// Slope and curvature before they are scaled.
struct Relief {
    double east = 0.0, north = 0.0, curvature = 0.0;
};

/// Returns slope and curvature at a node from the heights some nodes away. Beyond the border the ground is level.
Relief relief_at(const Grid& grid, std::span<const std::int32_t> heights, int column, int row,
                 int reach) {
    const int low_column = std::max(column - reach, 0), low_row = std::max(row - reach, 0);
    const int high_column = std::min(column + reach, grid.side - 1),
              high_row = std::min(row + reach, grid.side - 1);
    const auto at = [&](int i, int j) {
        return static_cast<double>(heights[grid.index(i, j)]) / height_units;
    };
    const double here = at(column, row);
    const double west = at(low_column, row), east = at(high_column, row);
    const double south = at(column, low_row), north = at(column, high_row);
    const double diagonals = at(low_column, low_row) + at(high_column, high_row) +
                             at(low_column, high_row) + at(high_column, low_row);
    const double length = reach * grid.cell;
    Relief out;
    out.east = (east - west) / ((high_column - low_column) * grid.cell);
    out.north = (north - south) / ((high_row - low_row) * grid.cell);
    out.curvature = 0.25 *
                    ((2.0 * here - 0.5 * (west + east + south + north)) +
                     (2.0 * here - 0.5 * diagonals) / std::sqrt(2.0)) /
                    (2.0 * length);
    return out;
}

/// A shape between nodes, scaled.
struct ScaledRelief {
    double east = 0.0, north = 0.0, curvature = 0.0;
};

ScaledRelief scaled_at(const WindRelief& relief, double x, double y) {
    const Grid& grid = relief.grid;
    const auto along = [&](double metres) {
        return std::clamp((metres - grid.origin) / grid.cell, 0.0, grid.side - 1.0);
    };
    const double column = along(x), row = along(y);
    const int i = std::min(static_cast<int>(column), grid.side - 2);
    const int j = std::min(static_cast<int>(row), grid.side - 2);
    const double t = column - i, u = row - j;
    const WindRelief::Shape* const south = &relief.shapes[grid.index(i, j)];
    const WindRelief::Shape* const north = south + grid.side;
    const auto value = [&](std::int8_t WindRelief::Shape::*member) {
        const double below = south[0].*member + (south[1].*member - south[0].*member) * t;
        const double above = north[0].*member + (north[1].*member - north[0].*member) * t;
        return (below + (above - below) * u) / shape_units;
    };
    return {value(&WindRelief::Shape::east), value(&WindRelief::Shape::north),
            value(&WindRelief::Shape::curvature)};
}

/// Returns the speed at a height above the tops of plants, as a share of that 10 m above them.
double logarithmic_share(double height, double plants) {
    const double lift = displacement * plants, rough = roughness * plants;
    return logarithm((height - lift) / rough) /
           logarithm((plants + reference_height - lift) / rough);
}

}  // namespace

WindRose wind_rose(const ClimateParams& climate) {
    constexpr int parts = 32;  // of a sector: more change no share by 1e-4
    constexpr double width = 2.0 * pi / wind_sectors;
    const double main = radians(climate.wind_from_deg);
    WindRose rose;
    double sum = 0.0;
    for (std::size_t k = 0; k < wind_sectors; ++k) {
        const double middle = width * static_cast<double>(k);
        for (int part = 0; part < parts; ++part) {
            const double from = middle + width * ((part + 0.5) / parts - 0.5);
            rose[k].share += exponential(climate.wind_focus * (cosine(from - main) - 1.0));
        }
        sum += rose[k].share;
        const auto [sine_from, cosine_from] = sine_cosine(middle);
        rose[k].speed = climate.wind_speed;
        rose[k].east = -sine_from;
        rose[k].north = -cosine_from;
    }
    for (WindSector& sector : rose) sector.share /= sum;
    return rose;
}

WindRelief wind_relief(const Grid& grid, std::span<const std::int32_t> heights) {
    require_values(grid, heights.size());
    if (grid.side < 5 || grid.side % 2 == 0)
        throw InvalidInput("", "the wind needs an odd number of nodes a side, at least 5");
    WindRelief out;
    out.grid = {(grid.side + 1) / 2, 2.0 * grid.cell, grid.origin};
    const int reach = std::max(1, static_cast<int>(std::floor(relief_length / grid.cell + 0.5)));
    std::vector<Relief> all;
    all.reserve(out.grid.nodes());
    double steepest = gentle_slope, sharpest = gentle_curvature;
    for (int row = 0; row < grid.side; row += 2)
        for (int column = 0; column < grid.side; column += 2) {
            const Relief one = relief_at(grid, heights, column, row, reach);
            steepest = std::max(steepest, std::sqrt(one.east * one.east + one.north * one.north));
            sharpest = std::max(sharpest, std::abs(one.curvature));
            all.push_back(one);
        }
    out.shapes.reserve(all.size());
    for (const Relief& one : all)
        out.shapes.push_back({quantised_shape(0.5 * one.east / steepest),
                              quantised_shape(0.5 * one.north / steepest),
                              quantised_shape(0.5 * one.curvature / sharpest)});
    return out;
}

LocalWind wind_at(const WindRelief& relief, double x, double y, const WindSector& sector) {
    const ScaledRelief shape = scaled_at(relief, x, y);
    const double climb = shape.east * sector.east + shape.north * sector.north;
    LocalWind out{1.0 + slope_weight * climb + curvature_weight * shape.curvature, sector.east,
                  sector.north};
    if (climb <= 0.0) return out;
    // sin(2 d) is 2 sin(d) cos(d), where d is the angle from the wind to the direction that the slope faces.
    const double across = shape.east * sector.north - shape.north * sector.east;
    const double square = shape.east * shape.east + shape.north * shape.north;
    const auto [sine_turn, cosine_turn] = sine_cosine(-climb * (across * climb / square));
    out.east = sector.east * cosine_turn + sector.north * sine_turn;
    out.north = sector.north * cosine_turn - sector.east * sine_turn;
    return out;
}

double wind_above_grass(double speed, double height, double grass) {
    const double at_top = speed * logarithmic_share(grass, grass);
    if (height < grass) return at_top * exponential(attenuation * (height / grass - 1.0));
    return speed * logarithmic_share(height, grass);
}

double wind_below_crowns(double speed, double height, double crown_top) {
    constexpr double floor_layer = 0.05, floor_roughness = 0.004;
    const double at_top = speed * logarithmic_share(crown_top, crown_top);
    const double layer = floor_layer * crown_top;
    const double above = std::max(height, layer);
    const double share = exponential(attenuation * (above / crown_top - 1.0));
    if (height >= layer) return at_top * share;
    if (height <= floor_roughness) return 0.0;
    return at_top * share * logarithm(height / floor_roughness) /
           logarithm(layer / floor_roughness);
}

double wind_near_ground(double speed, double height, const WindCover& cover) {
    const double open = wind_above_grass(speed, height, cover.grass);
    if (cover.crown_top < 1.0 || cover.closure <= 0.0) return open;
    const double covered =
        wind_below_crowns(speed, std::min(height, cover.crown_top), cover.crown_top);
    return open + (covered - open) * cover.closure;
}

}  // namespace sporeprint
