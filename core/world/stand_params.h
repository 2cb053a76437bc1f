// The parameters of the trees of a world.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/params/describe.h"
#include "core/params/mix.h"
#include "core/problems.h"

namespace sporeprint {

/// Reads kinds of trees with their weights: "broadleaf:0.8+birch:0.2".
///
/// path     of the problems
/// returns  ids with weights above 0, none twice; nothing if there is a problem
[[nodiscard]] Weights kinds_in(std::string_view text, const std::string& path,
                               std::vector<Problem>& problems);

/// Returns kinds as a text whose weights are thousandths of their sum: equal mixtures have equal texts. Text with
/// problems is returned as it is.
[[nodiscard]] std::string canonical_kinds(std::string_view text);

/// What the trees of a world are drawn from.
struct StandParams {
    Text<256> kinds{"broadleaf"};
    double density = 0.7;
    double patch_years = 140.0;
    double height = 28.0;
    double dead_wood = 1.0;
    double glade = 0.0;
    Text<48> lone;

    static constexpr void fields(auto visit) {
        using S = StandParams;
        visit(&S::kinds,
              Info{.name = "kinds",
                   .most = 256,
                   .doc = "Kinds of trees, as under /v1/trees, each with a weight and joined by +: "
                          "broadleaf:0.8+birch:0.2. Which of them grows where also depends on how "
                          "wet the ground is."});
        visit(&S::density, Info{.name = "density",
                                .min = 0,
                                .max = 1,
                                .doc = "Share of the places for seedlings that are taken; with 0 "
                                       "there is no wood.",
                                .step = 0.01});
        visit(&S::patch_years, Info{.name = "patch_years",
                                    .unit = "years",
                                    .min = 20,
                                    .max = 400,
                                    .doc = "Mean time between two storms that fell a patch of the "
                                           "wood, of about 22 by 22 m.",
                                    .step = 5});
        visit(&S::height, Info{.name = "height",
                               .unit = "m",
                               .min = 3,
                               .max = 40,
                               .doc = "Height of old trees; kinds differ from it, and trees by a "
                                      "sixth.",
                               .step = 0.5});
        visit(&S::dead_wood, Info{.name = "dead_wood",
                                  .min = 0,
                                  .max = 3,
                                  .doc = "Dead wood compared with that of a wood that nobody "
                                         "manages: below 1 that share of the trunks stays, above 1 "
                                         "trunks decay as many times more slowly.",
                                  .step = 0.05});
        visit(&S::glade, Info{.name = "glade",
                              .unit = "m",
                              .min = 0,
                              .max = 200,
                              .doc = "Radius of open land round the centre of the world.",
                              .step = 1});
        visit(&S::lone, Info{.name = "lone",
                             .most = 48,
                             .doc = "A kind of tree, one of which is planted at the centre of the "
                                    "world in year 0."});
    }
    void check(const std::string& path, std::vector<Problem>& problems) const {
        // Weights in thousandths may make the text longer.
        if (kinds.size() > 160)
            return report(
                problems, path + "/kinds",
                "has " + std::to_string(kinds.size()) + " bytes; at most 160 are allowed");
        static_cast<void>(kinds_in(kinds, path + "/kinds", problems));
    }
    bool operator==(const StandParams&) const = default;
};
static_assert(well_described<StandParams>());

}  // namespace sporeprint
