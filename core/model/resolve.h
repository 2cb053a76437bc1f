// From an order to one individual: growth stage, variation and overrides, everything decided.
#pragma once

#include "core/atlas/atlas.h"
#include "core/model/request.h"

namespace sporeprint {

/// One species of an individual, or its own Model (`id` empty).
struct SpeciesShare {
    std::string id;
    double weight = 1.0;  ///< weights of an individual sum to 1
    Model model;          ///< the species' own at this age, overrides applied: what is painted
};

/// An order with everything decided: the individual's own Model (sizes, colours and amounts after age, variation and overrides).
struct Individual {
    Model model;
    MushroomParams
        effective;  ///< every optional that the species can have, set to what the individual really has
    double lightness = 1.0;           ///< factor on the linear colour of the cap
    std::vector<SpeciesShare> parts;  ///< by id
};

/// Decides everything about one individual. A Model of the client's own has no species: age and variation do not touch it.
///
/// throws  InvalidInput for a range, Impossible for what the species cannot have; paths like "/hymenium/blades", "mix"
/// source  [Desbenoit2004] sec. 4; ages blend linearly between the stages of a species
[[nodiscard]] Individual resolve(const MushroomOrder& order, const Atlas& atlas);

}  // namespace sporeprint
