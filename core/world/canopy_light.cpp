#include "core/world/canopy_light.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/math/elementary.h"
#include "core/problems.h"

namespace sporeprint {

namespace {

/// Side of a cell, metres.
constexpr double cell = 4.0;

/// Sine and cosine of 55 degrees, and of 45.
constexpr double ring_up = 0.81915204428899180, ring_across = 0.57357643635104609;
constexpr double diagonal = 0.70710678118654752;

struct Direction {
    double east, north;  ///< unit vector in the plane; 0 for the zenith
    double across, up;   ///< unit vector in the vertical plane of it
};

constexpr std::array<Direction, sky_directions> directions = {{
    {0.0, 0.0, 0.0, 1.0},
    {0.0, 1.0, ring_across, ring_up},
    {diagonal, diagonal, ring_across, ring_up},
    {1.0, 0.0, ring_across, ring_up},
    {diagonal, -diagonal, ring_across, ring_up},
    {0.0, -1.0, ring_across, ring_up},
    {-diagonal, -diagonal, ring_across, ring_up},
    {-1.0, 0.0, ring_across, ring_up},
    {-diagonal, diagonal, ring_across, ring_up},
}};

/// An ellipsoid as a sphere of radius 1: factors of metres across and up.
struct Ellipsoid {
    explicit Ellipsoid(const Crown& crown)
        : x(crown.x),
          y(crown.y),
          middle(0.5 * (crown.base + crown.top)),
          across(1.0 / crown.radius),
          up(2.0 / (crown.top - crown.base)) {}

    double x, y, middle, across, up;
};

/// A ray of one direction in the coordinates of one crown, in which that is a unit sphere.
struct CrownRay {
    CrownRay(const Ellipsoid& crown, const Direction& sky)
        : across(sky.across * crown.across),
          up(sky.up * crown.up),
          square(across * across + up * up) {}

