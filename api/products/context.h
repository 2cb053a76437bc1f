// The inputs of the handlers of routes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "api/cache/store.h"
#include "api/http/query.h"
#include "api/http/response_builder.h"
#include "api/http/routes.h"
#include "api/http/service_options.h"
#include "api/library/library.h"
#include "core/atlas/atlas.h"
#include "core/grow/nearest_species.h"

namespace sporeprint::api {

class StaticDocuments;

/// The state that all handlers share; it lives as long as the Service.
struct Context {
    std::shared_ptr<const Atlas> atlas;
    ServiceOptions options;
    ResponseBuilder responses;
    Store& store;
    Caches caches;  ///< `cached_only`, or `computed_inline` when the correspondence may be computed
    const RouteTable& routes;
    const StaticDocuments* documents = nullptr;
    LazyNearestSpecies& nearest;       ///< of this atlas, for traces
    std::shared_ptr<Library> library;  ///< nullptr if the service has none
    bool has_guests =
        false;  ///< `atlas` has species of the library, which their owners may withdraw
    bool has_drafts = false;         ///< among them drafts, which only some may see
    bool has_prerequisites = false;  ///< a warm-up job has just computed what the request needs
};

/// A request with its route.
struct RouteCall {
    Context& context;
    const Request& request;
    const Route& route;
    const Target& target;
    const std::vector<std::string>& captured;  ///< in the order of the {names} of the pattern
    ValidationErrors& errors;                  ///< found so far; if any, the response
};

/// Returns a copy of a context whose atlas has guests.
[[nodiscard]] std::shared_ptr<Context> with_guests(const Context& context,
                                                   std::vector<AtlasGuest> guests);

/// Adds an error for each query parameter of a request to a route that has none.
void refuse_query(const Target& target, ValidationErrors& errors);

}  // namespace sporeprint::api
