// The fungi that live in a world or on a scene, by their ids.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/problems.h"
#include "core/world/mycelia.h"
#include "core/world/world.h"

namespace sporeprint {

/// Returns species by their ids. South of the equator they fruit half a year later.
///
/// kinds     ids of the kinds of trees that there are
/// edits     with own ecologies, or null
/// problems  "fungi.species" for species that are not known, which are left out
[[nodiscard]] std::vector<FungusSpecies> fungi_of(std::span<const std::string> ids,
                                                  const ClimateParams& climate,
                                                  std::span<const std::string> kinds,
                                                  const WorldLookup& lookup,
                                                  const SharedEdits& edits,
                                                  std::vector<Problem>& problems);

}  // namespace sporeprint
