// The table of routes: the one place that lists what the service answers. Matching is literal, without regular expressions.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sporeprint::api {

enum class Endpoint {
    page,
    docs,
    asset,
    root,
    species_list,
    species,
    mushroom_list,
    mushroom_glb,
    mushroom_json,
    mushroom_schema,
    mushroom_post,
    morph,
    morph_post,
    colony_list,
    colony_glb,
    colony_json,
    colony_schema,
    colony_post,
    leaf_list,
    leaf_glb,
    leaf_json,
    leaf_schema,
    leaf_post,
    tree_list,
    tree_glb,
    tree_json,
    tree_schema,
    tree_post,
    surface,
    leaf_surface,
    tree_surface,
    inspect,
    openapi,
    problem_type,
    livez,
    readyz,
    metrics
};

struct Route {
    Endpoint endpoint;
    const char* method;  ///< "GET" (HEAD agrees) or "POST"
    const char*
        pattern;  ///< "/v1/mushrooms/{mix}.glb": a segment may hold one {name} before a literal ending
    const char* id;  ///< operationId
    const char* summary;
    const char* responses;  ///< media type of the 200
    const char* takes;      ///< media type of the body, or ""
};

[[nodiscard]] std::span<const Route> routes();

/// Whether what a route answers is made on demand: what costs work, and what a signature is asked for. All else are documents.
[[nodiscard]] bool is_generated(Endpoint endpoint);

struct Match {
    const Route* route = nullptr;
    std::vector<std::string> captured;  ///< in the order of the {names}
    std::string
        allow;  ///< every method of the path, "GET, HEAD, OPTIONS"; empty when the path is unknown
};

/// Finds the route of a path and method; HEAD counts as GET. `route` is null when the path or the method is not known.
[[nodiscard]] Match match_route(std::string_view method, std::span<const std::string> segments);

/// The address a person most likely meant by an unknown path, or "".
[[nodiscard]] std::string closest_route(std::span<const std::string> segments);

/// Longest body that a route takes, in bytes.
[[nodiscard]] std::size_t longest_body(const Route& route);

}  // namespace sporeprint::api
