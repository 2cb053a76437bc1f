// The parameters of the fungi of a world.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/params/describe.h"
#include "core/problems.h"

namespace sporeprint {

/// Largest number of species in one world.
inline constexpr std::size_t most_world_species = 12;

/// Reads a list of species: "boletus_edulis+russula_emetica".
///
/// path     of the problems
/// returns  ids without repetition, sorted; nothing for an empty text or if there is a problem
[[nodiscard]] std::vector<std::string> species_in(std::string_view text, const std::string& path,
                                                  std::vector<Problem>& problems);

/// Returns a list of species in one form: sorted. Text with problems is returned as it is.
[[nodiscard]] std::string canonical_species(std::string_view text);

/// Which fungi live in a world.
struct FungiParams {
    Text<620> species;
    double abundance = 1.0;

    static constexpr void fields(auto visit) {
        using F = FungiParams;
        visit(&F::species, Info{.name = "species",
                                .most = 620,
                                .doc = "Species, as under /v1/species, at most 12, joined by +: "
                                       "boletus_edulis+russula_emetica."});
        visit(&F::abundance,
              Info{.name = "abundance",
                   .min = 0,
                   .max = 10,
                   .doc = "Factor of the number of fruit bodies; where there are more, all others "
                          "stand where they stood.",
                   .step = 0.1});
    }
    void check(const std::string& path, std::vector<Problem>& problems) const {
        static_cast<void>(species_in(species, path + "/species", problems));
    }
    bool operator==(const FungiParams&) const = default;
};
static_assert(well_described<FungiParams>());

}  // namespace sporeprint
