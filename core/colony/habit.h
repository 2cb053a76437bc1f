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
    /// Unit direction of growth of an individual without a stem of the colony. It is vertical for
    /// brackets, whose front points in direction `outwards`.
    glm::dvec3 up{0.0, 1.0, 0.0};
    glm::dvec3 outwards{0.0};  ///< horizontal direction of lean: unit, or zero at the origin
    double radius = 0.0;       ///< of its stem, metres
    double share = 0.0;        ///< relative youth: 0 for the oldest, 1 for the youngest
    /// The key of its own random stream, unique in the colony. In habit rooted it is the index of
    /// the node of ColonySite::ground from which the stem grows.
    std::uint32_t number = 0;

    /// Returns the point of the stem at t, 0 (base) to 1 (top), metres.
    [[nodiscard]] glm::dvec3 at(double t) const { return foot + t * rise + t * t * swing; }
    /// Returns the derivative of at() with respect to t.
    [[nodiscard]] glm::dvec3 along(double t) const { return rise + 2.0 * t * swing; }
};

/// A colony before its individuals are moved apart. Metres at size 1, +y up; the origin is the base
/// of the roots, the middle of a tuft, troop or ring, or the surface of the trunk.
struct ColonySite {
    Skeleton ground;                  ///< roots; no stems
    std::vector<ColonyPlace> places;  ///< in the order in which placed_members() fills them
};

/// Returns the parameters of the root system and stems of a colony: each has the value requested in
/// params.growth, or else a default derived from the dimensions of the species.
///
/// fit  dimensions of the mature individual, metres
[[nodiscard]] ColonyRoots colony_growth(const ColonyParams& params, const ColonyTraits& traits,
                                        const StemFit& fit);

/// Returns the radius of the tree trunk in metres: the requested value, or else a default derived
/// from the radius of the cap.
[[nodiscard]] double trunk_radius(const ColonyParams& params, const StemFit& fit);

/// The rows of a tier: individuals beside each other, and the height from one row to the next in
/// metres at size 1.
struct TierRows {
    int in_row = 1;
    double step = 0.0;  ///< angle between individuals of a row, radians
    double height = 0.0;
};

/// Returns the rows of a tier on a trunk.
///
/// cap_radius    of the oldest individual as it stands in the colony, metres at size 1
/// whole_height  of it with its stem
/// trunk         trunk_radius()
[[nodiscard]] TierRows tier_rows(const ColonyTraits& traits, double cap_radius, double whole_height,
                                 double trunk);

/// Dimensions of typical individuals of a colony, metres.
struct ColonyFits {
    StemFit oldest, youngest;
};

/// Returns the places of `params.count` individuals. In habit rooted their number is random (a
/// Bernoulli trial for each node of the roots) and may be smaller; if there are more, `count` of
/// them are selected, each with the same probability.
///
/// growth  result of colony_growth()
/// fits    of the oldest, whose cap radius determines the spacing, and of the youngest
/// source  [Torres] for habit rooted: places, heights and radii are those of colony_skeleton(). The
///         other habits are ours, from field guides and the statistics of mapped fruit bodies
///         (Thomas processes of clusters, on arcs): tufts are fused at the base and bend towards the
///         light, troops stand in patches, rings in arcs, stems on a trunk turn upwards
[[nodiscard]] ColonySite colony_site(const ColonyParams& params, const ColonyTraits& traits,
                                     const ColonyRoots& growth, const ColonyFits& fits);

}  // namespace sporeprint
