// From an order to one individual: growth stage, variation and overrides, everything decided.
#pragma once

#include "core/atlas/atlas.h"
#include "core/model/request.h"

namespace sporeprint {

/// An order with everything decided: the individual's own Model (sizes, colours and amounts after age, variation and overrides).
struct Individual {
    Model model;
    MushroomParams
        effective;  ///< every optional that the species can have, set to what the individual really has
    double lightness = 1.0;  ///< factor on the linear colour of the cap
};

/// Decides everything about one individual. A Model of the client's own has no species: age and variation do not touch it.
///
/// throws  InvalidInput for a range, Impossible for what the species cannot have; paths like "/hymenium/blades", "mix"
/// source  [Desbenoit2004] sec. 4; ages blend linearly between the stages of a species
[[nodiscard]] Individual resolve(const MushroomOrder& order, const Atlas& atlas);

}  // namespace sporeprint
