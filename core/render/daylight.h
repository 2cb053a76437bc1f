// The light outdoors, by which pictures of worlds are lit: the sun, the sky and the haze in the air.
#pragma once

#include <glm/vec3.hpp>

#include "core/render/lighting.h"

namespace sporeprint {

/// The light of a moment outdoors.
struct Daylight {
    glm::dvec3 to_sun{0.4, 0.7,
                      0.5};  ///< of any length but 0; y is up, and the sun may be below the horizon
    double cloud = 0.2;  ///< share of the sky that clouds cover, 0..1: at 1 the sun casts no shadow
    /// Distance at which haze leaves a fiftieth of the contrast (meteorological visibility), metres, greater than 0.
    double visibility = 8000.0;
    bool operator==(const Daylight&) const = default;
};

}  // namespace sporeprint

namespace sporeprint::render {

/// The sky of a moment: what is seen of it, and the lights that it consists of.
///
/// source  colours of beam and sky chosen by eye about a beam of 0.7^(1 / up) [Campbell1998]; an overcast sky is three
///         times as bright at the zenith as at the horizon (CIE standard overcast sky); haze by Koschmieder's law
class Sky {
  public:
    explicit Sky(const Daylight& day);

    /// Returns what is seen in a direction: below the horizon, haze.
    ///
    /// direction  unit vector
    [[nodiscard]] glm::vec3 at(const glm::vec3& direction) const;

    /// Returns what a surface of a roughness shows of sky and ground as a mirror; nothing for a roughness of 1.
    ///
    /// direction  of the mirrored ray, unit
    /// arriving   share of the light of the sky that arrives at the surface, 0..1: crowns that stop the rest are seen
    ///            in the mirror, the more the nearer to the horizon
    [[nodiscard]] glm::vec3 mirrored(const glm::vec3& direction, float roughness,
                                     float arriving = 1.0F) const;

    /// Returns light that has come through the air, whose haze takes of it and adds to it.
    ///
    /// direction  unit vector in which it is seen
    /// distance   metres
    [[nodiscard]] glm::vec3 through_air(const glm::vec3& light, const glm::vec3& direction,
                                        float distance) const;

    /// Returns the lights of the sun, the sky and the ground.
    ///
    /// detail  1 for all of them, 2 for about half as many, and so on
    [[nodiscard]] PictureLights lights(int detail) const;

  private:
    glm::vec3 to_sun_, sun_, zenith_, horizon_, ground_;
    float overcast_ = 0.0F;    ///< share of the overcast sky in what is seen
    float extinction_ = 0.0F;  ///< of haze, per metre
};

}  // namespace sporeprint::render
