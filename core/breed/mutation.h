// Mutation of the numbers and colours of a species.
#pragma once

#include "core/breed/breeding.h"
#include "core/model/species.h"

namespace sporeprint {

/// Returns the factor by which the size of a species mutates.
[[nodiscard]] double mutated_size(const Genes& genes);

/// Mutates all numbers and colours but those of outlines and axes, alike in all stages, each by a
/// draw of its own: numbers by a quarter of their range, lengths, counts and other sizes by their
/// ratio, colours by how different they look; in each case times genes.mutation() and a normal
/// draw. What leaves its range is reflected into it. An amount of 0 stays 0, so that a species does
/// not grow what it lacks, and amounts of several stages keep their ratios. What would break a rule
/// of several fields stays as it is.
void mutate(Species& species, const Genes& genes);

}  // namespace sporeprint
