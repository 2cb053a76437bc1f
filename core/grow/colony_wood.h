// The piece of wood that a tier stands on.
#pragma once

#include <vector>

#include "core/colony/cap.h"
#include "core/colony/colony_spec.h"
#include "core/colony/separation.h"
#include "core/grow/wood.h"

namespace sporeprint {

/// Returns about how many vertices and triangles the wood of a colony has.
[[nodiscard]] MeshCount expected_wood(const ColonySpec& spec, const ColonyTraits& traits,
                                      const StemFit& fit, int lod);

/// Returns the piece of wood behind the members of a tier, metres at size 1.
[[nodiscard]] WoodPiece wood_below(const std::vector<ColonyMember>& members,
                                   const ColonyParams& params, const ColonyTraits& traits,
                                   const StemFit& fit);

}  // namespace sporeprint
