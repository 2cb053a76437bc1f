// Mushrooms: from a URL or a body to a MushroomSpec, back to the canonical URL and key, and their
// routes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "api/products/context.h"
#include "api/products/product.h"
#include "core/atlas/atlas.h"
#include "core/individual/individual.h"
#include "core/individual/mushroom_spec.h"

namespace sporeprint::api {

/// A specification, the product to generate, and the version token of the request.
struct MushroomRequest {
    MushroomSpec spec;
    Product product = Product::glb;
    std::optional<std::string> version;
};

/// Reads the {mix} and the query of a URL. Adds all problems to `errors`.
[[nodiscard]] MushroomRequest read_mushroom(std::string_view mix, Query query, const Atlas& atlas,
                                            ValidationErrors& errors);

/// Reads a body: {"mix":{id:weight}} or {"model":{…}}, beside the nested query parameters
/// ("weathering":{"fade":0.4}).
[[nodiscard]] MushroomRequest read_mushroom(std::string_view body, const Atlas& atlas,
                                            ValidationErrors& errors);

/// Returns the current version token of a mix (or, if it is empty, of a custom model): generator
/// version, '-', 8 hexadecimal digits of the hash of the templates used.
[[nodiscard]] std::string version_token(const Mix& mix, const Atlas& atlas);

/// Returns the canonical URL without version: path with the canonical mix, then parameters that
/// differ from their defaults, in schema order.
///
/// spec  has no custom model
[[nodiscard]] std::string canonical_address(const MushroomSpec& spec,
                                            Product product = Product::glb);

/// Returns the canonical text of all values, with product, generator version and templates: equal
/// keys mean equal bytes.
[[nodiscard]] std::string key_of(const MushroomSpec& spec, Product product,
                                 std::string_view version);

/// The Kind of plan_product.h for mushrooms.
struct Mushrooms {
    /// The individual, once it is needed. The job of a client's own model resolves it again: it
    /// holds copies of uploaded images, which would take memory while the job waits.
    using Resolved = std::optional<Individual>;

    static std::string version(const MushroomSpec& spec, const Atlas& atlas);
    static std::string url(const MushroomSpec& spec, Product product, const Atlas& atlas);
    static std::string key(const MushroomSpec& spec, Product product, const std::string& version);
    static std::string file_name(const MushroomSpec& spec, Product product, const Atlas&);
    static Cost cost(const Context& context, const MushroomSpec& spec, Product product,
                     const Caches& caches, Resolved& resolved);
    static Cost search(const MushroomSpec& spec, const Atlas& atlas);
    static Cost guess(const MushroomSpec& spec, Product product, const Atlas& atlas);
    static ImageUrls image_urls(const Context& context, const MushroomSpec& spec,
                                const std::string& version, const ExecutionContext& execution);
    /// Returns the URLs of the images of the wood in a file; nothing if there is none.
    static std::optional<ImageUrls> wood_urls(const MushroomSpec& spec,
                                              const Individual& individual);
    static Body grow(const Context& context, const MushroomSpec& spec, Resolved& resolved,
                     const Extras& extras, int depth, const ExecutionContext& execution);
    static Value describe(const Context& context, const MushroomSpec& spec, Resolved& resolved,
                          const std::string& version, const ExecutionContext& execution);
};

/// Returns the cost of computing the correspondence of a mix or a custom model; zero for branched
/// species, which need none.
[[nodiscard]] Cost cost_of_search(const Mix& mix, const Atlas& atlas);

/// Returns the cost of resolving `count` individuals of a mix or a custom model.
///
/// branches  true for the branched family
[[nodiscard]] Cost cost_of_individuals(const Mix& mix, bool branches, std::uint64_t count);

/// Returns true if the species of a mix are branched.
[[nodiscard]] bool is_branched(const Mix& mix, const Atlas& atlas);

extern const RouteGroup mushroom_routes;

}  // namespace sporeprint::api
