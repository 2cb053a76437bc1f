// Sets of mushrooms: a manifest of files that fit into a budget, and all of them in one archive.
#pragma once

#include "api/products/context.h"
#include "api/products/product.h"
#include "core/grow/set.h"

namespace sporeprint::api {

/// A request for a set, with the version token that was requested.
struct SetRequest {
    SetSpec spec;
    std::optional<std::string> version;
};

/// Reads a body: {"species":["amanita_muscaria","a:0.7,b:0.3"]} beside the parameters of a set and
/// those of a mushroom except seed, age and lod.
[[nodiscard]] SetRequest read_set(std::string_view body, const Atlas& atlas,
                                  ValidationErrors& errors);

extern const RouteGroup set_routes;

}  // namespace sporeprint::api
