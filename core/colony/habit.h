// Where the individuals of a colony stand, and how their stems rise, by habit: before any of them gives way to another.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/colony/cap.h"
#include "core/colony/colony_spec.h"
#include "core/skeleton/skeleton.h"

namespace sporeprint {

/// The place of one individual. Its stem is the parabola foot + t rise + t^2 swing, t from 0 to 1; where a colony has no stems of its
/// own both are zero.
struct ColonyPlace {
    glm::dvec3 foot{0.0};
    glm::dvec3 rise{0.0}, swing{0.0};
    glm::dvec3 up{0.0, 1.0, 0.0};  ///< unit: which way it grows; of those from a wall the vertical
    glm::dvec3 outwards{0.0};      ///< horizontal, unit, or zero in the middle: which way it leans
    double radius = 0.0;           ///< of its stem, metres
    double share = 0.0;            ///< 0: oldest, 1: youngest
    /// What its own draws go by; in habit rooted the node of the ground that bears it.
    std::uint32_t number = 0;

    [[nodiscard]] glm::dvec3 at(double t) const { return foot + t * rise + t * t * swing; }
    /// Not unit.
    [[nodiscard]] glm::dvec3 along(double t) const { return rise + 2.0 * t * swing; }
};

/// A colony before its individuals are moved apart. Metres at size 1, +y up; the origin is where it began: the base of the roots, the
/// middle of a tuft, troop or ring, the surface of the trunk.
struct ColonySite {
    Skeleton ground;                  ///< roots; no stems
    std::vector<ColonyPlace> places;  ///< those that give way come later
};

/// Every control at its value: what is asked for, else what suits the species.
///
/// fit  of the mature individual
[[nodiscard]] ColonyRoots colony_growth(const ColonyParams& params, const ColonyNature& nature,
                                        const StemFit& fit);

/// Radius of the trunk: what is asked for, else what suits the species.
[[nodiscard]] double trunk_radius(const ColonyParams& params, const StemFit& fit);

/// Stands `count` individuals. In habit rooted, as many as Bernoulli's law gives; of more than `count` each stays with one
/// probability.
///
/// growth  colony_growth()
/// fit     of the mature individual; its cap radius is that of what is set there
/// source  [Torres] for habit rooted: places, heights and radii are those of colony_skeleton(). The other habits are ours, from field
///         guides: tufts spread as a sunflower's seeds, troops keep a distance, stems from a trunk turn up
[[nodiscard]] ColonySite colony_site(const ColonyParams& params, const ColonyNature& nature,
                                     const ColonyRoots& growth, const StemFit& fit);

}  // namespace sporeprint
