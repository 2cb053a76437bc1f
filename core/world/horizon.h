// The light of a place that hills leave it: how high the horizon is all round, how much of the sky is open above it, and
// how much of the sun of a day reaches a slope.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/images.h"
#include "core/world/ground.h"
#include "core/world/height_field.h"

namespace sporeprint {

inline constexpr std::size_t horizon_azimuths = 16;

/// The horizon of every second node of a ground, by directions clockwise from north. About 1.1 MB.
struct Horizon {
    Grid grid;
    std::vector<std::array<std::uint8_t, horizon_azimuths>> sines;  ///< of its height, 1/255
    std::vector<std::uint8_t> sky;  ///< share of the sky that is open, 1/255

    /// Returns the memory that it takes.
    [[nodiscard]] std::size_t bytes() const;
};

/// Computes the horizon of the nodes of a ground, each from 18 places in 16 directions whose distances grow from 1 to 86
/// cells of the horizon. Beyond the border the ground is as high as at it.
///
/// grid      side N, odd and at least 5
/// heights   N*N heights in 1/height_units m
/// parallel  runs stripes of rows
/// returns   sines of the angles of the horizon, and 1 minus their mean: the share of the sky by solid angle
/// throws   InvalidInput if there are not N*N heights or N is another number
/// source   [Dozier1990] for the horizon by directions
/// cost     30 ms for 513^2 heights
[[nodiscard]] Horizon horizon_of(const Grid& grid, std::span<const std::int32_t> heights,
                                 const Parallel& parallel = in_turn);

/// The horizon at a place.
struct LocalHorizon {
    std::array<double, horizon_azimuths> sines{};  ///< of its height, clockwise from north
    double sky = 1.0;                              ///< share of the sky that is open, 0..1
};

/// Returns the horizon at a place, linear between nodes; places beyond the grid have that of its border.
///
/// x, y  metres from the centre of the world
[[nodiscard]] LocalHorizon horizon_at(const Horizon& horizon, double x, double y);

/// Returns the share of the sky that is open above a place, with the bits of horizon_at().
[[nodiscard]] double sky_at(const Horizon& horizon, double x, double y);

/// The sun at one moment: a unit vector towards it, and the strength of its light.
struct SunPosition {
    double east = 0.0, north = 0.0, up = 0.0;
    double azimuth = 0.0;   ///< in sectors of the horizon, clockwise from north, 0 to 16
    double strength = 0.0;  ///< of its beam, as a share of that above the air
};

/// The sun of a day at twelve moments, each in the middle of a twelfth of the time from sunrise to sunset.
struct SunDay {
    std::array<SunPosition, 12> positions;
    double level = 0.0;  ///< what reaches open level ground in the sum of them
};

/// Returns the sun of a day.
///
/// latitude  radians, less than 67 degrees from the equator
/// day       1 to 365
/// source    [Allen1998] for declination and sunset, [Campbell1998] ch. 11 for the beam, 0.7^(1 / up) on a clear day
[[nodiscard]] SunDay sun_of(double latitude, int day);

/// Returns how much of the sun of a day reaches a place on a slope, as a share of what reaches open level ground; more
/// than 1 on slopes that face the sun. The sun sinks below a horizon within 2 degrees, since its
/// twelve moments stand for all others.
///
/// cost  0.1 us
[[nodiscard]] double sun_at(const LocalHorizon& horizon, const Place& place, const SunDay& sun);

/// Share of the light of a day that comes from the sky and not straight from the sun.
inline constexpr double diffuse_share = 0.5;

/// Returns the light of a place without trees as a share of that of open level ground, 0..1: half from the open part of
/// the sky, half from the sun. Slopes that face the sun count as open ground.
[[nodiscard]] double light_at(const LocalHorizon& horizon, const Place& place, const SunDay& sun);

}  // namespace sporeprint
