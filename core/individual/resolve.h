// Resolution of a request into one individual: growth stages, mix, variation and overrides.
#pragma once

#include "core/atlas/atlas.h"
#include "core/get_or_compute.h"
#include "core/individual/individual.h"

namespace sporeprint {

/// Decides everything about one individual. Growth is a morph: age moves weights between a species'
/// own stages, a mix between species, and one morph of all control shapes serves both. Sizes mix by
/// ratio, bends of the axis as rotations. A custom Model has no species: age and variation do not
/// change it.
///
/// morphs   cache of the correspondence of a set of species, which is the expensive part
/// returns  an individual that does not depend on the order of the species
/// throws   InvalidInput for a range or an unknown species, Impossible for what no species of the
///          mix can have and for an outline that crosses itself; paths like "/hymenium/blades",
///          "mix"
/// source   [Desbenoit2004] sec. 4
[[nodiscard]] Individual resolve(const MushroomSpec& spec, const Atlas& atlas,
                                 const GetOrCompute<MorphSet>& morphs = uncached<MorphSet>);

/// Returns the branch graphs of the species of a request, by id, as their templates are, without
/// individual variation. All have the same nodes, merged from all species; those that a species
/// lacks have presence 0.
///
/// pre     all species branch
/// throws  InvalidInput for a range or an unknown species
[[nodiscard]] std::vector<BranchGraph> species_branch_graphs(const MushroomSpec& spec,
                                                             const Atlas& atlas);

/// The control shapes of the species of a request, as their templates are, without individual
/// variation.
struct SpeciesShapes {
    std::shared_ptr<const MorphSet> set;
    /// One entry for each species by id: the weights of all shapes of the set for this species
    /// alone, at the requested age.
    std::vector<std::vector<double>> weights;
    std::vector<double> sizes;  ///< metres, by id: the divisors of the shapes of the set
};

/// Returns the control shapes of a request.
///
/// pre     no species branches; the request has no arcs
/// throws  InvalidInput for a range or an unknown species
[[nodiscard]] SpeciesShapes species_shapes(
    const MushroomSpec& spec, const Atlas& atlas,
    const GetOrCompute<MorphSet>& morphs = uncached<MorphSet>);

}  // namespace sporeprint
