// The mix of species in an address: "amanita_muscaria:0.7,boletus_edulis:0.3".
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/http/errors.h"
#include "core/atlas/atlas.h"
#include "core/individual/mushroom_spec.h"

namespace sporeprint::api {

/// Most species in one mix.
inline constexpr std::size_t most_species = 8;

/// Species ids with weights as a client wrote them.
using Weights = std::vector<std::pair<std::string, double>>;

/// Canonical form: weights in thousandths by largest remainder (ties by id, sum 1000), those that round to 0 dropped, sorted
/// by id. canonical(canonical(x)) = canonical(x).
///
/// weights  positive and finite, ids distinct, not empty
[[nodiscard]] Mix canonical_mix(Weights weights);

/// The mix as an address holds it: no weight for a lone species, no trailing zeros.
[[nodiscard]] std::string mix_text(const Mix& mix);

/// Reads the {mix} of an address. Faults carry the parameter "mix": 400 for form and weights, 404 for species that the atlas
/// does not hold (with the name probably meant).
///
/// returns  the canonical mix; empty when there are faults
[[nodiscard]] Mix read_mix(std::string_view text, const Atlas& atlas, ValidationErrors& errors);

/// Reads {"mix":{id:weight}} of a body; the same rules.
[[nodiscard]] Mix read_mix_object(const Value& json, const Atlas& atlas, ValidationErrors& errors);

/// "unknown species 'amanita'; did you mean 'amanita_muscaria'?"
[[nodiscard]] std::string unknown_species(std::string_view id, const Atlas& atlas);

}  // namespace sporeprint::api
