// The list of species and its filters.
#pragma once

#include <span>
#include <string>
#include <utility>

#include "api/http/errors.h"
#include "core/atlas/atlas.h"
#include "core/params/describe.h"

namespace sporeprint::api {

/// Shape families, as the list names them.
enum class Family { swept, branched };

constexpr const char* name(Family family) {
    switch (family) {
        case Family::swept:
            return "swept";
        case Family::branched:
            return "branched";
    }
    return nullptr;
}

/// Query parameters of /v1/species.
struct SpeciesFilter {
    std::optional<GrowthForm> form;
    std::optional<Family> family;
    std::optional<Text<64>> substrate, habit;
    std::optional<int> month;
    std::optional<Text<32>> colour;
    std::optional<double> min_diameter_m, max_diameter_m;

    static constexpr void fields(auto visit) {
        using F = SpeciesFilter;
        visit(&F::form, Info{.name = "form", .doc = "Only this growth form."});
        visit(&F::family, Info{.name = "family", .doc = "Only this shape family."});
        visit(&F::substrate,
              Info{.name = "substrate",
                   .most = 64,
                   .doc = "Only species whose substrate contains this text, in any case."});
        visit(&F::habit,
              Info{.name = "habit",
                   .most = 64,
                   .doc = "Only species whose habit (tufts, rings, …) contains this text, in any "
                          "case."});
        visit(&F::month,
              Info{.name = "month",
                   .min = 1,
                   .max = 12,
                   .doc = "Only species that fruit in this month in the northern hemisphere."});
        visit(&F::colour,
              Info{.name = "colour",
                   .most = 32,
                   .doc = "Only species whose main colour contains this text, in any case."});
        visit(&F::min_diameter_m, Info{.name = "min_diameter_m",
                                       .unit = "m",
                                       .min = 0,
                                       .max = 10,
                                       .doc = "Only species whose cap grows at least this wide."});
        visit(&F::max_diameter_m,
              Info{.name = "max_diameter_m",
                   .unit = "m",
                   .min = 0,
                   .max = 10,
                   .doc = "Only species whose full-grown cap may be at most this wide."});
    }
    void check(const std::string& path, std::vector<Problem>& problems) const {
        if (min_diameter_m && max_diameter_m && *min_diameter_m > *max_diameter_m)
            report(problems, path + "/max_diameter_m", "is smaller than min_diameter_m");
    }
    bool operator==(const SpeciesFilter&) const = default;
};

/// Whether a species passes. One without a cap passes no filter on diameters.
[[nodiscard]] bool passes(const Species& species, const SpeciesFilter& filter);

/// The shape family of a species: that of its stages.
[[nodiscard]] Family family_of(const Species& species);

/// {"species":[…]}, sorted by id.
[[nodiscard]] Value species_list(const Atlas& atlas, const SpeciesFilter& filter = {});

/// {"mushrooms":[{"id","name","links"}]}, sorted by id: the species that a product is grown of.
///
/// product  as in its addresses, /v1/{product}
[[nodiscard]] Value product_list(const Atlas& atlas, const std::string& product);

}  // namespace sporeprint::api
