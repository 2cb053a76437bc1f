// Litter that has fallen on the cap of a mushroom and lies there, as solids.
#pragma once

#include <vector>

#include "core/geometry/ornament_context.h"

namespace sporeprint {

/// Returns the exact counts of what add_fallen_litter() appends.
[[nodiscard]] MeshCount fallen_litter_count(const std::vector<GroundLayer>& layers,
                                            const Detail& detail);

/// Appends the pieces that lie on the cap, each a closed solid whose middle follows the cap from one
/// of its ends to the other. They are points on a cap that is still closed, and those of a species
/// of weight 0 always.
void add_fallen_litter(Mesh& mesh, const Individual& individual, const OrnamentContext& context);

}  // namespace sporeprint
