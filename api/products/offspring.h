// Offspring of two species: from a URL to a bred species, mushrooms of it, and their routes.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "api/products/context.h"
#include "api/products/mushrooms.h"
#include "api/products/product.h"
#include "core/breed/breeding.h"

namespace sporeprint::api {

/// A species of the atlas, or one of a client.
struct Parent {
    std::string id;
    std::shared_ptr<const Species> own;  ///< nothing for one of the atlas
};

/// Two parents, what the offspring has of them, and how a mushroom of it is grown.
struct OffspringSpec {
    Parent a, b;
    BreedingParams breeding;  ///< its locks are sorted, each once
    MushroomParams params;    ///< its seed is that of the individual
};

struct OffspringRequest {
    OffspringSpec spec;
    Product product = Product::glb;
    std::optional<std::string> version;
};

/// Reads both ids and the query of a URL; adds all problems to `errors`. `seed` and `share` are those
/// of the breeding, `individual` is the seed of the mushroom, all other parameters are those of
/// mushrooms. A species has none of these.
[[nodiscard]] OffspringRequest read_offspring(std::string_view a, std::string_view b, Query query,
                                              Product product, const Atlas& atlas,
                                              ValidationErrors& errors);

/// Reads a body: {"a","b"}, each an id or a whole species, beside the same parameters.
[[nodiscard]] OffspringRequest read_offspring(std::string_view body, Product product,
                                              const Atlas& atlas, ValidationErrors& errors);

/// The Kind of plan_product.h for offspring: as JSON the species itself.
struct OffspringOfTwo {
    /// The atlas of the bred species alone, and the individual.
    struct Resolved {
        std::shared_ptr<const Atlas> atlas;
        Mushrooms::Resolved individual;
    };

    static std::string version(const OffspringSpec& spec, const Atlas& atlas);
    static std::string document_version(const OffspringSpec& spec, const Atlas& atlas);
    static std::string url(const OffspringSpec& spec, Product product, const Atlas& atlas);
    static std::string key(const OffspringSpec& spec, Product product, const std::string& version);
    static std::string file_name(const OffspringSpec& spec, Product product, const Atlas& atlas);
    static Cost cost(const Context& context, const OffspringSpec& spec, Product product,
                     const Caches& caches, Resolved& resolved);
    static Cost search(const OffspringSpec& spec, const Atlas& atlas);
    static Cost guess(const OffspringSpec& spec, Product product, const Atlas& atlas);
    static ImageUrls image_urls(const Context& context, const OffspringSpec& spec,
                                const std::string& version, const ExecutionContext& execution);
    static Body grow(const Context& context, const OffspringSpec& spec, Resolved& resolved,
                     const Extras& extras, int depth, const ExecutionContext& execution);
    static Value describe(const Context& context, const OffspringSpec& spec, Resolved& resolved,
                          const std::string& version, const ExecutionContext& execution);
};

extern const RouteGroup offspring_routes;

}  // namespace sporeprint::api
