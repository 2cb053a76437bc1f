// From an order to one individual: growth stages, mix, variation and overrides, everything decided.
#pragma once

#include "core/atlas/atlas.h"
#include "core/get_or_compute.h"
#include "core/individual/individual.h"

namespace sporeprint {

/// Decides everything about one individual. Growing is morphing: age moves weights between a species' own stages, a mix between
/// species, and one morph of all control shapes serves both. Sizes mix by ratio, bends of the axis as rotations.
/// A Model of the client's own has no species: age and variation do not touch it.
///
/// morphs   keeps the correspondence of a set of species, the dear part
/// returns  the same whatever the order of the species
/// throws   InvalidInput for a range or an unknown species, Impossible for what no species of the mix can have and for an outline
///          that crosses itself; paths like "/hymenium/blades", "mix"
/// source   [Desbenoit2004] sec. 4
[[nodiscard]] Individual resolve(const MushroomOrder& order, const Atlas& atlas,
                                 const Remember<MorphSet>& morphs = make_anew<MorphSet>);

/// The bushes of the species of an order, by id, as their templates are: no individual's own. All have the same nodes, those of every
/// species laid over each other; of what a species lacks the presence is 0.
///
/// pre     they branch
/// throws  InvalidInput for a range or an unknown species
[[nodiscard]] std::vector<Bush> species_bushes(const MushroomOrder& order, const Atlas& atlas);

/// The control shapes of the species of an order, as their templates are: no individual's own.
struct SpeciesShapes {
    std::shared_ptr<const MorphSet> set;
    /// One for each species by id: weights of all shapes of the set when it counts alone, at the age of the order.
    std::vector<std::vector<double>> weights;
    std::vector<double> sizes;  ///< metres, by id: what the shapes of the set are divided by
};

/// pre     they do not branch; the order has no arcs
/// throws  InvalidInput for a range or an unknown species
[[nodiscard]] SpeciesShapes species_shapes(const MushroomOrder& order, const Atlas& atlas,
                                           const Remember<MorphSet>& morphs = make_anew<MorphSet>);

}  // namespace sporeprint
