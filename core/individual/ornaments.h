// The ornaments of one individual from those of its species: layers of patches, the ring, the
// sac, peridioles and receptacles.
#pragma once

#include <vector>

#include "core/individual/individual.h"
#include "core/individual/sources.h"

namespace sporeprint {

/// Returns one layer for each kind of patch of each species; species whose patches have equal
/// places share theirs.
[[nodiscard]] std::vector<PatchLayer> layers_of(const std::vector<Source>& sources,
                                                const MorphSet& set);

/// Returns one ring or sac from those of all species, in metres for an individual of this size. Its
/// extent is the weighted sum of theirs relative to the size of each species; the other values are
/// means by weight, in which almost absent ones have almost no influence.
[[nodiscard]] RingStyle ring_of(const std::vector<Source>& sources, double size);
[[nodiscard]] SacStyle sac_of(const std::vector<Source>& sources, double size);

/// Returns the spines of each species that has them, in metres.
///
/// size  that of a swept individual; of a branched one the factor on its species' size
[[nodiscard]] std::vector<SpineLayer> spines_of(const std::vector<Source>& sources, double size);

/// Returns the peridioles and the receptacle of each species that has them, lengths in metres for an
/// individual of this size.
[[nodiscard]] std::vector<PeridioleLayer> peridioles_of(const std::vector<Source>& sources,
                                                        double size);
[[nodiscard]] std::vector<ReceptacleLayer> receptacles_of(const std::vector<Source>& sources,
                                                          double size);

/// Returns the ground of each species that brings some along, in metres.
///
/// size  as for spines_of()
[[nodiscard]] std::vector<GroundLayer> grounds_of(const std::vector<Source>& sources, double size);

}  // namespace sporeprint
