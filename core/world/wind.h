// The wind of a world: from where it blows and how fast, how hills change it, and how slow it is among plants.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/world/height_field.h"
#include "core/world/world_params.h"

namespace sporeprint {

inline constexpr std::size_t wind_sectors = 8;

/// The wind from one of eight directions.
struct WindSector {
    double share = 0.0;              ///< of the time
    double speed = 0.0;              ///< 10 m above open ground, m/s
    double east = 0.0, north = 0.0;  ///< unit vector along which the air moves
};

/// The wind from north, north-east, east and so on. The shares add up to 1.
using WindRose = std::array<WindSector, wind_sectors>;

/// Returns the winds of a climate: shares are integrals of a von Mises distribution of the direction over each
/// sector, and the speed is the same in all.
[[nodiscard]] WindRose wind_rose(const ClimateParams& climate);

/// The shape of the ground as far as it changes the wind: slopes and curvatures over tens of metres, each scaled so that
/// the greatest one of the world is 0.5. About 0.2 MB.
struct WindRelief {
    struct Shape {
        std::int8_t east = 0, north = 0;  ///< scaled rise to the east and to the north, 1/254
        std::int8_t curvature = 0;        ///< scaled, positive on ridges, 1/254
        bool operator==(const Shape&) const = default;
    };
    Grid grid;  ///< every second node of the ground
    std::vector<Shape> shapes;

    /// Returns the memory that it takes.
    [[nodiscard]] std::size_t bytes() const {
        return sizeof(*this) + shapes.size() * sizeof(Shape);
    }
};

/// Returns the shape of the ground as far as it changes the wind.
///
/// grid     side N, odd and at least 5
/// heights  N*N heights in 1/height_units m
/// throws   InvalidInput if there are not N*N heights or N is another number
/// source   [ListonElder2006] eq. 14 to 16; differs: slopes are taken over the length of the curvatures, and where the
///          greatest slope is below 0.15 or the greatest curvature below 0.02, these are scaled instead, so that gentle
///          ground changes the wind little
/// cost     3 ms for 513^2 heights
[[nodiscard]] WindRelief wind_relief(const Grid& grid, std::span<const std::int32_t> heights);

/// The wind at a place, compared with that above open level ground.
struct LocalWind {
    double factor = 1.0;             ///< of the speed, 0.5 to 1.5
    double east = 0.0, north = 0.0;  ///< unit vector along which the air moves
};

/// Returns the wind at a place. It is faster on ridges and on slopes that face it, slower in hollows and in the lee of
/// hills, and slopes that face it turn it towards their contours.
///
/// x, y    metres from the centre of the world; places beyond the grid have the wind of its border
/// source  [ListonElder2006] eq. 17 to 19 with both weights 0.5; as in other implementations of it, only slopes that
///         face the wind turn it
/// cost    0.05 us
[[nodiscard]] LocalWind wind_at(const WindRelief& relief, double x, double y,
                                const WindSector& sector);

/// What slows the wind near the ground: grass everywhere, and crowns above a share of the ground.
struct WindCover {
    double grass = 0.15;     ///< height of grass and herbs, metres, 0.01 to 2
    double closure = 0.0;    ///< share of the ground below crowns, 0..1
    double crown_top = 0.0;  ///< height of the crowns, metres; none below 1 m
};

/// Returns the speed of the wind above grass, and in it.
///
/// speed   10 m above the top of the grass, m/s
/// height  above the ground, metres, 0 to 10
/// source  [Campbell1998] ch. 5: a logarithmic profile with displacement 0.65 and roughness 0.1 of the height of the
///         plants; below their tops u(top) e^(a (z / top - 1)) with a = 2
[[nodiscard]] double wind_above_grass(double speed, double height, double grass);

/// Returns the speed of the wind below crowns.
///
/// speed      10 m above their tops, m/s
/// height     above the ground, metres, 0 to the top
/// crown_top  at least 1 m
/// source     as wind_above_grass(); in the lowest twentieth of the height of the crowns the profile is logarithmic
///            again, with a roughness of 4 mm: that of a floor of leaves
[[nodiscard]] double wind_below_crowns(double speed, double height, double crown_top);

/// Returns the speed of the wind at a height above the ground, metres: the mean of open and covered ground.
[[nodiscard]] double wind_near_ground(double speed, double height, const WindCover& cover);

}  // namespace sporeprint
