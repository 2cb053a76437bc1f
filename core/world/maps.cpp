#include "core/world/maps.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/math/elementary.h"
#include "core/world/drainage.h"

namespace sporeprint {

namespace {

/// Rows that one task computes.
constexpr int stripe_rows = 32;

/// Calls use(index, x, y) for each place of a frame, stripes of rows by tasks.
template <class Use>
void each_place(const Grid& grid, const MapFrame& frame, const Parallel& parallel, const Use& use) {
    std::vector<Coordinate> columns;
    columns.reserve(static_cast<std::size_t>(frame.width));
    for (int column = 0; column < frame.width; ++column)
        columns.push_back(coordinate_at(grid, frame.x(column)));
    const auto stripe = [&](int first) {
        auto index = static_cast<std::size_t>(first) * columns.size();
        for (int row = first; row < std::min(first + stripe_rows, frame.height); ++row) {
            const Coordinate y = coordinate_at(grid, frame.y(row));
            for (const Coordinate& x : columns) use(index++, x, y);
        }
    };
    std::vector<std::function<void()>> tasks;
    for (int first = 0; first < frame.height; first += stripe_rows)
        tasks.emplace_back([&stripe, first] { stripe(first); });
    parallel(tasks);
}

double slope_at(const Ground& ground, const Coordinate& x, const Coordinate& y) {
    const Place place = place_at(ground, x, y);
    const double rise = std::sqrt(place.east * place.east + place.north * place.north);
    return arc_tangent(rise, 1.0) * (180.0 / pi);
}

/// Returns the direction downhill, degrees clockwise from north; 0 on level ground.
double aspect_at(const Ground& ground, const Coordinate& x, const Coordinate& y) {
    const Place place = place_at(ground, x, y);
    const double angle = arc_tangent(-place.east, -place.north) * (180.0 / pi);
    return angle < 0.0 ? angle + 360.0 : angle;
}

double value_at(WorldMap map, const Ground& ground, const Coordinate& x, const Coordinate& y,
                double soil_water) {
    switch (map) {
        case WorldMap::height:
            return place_at(ground, x, y).height;
        case WorldMap::slope:
            return slope_at(ground, x, y);
        case WorldMap::aspect:
            return aspect_at(ground, x, y);
        case WorldMap::twi:
            return wetness_index_at(ground, x, y);
        case WorldMap::wetness:
            return wetness_on(ground, wetness_index_at(ground, x, y), soil_water);
        case WorldMap::streams:
            return stream_at(ground, x, y);
    }
    return 0.0;
}

}  // namespace

const char* doc_of(WorldMap map) {
    switch (map) {
        case WorldMap::height:
            return "Height of the ground above the mean of endless worlds of these parameters.";
        case WorldMap::slope:
            return "Angle of the ground from level.";
        case WorldMap::aspect:
            return "Direction downhill, clockwise from north.";
        case WorldMap::twi:
            return "Topographic wetness index: how much ground drains through a place, and how "
                   "slowly.";
        case WorldMap::wetness:
            return "How wet the ground is on a day: 1 where water stands at its surface.";
        case WorldMap::streams:
            return "1 where more than two hectares drain through a node of the ground, 0 "
                   "elsewhere; between "
                   "nodes it is linear, so a stream is where it is above 0.5.";
    }
    return "";
}

MapRange range_of(WorldMap map, const Ground& ground) {
    switch (map) {
        case WorldMap::height:
            return {ground.lowest, ground.highest, "m"};
        case WorldMap::slope:
            return {0.0, 90.0, "deg"};
        case WorldMap::aspect:
            return {0.0, 360.0, "deg"};
        case WorldMap::twi:
            return {-wetness_offset, 65535.0 / wetness_units - wetness_offset, ""};
        case WorldMap::wetness:
        case WorldMap::streams:
            return {0.0, 1.0, ""};
    }
    return {};
}

MapFrame frame_of(const WorldBox& box, int side) {
    const double width = box.east - box.west, height = box.north - box.south;
    const auto nodes = [&](double length) {
        const double share = length / std::max(width, height);
        return std::max(2, static_cast<int>(std::floor((side - 1) * share + 0.5)) + 1);
    };
    return {box, nodes(width), nodes(height)};
}

std::vector<std::uint16_t> map_of(WorldMap map, const Ground& ground, const MapFrame& frame,
                                  double soil_water, const Parallel& parallel) {
    const MapRange range = range_of(map, ground);
    const double scale = 65535.0 / (range.to - range.from);
    std::vector<std::uint16_t> out(static_cast<std::size_t>(frame.width) *
                                   static_cast<std::size_t>(frame.height));
    each_place(ground.grid, frame, parallel,
               [&](std::size_t i, const Coordinate& x, const Coordinate& y) {
                   const double value = value_at(map, ground, x, y, soil_water);
                   out[i] = static_cast<std::uint16_t>(
                       std::clamp(std::floor((value - range.from) * scale + 0.5), 0.0, 65535.0));
               });
    return out;
}

std::vector<std::uint8_t> terrarium_of(const Ground& ground, const MapFrame& frame,
                                       const Parallel& parallel) {
    std::vector<std::uint8_t> out(3 * static_cast<std::size_t>(frame.width) *
                                  static_cast<std::size_t>(frame.height));
    each_place(ground.grid, frame, parallel,
               [&](std::size_t i, const Coordinate& x, const Coordinate& y) {
                   const double height = place_at(ground, x, y).height;
                   const auto units =
                       static_cast<std::uint32_t>(std::floor((height + 32768.0) * 256.0 + 0.5));
                   out[3 * i] = static_cast<std::uint8_t>(units >> 16U);
                   out[3 * i + 1] = static_cast<std::uint8_t>(units >> 8U & 255U);
                   out[3 * i + 2] = static_cast<std::uint8_t>(units & 255U);
               });
    return out;
}

}  // namespace sporeprint