    double across, up, square;
};

/// Returns the length of the chord of a ray from a place through a crown, metres; 0 if there is none.
inline double chord_of(const Ellipsoid& crown, const Direction& sky, const CrownRay& ray, double x,
                       double y, double height) {
    const double east = crown.x - x, north = crown.y - y;
    const double distance = east * east + north * north;
    const double ahead = (east * sky.east + north * sky.north) * crown.across;
    const double above = (crown.middle - height) * crown.up;
    const double b = ahead * ray.across + above * ray.up;
    const double c = distance * (crown.across * crown.across) + above * above - 1.0;
    const double discriminant = b * b - ray.square * c;
    // One test instead of two: which of them fails is hard to predict.
    const bool is_met = (discriminant > 0.0) & (distance <= shade_reach * shade_reach);
    if (!is_met) return 0.0;
    const double root = std::sqrt(discriminant);
    return std::max(0.0, (b + root) - std::max(0.0, b - root)) / ray.square;
}

bool has_leaves(const Crown& crown) {
    return crown.radius > 0.0 && crown.top > crown.base && crown.density > 0.0;
}

/// Returns the share of the light that is left after a path through leaves, metres.
double light_after(double path, double leaves) {
    return path > 0.0 ? exponential(-extinction * leaf_area_density * leaves * path) : 1.0;
}

}  // namespace

CanopyLight::CanopyLight(std::span<const Crown> crowns) {
    crowns_.reserve(crowns.size());
    double west = 0.0, east = 0.0, south = 0.0, north = 0.0;
    for (const Crown& crown : crowns) {
        if (!has_leaves(crown)) continue;
        const double reach = shade_reach + crown.radius;
        const bool is_first = crowns_.empty();
        west = is_first ? crown.x - reach : std::min(west, crown.x - reach);
        east = is_first ? crown.x + reach : std::max(east, crown.x + reach);
        south = is_first ? crown.y - reach : std::min(south, crown.y - reach);
        north = is_first ? crown.y + reach : std::max(north, crown.y + reach);
        crowns_.push_back(crown);
    }
    if (crowns_.empty()) return;
    west_ = std::floor(west / cell) * cell;
    south_ = std::floor(south / cell) * cell;
    columns_ = static_cast<int>((east - west_) / cell) + 1;
    rows_ = static_cast<int>((north - south_) / cell) + 1;
    for (std::size_t direction = 0; direction < sky_directions; ++direction)
        index_[direction] = index_of(direction);
}

CanopyLight::Index CanopyLight::index_of(std::size_t direction) const {
    constexpr double half_diagonal = cell * diagonal;
    const Direction& sky = directions[direction];
    const bool is_zenith = direction == 0;
    // Calls use(cell) for all cells from places of which a crown may be seen in the direction.
    const auto each_cell = [&](const Crown& crown, auto use) {
        const double radius = crown.radius;
        const double behind = (is_zenith ? radius : shade_reach) + half_diagonal;
        const double beside = radius + half_diagonal;
        const double reach = std::max(behind, beside);
        const auto number = [](double metres, double origin, int most) {
            return std::clamp(static_cast<int>(std::floor((metres - origin) / cell)), 0, most - 1);
        };
        const int last_row = number(crown.y + reach, south_, rows_);
        const int last_column = number(crown.x + reach, west_, columns_);
        for (int row = number(crown.y - reach, south_, rows_); row <= last_row; ++row)
            for (int column = number(crown.x - reach, west_, columns_); column <= last_column;
                 ++column) {
                const double x = crown.x - (west_ + (column + 0.5) * cell);
                const double y = crown.y - (south_ + (row + 0.5) * cell);
                if (is_zenith) {
                    if (x * x + y * y > beside * beside) continue;
                } else {
                    const double ahead = x * sky.east + y * sky.north;
                    const double aside = x * sky.north - y * sky.east;
                    if (ahead < -beside || ahead > behind || std::abs(aside) > beside) continue;
                }
                use(static_cast<std::size_t>(row * columns_ + column));
            }
    };
    Index out;
    out.first.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
    for (const Crown& crown : crowns_)
        each_cell(crown, [&](std::size_t one) { ++out.first[one + 1]; });
    for (std::size_t i = 1; i < out.first.size(); ++i) out.first[i] += out.first[i - 1];
    out.crowns.resize(out.first.back());
    std::vector<std::uint32_t> next = out.first;
    for (std::uint32_t i = 0; i < crowns_.size(); ++i)
        each_cell(crowns_[i], [&](std::size_t one) { out.crowns[next[one]++] = i; });
    return out;
}

double CanopyLight::at(double x, double y, double height, double leaves) const {
    const double column = std::floor((x - west_) / cell), row = std::floor((y - south_) / cell);
    if (column < 0.0 || row < 0.0 || column >= columns_ || row >= rows_) return 1.0;
    const auto here = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                      static_cast<std::size_t>(column);
    double light = 0.0;
    for (std::size_t k = 0; k < sky_directions; ++k) {
        const Direction& sky = directions[k];
        const Index& index = index_[k];
        double path = 0.0;
        for (std::uint32_t i = index.first[here]; i < index.first[here + 1]; ++i) {
            const Crown& crown = crowns_[index.crowns[i]];
            const Ellipsoid shape(crown);
            path += crown.density * chord_of(shape, sky, CrownRay(shape, sky), x, y, height);
        }
        light += light_after(path, leaves);
    }
    return light / static_cast<double>(sky_directions);
}

std::vector<double> canopy_light_on(const PlaceLattice& places, std::span<const double> heights,
                                    std::span<const Crown> crowns, double leaves) {
    const std::size_t columns = static_cast<std::size_t>(std::max(0, places.columns)),
                      rows = static_cast<std::size_t>(std::max(0, places.rows));
    if (heights.size() != columns * rows)
        throw InvalidInput("", "one height is needed for each place of a lattice");
    std::vector<double> light(heights.size(), 0.0), paths(heights.size());
    if (heights.empty()) return light;
    const auto [lowest, highest] = std::ranges::minmax(heights);
    constexpr double per_height = ring_across / ring_up;
    // The first place not before a coordinate, and the first one beyond it.
    const auto number = [&](double metres, double origin, int most) {
        return static_cast<int>(
            std::clamp((metres - origin) / places.step, -1.0, static_cast<double>(most)));
    };
    for (std::size_t k = 0; k < sky_directions; ++k) {
        const Direction& sky = directions[k];
        std::fill(paths.begin(), paths.end(), 0.0);
        for (const Crown& crown : crowns) {
            if (!has_leaves(crown) || crown.top <= lowest) continue;
            const Ellipsoid shape(crown);
            const CrownRay ray(shape, sky);
            // The shadow on a level plane is an ellipse: the crown's breadth to the sides, and its breadth and height
            // along the direction. It is one cell larger here than it is, against rounding.
            const double half_height = 0.5 * (crown.top - crown.base) * per_height;
            const double length =
                k == 0 ? crown.radius
                       : std::sqrt(crown.radius * crown.radius + half_height * half_height);
            const double nearest = k == 0 ? 0.0 : (shape.middle - highest) * per_height;
            const double farthest = k == 0 ? 0.0 : (shape.middle - lowest) * per_height;
            const auto bounds = [&](double centre, double along) {
                const double one = centre - along * nearest, other = centre - along * farthest;
                const double reach =
                    std::sqrt(length * length * along * along +
                              crown.radius * crown.radius * (1.0 - along * along)) +
                    0.01;
                return std::pair(
                    std::max(std::min(one, other) - reach, centre - shade_reach - 0.01),
                    std::min(std::max(one, other) + reach, centre + shade_reach + 0.01));
            };
            const auto [west, east] = bounds(crown.x, sky.east);
            const auto [south, north] = bounds(crown.y, sky.north);
            const int last_row =
                std::min(number(north, places.south, places.rows), places.rows - 1);
            const int last_column =
                std::min(number(east, places.west, places.columns), places.columns - 1);
            const int first_column = std::max(0, number(west, places.west, places.columns));
            for (int row = std::max(0, number(south, places.south, places.rows)); row <= last_row;
                 ++row) {
                const double y = places.south + row * places.step;
                const std::size_t begin = static_cast<std::size_t>(row) * columns;
                for (int column = first_column; column <= last_column; ++column) {
                    const std::size_t i = begin + static_cast<std::size_t>(column);
                    const double x = places.west + column * places.step;
                    paths[i] += crown.density * chord_of(shape, sky, ray, x, y, heights[i]);
                }
            }
        }
        for (std::size_t i = 0; i < light.size(); ++i) light[i] += light_after(paths[i], leaves);
    }
    for (double& one : light) one /= static_cast<double>(sky_directions);
    return light;
}

}  // namespace sporeprint
