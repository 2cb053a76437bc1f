// Which species cannot live in a world, whatever grows where in it.
#pragma once

#include <string>

#include "core/model/ecology.h"
#include "core/world/world_params.h"

namespace sporeprint {

/// Returns why a species can live nowhere in a world, as a sentence; empty if its parameters allow it.
///
/// params  of the world; its lists of kinds and species are valid
[[nodiscard]] std::string reason_of_absence(const Ecology& ecology, const WorldParams& params);

}  // namespace sporeprint
