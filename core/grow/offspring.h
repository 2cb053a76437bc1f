// From two species to a whole species: an offspring.
#pragma once

#include "core/breed/breeding.h"
#include "core/get_or_compute.h"
#include "core/model/species.h"
#include "core/silhouette/morph_set.h"

namespace sporeprint {

/// A bred species, and what the proof of its outlines has left of what was drawn.
struct Offspring {
    Species species;          ///< its id is a hash of all its values
    double outline = 0.0;     ///< share of the second parent in the outline, 0..1
    double mutation = 1.0;    ///< share of the drawn mutation of the outline, 0..1
    Certificate certificate;  ///< of its outlines from each stage to the next; none if it branches
};

/// Returns an offspring of two species, or with a species twice a mutation of it. It is as valid as
/// the species of the atlas, and no outline of its growth touches itself: where that of the drawn
/// genes would, the mutation of the outline is halved up to six times and then left out, and then
/// the outline moves towards that of the nearer parent.
///
/// Without mutation, share 0 gives the first parent and share 1 the second, but for id, names and
/// sources.
///
/// throws  InvalidInput (path "/lock/<i>") for a lock that names no part, Impossible (path "b") for
///         species of two families, and (path "a" or "b") if the outlines of a parent cross itself
/// cost    about 3 ms, and the correspondence of the parents unless it is cached
[[nodiscard]] Offspring offspring(const Species& a, const Species& b, const BreedingParams& params,
                                  const GetOrCompute<MorphSet>& morphs = uncached<MorphSet>);

}  // namespace sporeprint
