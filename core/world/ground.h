// The ground of a world: what is computed once for it, on one grid, and how it is at any place.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/world/height_field.h"
#include "core/world/terrain_map.h"
#include "core/world/world_params.h"

namespace sporeprint {

/// A rectangle in the plane of a world: x to the east, y to the north, metres from its centre.
struct WorldBox {
    double west = 0.0, south = 0.0, east = 0.0, north = 0.0;
    bool operator==(const WorldBox&) const = default;
};

/// Returns the rectangle whose sides lie so many metres farther out.
[[nodiscard]] constexpr WorldBox grown(const WorldBox& box, double by) {
    return {box.west - by, box.south - by, box.east + by, box.north + by};
}

/// Returns the rectangle of a whole world.
[[nodiscard]] WorldBox extent_of(const WorldParams& params);

/// The ground of a world, on a grid that reaches beyond it. About 2 MB.
struct Ground {
    Grid grid;
    std::vector<std::int32_t> heights;   ///< 1/height_units m, after erosion
    std::vector<std::uint16_t> wetness;  ///< topographic wetness indices, see wetness_units
    std::vector<std::uint8_t> streams;   ///< 1 where a stream runs, otherwise 0
    double mean_wetness = 0.0;           ///< index in the mean of the nodes within the world
    double lowest = 0.0, highest = 0.0;  ///< bounds of the heights of all places in it, metres

    /// Returns the memory that it takes.
    [[nodiscard]] std::size_t bytes() const;
};

/// Computes the ground of a world.
///
/// terrain  that of params.terrain.id; null if it names none
/// cost     about 0.3 s; 0.1 s of a terrain, which water does not erode
/// throws   InvalidInput if a parameter is out of range, or (path "terrain.id") if its terrain is missing
[[nodiscard]] Ground ground_of(const WorldParams& params, const TerrainMap* terrain = nullptr);

/// Returns the parameters that the ground depends on as a key for caches.
[[nodiscard]] std::string ground_key(const WorldParams& params);

/// One coordinate of a place, as the grid of a ground has it. Places in a column or a row share one, which maps compute
/// once.
struct Coordinate {
    int node = 0;       ///< the nearest node to the west or south
    double part = 0.0;  ///< how far it is from there to the next one, 0..1
    std::array<double, 4> value{},
        rise{};  ///< weights of a Catmull-Rom spline and its derivative, from node - 1 on
};

/// Returns a coordinate.
///
/// metres  from the centre of the world, within the extent
[[nodiscard]] Coordinate coordinate_at(const Grid& grid, double metres);

/// The ground at one place.
struct Place {
    double height = 0.0;  ///< metres
    double east = 0.0;    ///< rise per metre to the east
    double north = 0.0;   ///< rise per metre to the north
};

/// Returns the ground at a place of the world: heights between nodes by Catmull-Rom splines, so that slopes are
/// continuous. Neighbouring tiles and maps agree bit for bit, since a place has one height whatever it is part of.
///
/// cost  0.05 us
[[nodiscard]] Place place_at(const Ground& ground, const Coordinate& x, const Coordinate& y);

/// Returns the topographic wetness index at a place, linear between nodes.
[[nodiscard]] double wetness_index_at(const Ground& ground, const Coordinate& x,
                                      const Coordinate& y);

/// Returns how much of a stream is at a place, 0..1, linear between nodes.
[[nodiscard]] double stream_at(const Ground& ground, const Coordinate& x, const Coordinate& y);

/// Returns how wet the ground is: 1 where water stands at the surface, 0 where it is 100 mm and more short of that.
///
/// index       topographic wetness index of the place
/// soil_water  mean of the world on that day, mm (WeatherDay)
/// source      [BevenKirkby1979], with m = 25 mm; differs: below 20 mm of soil water everything dries
[[nodiscard]] double wetness_on(const Ground& ground, double index, double soil_water);

}  // namespace sporeprint
