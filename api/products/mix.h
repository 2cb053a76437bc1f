// The mix of species in a URL: "amanita_muscaria:0.7,boletus_edulis:0.3".
#pragma once

#include <string>
#include <string_view>

#include "api/http/errors.h"
#include "core/atlas/atlas.h"
#include "core/grow/names.h"
#include "core/params/mix.h"

namespace sporeprint::api {

/// Largest number of species in one mix.
inline constexpr std::size_t most_species = 8;

/// Finds a species by its id, or nullptr if the atlas has none.
///
/// throws  SpeciesOfLibrary if it is one of the library that the atlas does not have as a guest
[[nodiscard]] const AtlasEntry* find_species(std::string_view id, const Atlas& atlas);

/// Reads the {mix} of a URL. Errors name the parameter "mix": 400 for syntax and weights, 404 for
/// species that are not in the atlas (with a suggestion).
///
/// returns  the canonical mix; empty if there are errors
/// throws   SpeciesOfLibrary
[[nodiscard]] Mix read_mix(std::string_view text, const Atlas& atlas, ValidationErrors& errors);

/// Reads {"mix":{id:weight}} of a body by the same rules.
[[nodiscard]] Mix read_mix_object(const Value& json, const Atlas& atlas, ValidationErrors& errors);

/// Returns "unknown species 'amanita'; did you mean 'amanita_muscaria'?"
[[nodiscard]] std::string unknown_species(std::string_view id, const Atlas& atlas);

/// Returns the mix as descriptions contain it: [{"id","weight"}], weights as shares of 1.
[[nodiscard]] Value mix_value(const Mix& mix);

/// Returns the schema of a mix in a body.
[[nodiscard]] Value mix_schema();
/// Returns the schema of mix_value().
[[nodiscard]] Value mix_list_schema();

}  // namespace sporeprint::api
