// The soil and litter at the feet of a colony: a clod round each foot, or one round a whole tuft.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/colony/separation.h"
#include "core/geometry/ground.h"

namespace sporeprint {

/// Where an individual leaves the ground, metres.
struct ColonyFoot {
    glm::dvec3 at{0.0};                ///< middle, at the ground
    glm::dvec3 along{0.0, 1.0, 0.0};   ///< unit direction of growth there
    double radius = 0.0, depth = 0.0;  ///< across `along`; how far below the ground it ends
    std::uint32_t number = 0;          ///< of its place
};

/// Returns true if a colony stands in soil: not on wood, nor on roots that are visible.
[[nodiscard]] bool stands_in_soil(const ColonyTraits& traits);

/// Returns the foot of an individual that stands as a whole, in the frame of its mesh.
[[nodiscard]] ColonyFoot foot_of(const Mesh& mesh);

/// Returns the feet of all members at size 1.
///
/// models  foot_of() each model; empty if the members stand on stems of the colony
[[nodiscard]] std::vector<ColonyFoot> feet_of(const ColonySite& site,
                                              const std::vector<ColonyMember>& members,
                                              const std::vector<ColonyFoot>& models);

/// Returns how finely the ground of a colony is built at a level of detail: as finely as the
/// triangles of the level allow for so many feet, which may be not at all.
///
/// layers  of the typical individual
/// count   requested members
[[nodiscard]] ColonyGroundDetail colony_ground_detail(const std::vector<GroundLayer>& layers,
                                                      const ColonyTraits& traits, int count,
                                                      int lod);

/// Returns the counts of colony_ground(), exact if all members have found room.
[[nodiscard]] MeshCount colony_ground_count(const std::vector<GroundLayer>& layers,
                                            const ColonyTraits& traits, int count, int lod);

/// Returns the ground of a colony at size 1: for each foot one clod, of its own shape, with litter on
/// it, as large as the foot; in a tuft one clod whose outline follows the feet that stand outermost,
/// and soil between them.
///
/// layers   of the typical individual
/// feet     feet_of() all members
/// count    requested members
/// returns  closed pieces; empty where there are none
[[nodiscard]] Mesh colony_ground(const std::vector<GroundLayer>& layers,
                                 const std::vector<ColonyFoot>& feet, const ColonyTraits& traits,
                                 int count, int lod, bool textured);

}  // namespace sporeprint
