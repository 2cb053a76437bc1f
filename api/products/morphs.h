// Morphs of two species: their correspondence, and mushrooms between them with arcs of the client.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/http/errors.h"
#include "api/products/mushrooms.h"
#include "core/atlas/atlas.h"
#include "core/individual/mushroom_spec.h"
#include "core/silhouette/morph_set.h"

namespace sporeprint::api {

/// The ids of the two species of a URL, in its order.
using SpeciesPair = std::array<std::string, 2>;

/// Query parameters of GET /v1/morphs/{a}/{b}.
struct MorphParams {
    double age = 0.6;

    static constexpr void fields(auto visit) {
        visit(&MorphParams::age,
              Info{.name = "age",
                   .min = 0,
                   .max = 1,
                   .doc = "Age of both: from button (0) through maturity (0.6) to decay (1)."});
    }
    bool operator==(const MorphParams&) const = default;
};

/// Largest number of arcs in one body.
inline constexpr std::size_t most_arcs = 64;

/// Body of POST /v1/morphs/{a}/{b}.glb.
struct MorphSpec {
    double t = 0.5;
    std::vector<Arc> arcs;
    MushroomParams params;

    static constexpr void fields(auto visit) {
        using M = MorphSpec;
        visit(&M::t, Info{.name = "t",
                          .min = 0,
                          .max = 1,
                          .doc = "From the first species (0) to the second (1), in thousandths."});
        visit(&M::arcs,
              Info{.name = "arcs",
                   .most = most_arcs,
                   .doc = "Your own links: a point of the first species' outline becomes a point "
                          "of the second's. They may not cross."});
        visit(&M::params, Info{.name = "", .doc = "The parameters of a mushroom."});
    }
    bool operator==(const MorphSpec&) const = default;
};

/// A request for a correspondence.
struct MorphRequest {
    SpeciesPair species;
    MorphParams params;
    std::optional<std::string> version;
};

/// Reads the {a} and {b} of a URL: 404 for species that are not in the atlas, 422 for twice the
/// same.
[[nodiscard]] SpeciesPair read_pair(std::string_view a, std::string_view b, const Atlas& atlas,
                                    ValidationErrors& errors);

/// Reads the query of GET /v1/morphs/{a}/{b}.
[[nodiscard]] MorphRequest read_morph(SpeciesPair species, Query query, ValidationErrors& errors);

/// Reads the body of POST /v1/morphs/{a}/{b}.glb as a request for a mix: t in thousandths, arcs
/// sorted along their curves and oriented from the species that is first by id, so that requests
/// with equal meaning are equal. Arcs that cross are 422, each with its path.
[[nodiscard]] MushroomRequest read_morph(const SpeciesPair& species, std::string_view body,
                                         ValidationErrors& errors);

/// Returns the canonical URL of a correspondence without version.
[[nodiscard]] std::string canonical_address(const MorphRequest& request);

/// Returns the version token of a pair of species, which does not depend on their order.
[[nodiscard]] std::string version_token(const SpeciesPair& species, const Atlas& atlas);

/// Returns the full canonical text of a correspondence.
[[nodiscard]] std::string key_of(const MorphRequest& request, std::string_view version);

extern const RouteGroup morph_routes;

}  // namespace sporeprint::api
