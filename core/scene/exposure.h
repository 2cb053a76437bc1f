// How much of the sky, the sun and the rain reaches the surfels of a scene.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/images.h"
#include "core/scene/scene.h"
#include "core/scene/surfels.h"
#include "core/scene/triangle_tree.h"
#include "core/world/horizon.h"
#include "core/world/wind.h"

namespace sporeprint {

/// Rays by which a surfel looks for the sky.
inline constexpr std::size_t sky_rays = 64;

/// Returns a direction of a scene, whose x is east, y up and z south.
[[nodiscard]] inline glm::dvec3 scene_direction(double east, double up, double north) {
    return {east, up, -north};
}

/// Returns for each surfel the share of the light of an overcast sky that reaches it, compared with open level ground:
/// 1 in the open, 0.5 on an open wall, 0 below a roof that covers all. Each looks along 64 directions, evenly spread over
/// the hemisphere by the cosine to its normal.
///
/// seed      turns the directions of each surfel
/// parallel  looks at stripes of surfels
/// cost      64 rays for each surfel
[[nodiscard]] std::vector<float> sky_of(const Surfels& surfels, const TriangleTree& tree,
                                        std::uint32_t seed, const Parallel& parallel = in_turn);

/// Returns for each surfel how much of the sun of a day reaches it, compared with open level ground.
///
/// cost  12 rays for each surfel
[[nodiscard]] std::vector<float> sun_on(const Surfels& surfels, const TriangleTree& tree,
                                        const SunDay& sun, const Parallel& parallel = in_turn);

/// Returns for each surfel 1 if it is in the ground or within a solid: it sees little of the sky, and upwards more
/// surfaces are passed from behind than from the front, in six directions.
///
/// scene  of the surfels
/// sky    sky_of() them
/// cost   some rays for each surfel without sky
[[nodiscard]] std::vector<std::uint8_t> buried_of(const Surfels& surfels, const TriangleTree& tree,
                                                  const Scene& scene, const std::vector<float>& sky,
                                                  const Parallel& parallel = in_turn);

/// Speed at which rain falls, m/s: that of drops of 2 mm [GunnKinzer1949].
inline constexpr double rain_fall = 6.5;

/// Returns for each surfel how much rain falls on each square metre of it, compared with open level ground. Rain comes
/// with the winds of the rose, so that it wets walls that face the wind and leaves those behind them dry.
///
/// rose  speeds are those 10 m above the ground; the wind that drives rain is that at 2 m
/// seed  turns the wind of each surfel within its sector
/// cost  16 rays for each surfel
/// source  wind-driven rain on a wall is rain times wind over the speed of fall: [Blocken2004]
[[nodiscard]] std::vector<float> rain_on(const Surfels& surfels, const TriangleTree& tree,
                                         const WindRose& rose, std::uint32_t seed,
                                         const Parallel& parallel = in_turn);

/// Returns the share of the light of the open sky that a place has (Site::light), of those of sky and sun.
[[nodiscard]] constexpr double light_of(double sky, double sun) {
    const double light = diffuse_share * sky + (1.0 - diffuse_share) * sun;
    return light < 1.0 ? light : 1.0;
}

}  // namespace sporeprint
