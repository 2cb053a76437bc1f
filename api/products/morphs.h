// Requests about morphs of two species: their correspondence, and mushrooms between them with the designer's own arcs.
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

/// The ids of the two species of an address, in its order.
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

/// Most arcs of one body.
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

/// What GET asks for.
struct MorphRequest {
    SpeciesPair species;
    MorphParams params;
    std::optional<std::string> version;
};

/// Reads the {a} and {b} of an address: 404 for species that the atlas does not hold, 422 for one and the same.
[[nodiscard]] SpeciesPair read_pair(std::string_view a, std::string_view b, const Atlas& atlas,
                                    ValidationErrors& errors);

/// Reads the query of GET /v1/morphs/{a}/{b}.
[[nodiscard]] MorphRequest read_morph(SpeciesPair species, Query query, ValidationErrors& errors);

/// Reads the body of POST /v1/morphs/{a}/{b}.glb as an order of a mix: t in thousandths, arcs sorted along their curves and seen
/// from the species that comes first by id, so that equal meaning is an equal order. Arcs that cross are 422, each named.
[[nodiscard]] MushroomRequest read_morph(const SpeciesPair& species, std::string_view body,
                                         ValidationErrors& errors);

/// Canonical address of a correspondence without version.
[[nodiscard]] std::string canonical_address(const MorphRequest& request);

/// Version token of what a pair is made with, whatever its order.
[[nodiscard]] std::string version_token(const SpeciesPair& species, const Atlas& atlas);

/// Full canonical text of a correspondence.
[[nodiscard]] std::string key_of(const MorphRequest& request, std::string_view version);

}  // namespace sporeprint::api
