// Colonies: from a URL or a body to a ColonySpec, back to the canonical URL and key, and their
// routes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "api/products/context.h"
#include "api/products/product.h"
#include "core/atlas/atlas.h"
#include "core/colony/colony_spec.h"
#include "core/individual/individual.h"

namespace sporeprint::api {

/// A specification, the product to generate, and the version token of the request.
struct ColonyRequest {
    ColonySpec spec;
    Product product = Product::glb;
    std::optional<std::string> version;
};

/// Reads the {mix} and the query of a URL. Adds all problems to `errors`.
[[nodiscard]] ColonyRequest read_colony(std::string_view mix, Query query, const Atlas& atlas,
                                        ValidationErrors& errors);

/// Reads a body: {"mix":{id:weight}} beside the query parameters. Adds all problems to `errors`.
[[nodiscard]] ColonyRequest read_colony(std::string_view body, const Atlas& atlas,
                                        ValidationErrors& errors);

/// Returns the canonical URL without version: path with the canonical mix, then parameters that
/// differ from their defaults, in schema order.
[[nodiscard]] std::string canonical_address(const ColonySpec& spec, Product product = Product::glb);

/// Returns the canonical text of all values, with product, generator version and templates: equal
/// keys mean equal bytes.
[[nodiscard]] std::string key_of(const ColonySpec& spec, Product product, std::string_view version);

/// The Kind of plan_product.h for colonies.
struct Colonies {
    using Resolved = std::optional<Individual>;  ///< the typical individual, once it is needed

    static std::string version(const ColonySpec& spec, const Atlas& atlas);
    static std::string url(const ColonySpec& spec, Product product, const Atlas& atlas);
    static std::string key(const ColonySpec& spec, Product product, const std::string& version);
    static std::string file_name(const ColonySpec& spec, Product product, const Atlas&);
    static Cost cost(const Context& context, const ColonySpec& spec, Product product,
                     const Caches& caches, Resolved& resolved);
    static Cost search(const ColonySpec& spec, const Atlas& atlas);
    static std::optional<Cost> guess(const ColonySpec& spec, Product product, const Atlas& atlas);
    /// Returns how often each individual is drawn.
    static std::uint64_t instances_of_each(const ColonySpec& spec);
    static ImageUrls image_urls(const Context& context, const ColonySpec& spec,
                                const std::string& version, const ExecutionContext& execution);
    /// Returns those of a variant.
    ///
    /// painted  the mushroom whose images it has
    static ImageUrls variant_urls(const Context& context, const ColonySpec& spec,
                                  const MushroomSpec& painted, const ExecutionContext& execution);
    static Body grow(const Context& context, const ColonySpec& spec, Resolved& resolved,
                     const Extras& extras, int depth, const ExecutionContext& execution);
    static Value describe(const Context& context, const ColonySpec& spec, Resolved& resolved,
                          const std::string& version, const ExecutionContext& execution);
};

extern const RouteGroup colony_routes;

}  // namespace sporeprint::api
