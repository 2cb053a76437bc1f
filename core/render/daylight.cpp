#include "core/render/daylight.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/problems.h"

namespace sporeprint::render {

namespace {

/// Optical depths of the air for red, green and blue: a low sun is weak and reddish.
constexpr glm::dvec3 optical_depth(0.13, 0.20, 0.34);

/// The sun above the air, as light reflected by a white matt surface that faces it.
constexpr double sun_above_air = 1.5;

/// The blue sky at noon, and an overcast one, in the same unit.
constexpr glm::vec3 clear_zenith(0.22F, 0.34F, 0.56F), clear_horizon(0.58F, 0.66F, 0.76F),
    overcast_zenith(0.80F, 0.82F, 0.85F);

/// What the ground returns of the light that reaches it.
constexpr glm::vec3 ground_colour(0.16F, 0.14F, 0.10F);

/// The light of a sky whose sun is at the horizon, as a share of that of noon.
constexpr double at_sunrise = 0.12;

/// Half the angle over which the lights of the sun are spread, radians: wider than the sun, as few lights stand for it.
constexpr double sun_radius = 0.02;

/// Lights of the sun, of the sky and of the ground.
constexpr int sun_parts = 8, sky_parts = 28, ground_parts = 6;

/// The roughness from which on a surface shows less of the sky as a mirror, and none of it at 1.
constexpr float rough = 0.6F;

/// The path of a mirrored ray through crowns, in that of the mean light of the sky: at the zenith, and at most.
constexpr double overhead_path = 0.6, longest_path = 6.0;

/// The light of crowns, as a share of what open ground returns.
constexpr float crowns_in_mirror = 0.4F;

/// Koschmieder's law: the optical depth of the air as far as one can see.
constexpr double depth_of_visibility = 3.912;

glm::vec3 mix(const glm::vec3& a, const glm::vec3& b, float share) { return a + (b - a) * share; }

}  // namespace

Sky::Sky(const Daylight& day)
    : to_sun_(unit_or(day.to_sun, {0.0, 1.0, 0.0})),
      overcast_(static_cast<float>(smooth_step(0.25, 1.0, day.cloud))),
      extinction_(static_cast<float>(depth_of_visibility / day.visibility)) {
    if (!(day.cloud >= 0.0 && day.cloud <= 1.0)) throw InvalidInput("/cloud", "is 0..1");
    if (!(day.visibility > 0.0)) throw InvalidInput("/visibility", "is greater than 0 m");
    const auto up = static_cast<double>(to_sun_.y);
    const double risen = smooth_step(-0.08, 0.05, up);
    const double path = 1.0 / std::max(up, 0.04);
    glm::dvec3 beam;
    for (glm::dvec3::length_type i = 0; i < 3; ++i)
        beam[i] = sun_above_air * risen * exponential(-optical_depth[i] * path);
    sun_ = glm::vec3(beam * (1.0 - smooth_step(0.35, 1.0, day.cloud)));
    const auto bright =
        static_cast<float>(at_sunrise + (1.0 - at_sunrise) * smooth_step(-0.1, 0.7, up));
    const glm::vec3 grey = overcast_zenith * bright;
    zenith_ = mix(clear_zenith * bright, grey, overcast_);
    horizon_ = mix(clear_horizon * bright, grey * (1.0F / 3.0F), overcast_);
    // Between clear and overcast, horizons are hazy and bright.
    const glm::vec3 level = (zenith_ + horizon_) * 0.5F;
    ground_ = ground_colour * (level + sun_ * std::max(to_sun_.y, 0.0F));
}

glm::vec3 Sky::at(const glm::vec3& direction) const {
    const float up = std::max(direction.y, 0.0F);
    // A clear sky pales near the horizon alone, an overcast one brightens evenly.
    const float rise = std::sqrt(up) * (1.0F - overcast_) + up * overcast_;
    const glm::vec3 sky = mix(horizon_, zenith_, rise);
    const float towards = std::max(glm::dot(direction, to_sun_), 0.0F);
    const float square = towards * towards, eighth = square * square * square * square;
    return sky + sun_ * (0.10F * square + 0.25F * eighth * eighth);
}

glm::vec3 Sky::mirrored(const glm::vec3& direction, float roughness, float arriving) const {
    // The pieces of rough ground, such as litter, hide the sky from each other.
    const float open = std::clamp((1.0F - roughness) / (1.0F - rough), 0.0F, 1.0F);
    if (!(arriving > 0.0F && open > 0.0F)) return glm::vec3(0.0F);
    const auto width = static_cast<double>(std::max(roughness, 0.15F));
    const auto share =
        static_cast<float>(smooth_step(-width, width, static_cast<double>(direction.y)));
    const glm::vec3 above = mix(horizon_, zenith_, std::max(direction.y, 0.0F));
    // Beer-Lambert's law: crowns that let a share through overhead let less through aslant.
    const double path =
        std::min(overhead_path / std::max(static_cast<double>(direction.y), 1e-3), longest_path);
    const auto through = static_cast<float>(power(static_cast<double>(arriving), path));
    const glm::vec3 crowns = ground_ * (crowns_in_mirror * arriving);
    return mix(ground_ * (arriving * arriving), mix(crowns, above, through), share) * open;
}

glm::vec3 Sky::through_air(const glm::vec3& light, const glm::vec3& direction,
                           float distance) const {
    const auto left = static_cast<float>(exponential(-static_cast<double>(extinction_ * distance)));
    const float level = std::sqrt(std::max(1.0F - direction.y * direction.y, 1e-6F));
    const glm::vec3 along(direction.x / level, 0.0F, direction.z / level);
    return mix(at(along), light, left);
}

PictureLights Sky::lights(int detail) const {
    const auto share = [&](int parts) { return std::max(parts / detail, 2); };
    PictureLights lights;
    if (sun_.x > 1e-3F)
        add_lamp(lights.lamps, glm::dvec3(to_sun_), sun_radius, share(sun_parts), sun_);
    add_half(lights.surroundings, share(sky_parts), 1.0, [this](const glm::vec3& direction) {
        const float up = direction.y;
        return mix(horizon_, zenith_, std::sqrt(up) * (1.0F - overcast_) + up * overcast_);
    });
    add_half(lights.surroundings, share(ground_parts), -1.0,
             [this](const glm::vec3&) { return ground_; });
    return lights;
}

}  // namespace sporeprint::render
