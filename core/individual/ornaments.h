// The ornaments of one individual from those of its species: layers of torn pieces, the ring and the sac.
#pragma once

#include <vector>

#include "core/individual/individual.h"
#include "core/individual/sources.h"

namespace sporeprint {

/// One layer for each kind of piece of each species; species whose pieces have equal places share theirs.
[[nodiscard]] std::vector<PatchLayer> layers_of(const std::vector<Source>& sources,
                                                const MorphSet& set);

/// One ring or sac from those of all species: its extent is the sum of theirs, as shares of each one's size; the rest goes by weight,
/// and what is hardly there has hardly a say. In metres for an individual of this size.
[[nodiscard]] RingStyle ring_of(const std::vector<Source>& sources, double size);
[[nodiscard]] SacStyle sac_of(const std::vector<Source>& sources, double size);

}  // namespace sporeprint
