// Snow on the ground of a world, from its weather.
#pragma once

#include <cstdint>
#include <span>

#include "core/images.h"
#include "core/world/ground.h"
#include "core/world/plot_ground.h"
#include "core/world/world_params.h"

namespace sporeprint {

/// Returns the snow that lies on a day, as water, mm. What falls near freezing is partly snow; snow melts by so many
/// millimetres for each degree and day. The water of soils does not depend on it.
///
/// seed, year, day  as for weather_of(); the snow of an autumn lies in the year after it too
/// source           melt by degree days [Hock2003]
[[nodiscard]] double snow_on(const ClimateParams& climate, std::uint32_t seed, int year, int day);

/// Returns the depth of settled snow, metres.
///
/// water   that lies as snow, mm
/// source  a density of 200 kg/m3, between new and old snow
[[nodiscard]] constexpr double snow_depth(double water) { return water / 200.0; }

/// Returns the share of the ground that snow covers, 0..1.
///
/// water  that lies as snow, mm
[[nodiscard]] double snow_cover(double water);

/// How far from the middle of a trunk there is less snow at most, metres.
inline constexpr double snow_well = 1.5;

/// Covers a floor with snow: hollows last, so that leaves and tufts look out of a little of it. Texels at one place of
/// the world are covered alike in all images whose texels are of one size.
///
/// box    of the images, whose first row is the northern one
/// cover  share of the ground, 0..1
/// feet   of living trees within snow_well of the box: dark trunks melt it, and crowns hold it back
void add_snow(RawImages& images, const WorldBox& box, double cover, std::uint32_t seed,
              std::span<const TreeFoot> feet, const Parallel& parallel = in_turn);

}  // namespace sporeprint
