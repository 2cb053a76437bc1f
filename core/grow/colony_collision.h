// The solids of a colony for physics.
#pragma once

#include <vector>

#include "core/colony/habit.h"
#include "core/colony/separation.h"
#include "core/grow/collision.h"

namespace sporeprint {

/// Returns the solids of all members: those of their models at their places, and capsules along
/// their stems.
///
/// members  with the poses of the file
/// shapes   of each model
[[nodiscard]] Collision colony_collision(const ColonySite& site,
                                         const std::vector<ColonyMember>& members,
                                         const std::vector<std::vector<CollisionShape>>& shapes,
                                         const ColonyParams& params, const ColonyTraits& traits);

}  // namespace sporeprint
