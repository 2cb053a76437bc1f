// The list of species and its filters; the lists of products that are generated from species.
#pragma once

#include <span>
#include <string>
#include <utility>

#include "api/http/errors.h"
#include "core/atlas/atlas.h"
#include "core/params/describe.h"

namespace sporeprint::api {

/// Shape families, with the names of the list.
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

/// Returns true if a species matches a filter. One without a cap matches no filter on diameters.
[[nodiscard]] bool passes(const Species& species, const SpeciesFilter& filter);

/// Returns the shape family of the stages of a species.
[[nodiscard]] Family family_of(const Species& species);

/// Returns {"species":[…]}, sorted by id.
[[nodiscard]] Value species_list(const Atlas& atlas, const SpeciesFilter& filter = {});

/// Returns {"mushrooms":[{"id","name","links"}]}, sorted by id: the species of which a product can
/// be generated.
///
/// product  the name in its URLs, /v1/{product}
[[nodiscard]] Value product_list(const Atlas& atlas, const std::string& product);

/// Returns the schema of the items of product_list().
[[nodiscard]] Value product_list_schema();

/// Returns the schema of a species or model in which branched fungi have order 2 or more: a branch
/// graph of order 1 would have no fork and is refused, where a tree of order 1 is a twig.
[[nodiscard]] Value with_branched_order(Value schema);

}  // namespace sporeprint::api
