// The places of the individuals of a colony and the curves of their stems, by habit, before any of
// them is moved to avoid intersections.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/colony/cap.h"
#include "core/colony/colony_spec.h"
#include "core/skeleton/skeleton.h"

namespace sporeprint {

/// The place of one individual. Its stem is the parabola foot + t rise + t^2 swing, t from 0 to 1;
/// both vectors are zero if the colony has no stems of its own.
struct ColonyPlace {
    glm::dvec3 foot{0.0};
    glm::dvec3 rise{0.0}, swing{0.0};
    glm::dvec3 up{0.0, 1.0, 0.0};  ///< unit: direction of growth; vertical for lateral ones
    glm::dvec3 outwards{0.0};      ///< horizontal direction of lean: unit, or zero in the middle
    double radius = 0.0;           ///< of its stem, metres
    double share = 0.0;            ///< 0: oldest, 1: youngest
    /// The key of its own random stream; in habit rooted the node of the ground that carries it.
    std::uint32_t number = 0;

    [[nodiscard]] glm::dvec3 at(double t) const { return foot + t * rise + t * t * swing; }
    /// Returns the tangent of the stem at t, not normalised.
    [[nodiscard]] glm::dvec3 along(double t) const { return rise + 2.0 * t * swing; }
};

/// A colony before its individuals are moved apart. Metres at size 1, +y up; the origin is the base
/// of the roots, the middle of a tuft, troop or ring, or the surface of the trunk.
struct ColonySite {
    Skeleton ground;                  ///< roots; no stems
    std::vector<ColonyPlace> places;  ///< in order of placement
};

/// Returns every control with its value: the requested one, or a default that suits the species.
///
/// fit  of the mature individual
[[nodiscard]] ColonyRoots colony_growth(const ColonyParams& params, const ColonyTraits& traits,
                                        const StemFit& fit);

/// Returns the radius of the trunk: the requested one, or a default that suits the species.
[[nodiscard]] double trunk_radius(const ColonyParams& params, const StemFit& fit);

/// Returns the places of `count` individuals. In habit rooted their number is random (Bernoulli
/// trials); of more than `count` each remains with the same probability.
///
/// growth  result of colony_growth()
/// fit     of the mature individual; its cap radius is that of the mesh placed there
/// source  [Torres] for habit rooted: places, heights and radii are those of colony_skeleton(). The
///         other habits are ours, from field guides: tufts are spread like a sunflower's seeds,
///         troops keep a distance, stems on a trunk turn upwards
[[nodiscard]] ColonySite colony_site(const ColonyParams& params, const ColonyTraits& traits,
                                     const ColonyRoots& growth, const StemFit& fit);

}  // namespace sporeprint
