#include "api/http/routes.h"

#include <algorithm>
#include <array>

#include "api/http/text.h"
#include "core/params/messages.h"

namespace sporeprint::api {

namespace {

constexpr const char* json = "application/json";
constexpr const char* glb = "model/gltf-binary";

constexpr std::array<Route, 37> table = {{
    {Endpoint::page, "GET", "/", "page", "The viewer page.", "text/html", ""},
    {Endpoint::docs, "GET", "/docs", "docs", "A page that shows this document.", "text/html", ""},
    {Endpoint::asset, "GET", "/assets/{name}", "asset", "A file of the viewer page.",
     "application/octet-stream", ""},
    {Endpoint::root, "GET", "/v1", "about", "Name, version and links.", json, ""},
    {Endpoint::species_list, "GET", "/v1/species", "list_species",
     "The species of the atlas, filtered.", json, ""},
    {Endpoint::species, "GET", "/v1/species/{id}", "get_species", "The template of a species.",
     json, ""},
    {Endpoint::mushroom_list, "GET", "/v1/mushrooms", "list_mushrooms",
     "The species that mushrooms are grown of, with links.", json, ""},
    {Endpoint::mushroom_schema, "GET", "/v1/mushrooms/schema", "mushroom_schema",
     "JSON Schema of the query parameters of a mushroom.", "application/schema+json", ""},
    {Endpoint::mushroom_glb, "GET", "/v1/mushrooms/{mix}.glb", "get_mushroom",
     "Grows a mushroom and answers with a GLB file.", glb, ""},
    {Endpoint::mushroom_json, "GET", "/v1/mushrooms/{mix}.json", "describe_mushroom",
     "What would be grown: canonical address, effective parameters, cost and bounds.", json, ""},
    {Endpoint::mushroom_post, "POST", "/v1/mushrooms.glb", "post_mushroom",
     "Grows a mushroom from a body: a mix, or a whole model of your own.", glb, json},
    {Endpoint::morph_post, "POST", "/v1/morphs/{a}/{b}.glb", "post_morph",
     "Grows a mushroom between two species, with your own arcs from one outline to the other.", glb,
     json},
    {Endpoint::morph, "GET", "/v1/morphs/{a}/{b}", "get_morph",
     "Correspondence of two species: both outlines, what of one becomes what of the other, and "
     "whether any morph between them crosses itself; of two that branch the limbs of both, fork "
     "on fork.",
     json, ""},
    {Endpoint::colony_list, "GET", "/v1/colonies", "list_colonies",
     "The species that colonies are grown of, with links.", json, ""},
    {Endpoint::colony_schema, "GET", "/v1/colonies/schema", "colony_schema",
     "JSON Schema of the query parameters of a colony.", "application/schema+json", ""},
    {Endpoint::colony_glb, "GET", "/v1/colonies/{mix}.glb", "get_colony",
     "Grows a colony: roots, stems and caps, each cap stored once.", glb, ""},
    {Endpoint::colony_json, "GET", "/v1/colonies/{mix}.json", "describe_colony",
     "What would be grown: canonical address, how many found room, effective parameters, cost and "
     "bounds.",
     json, ""},
    {Endpoint::colony_post, "POST", "/v1/colonies.glb", "post_colony",
     "Grows a colony from a body: a mix and what is to differ from its habit.", glb, json},
    {Endpoint::leaf_list, "GET", "/v1/leaves", "list_leaves", "The leaves to begin with.", json,
     ""},
    {Endpoint::leaf_schema, "GET", "/v1/leaves/schema", "leaf_schema",
     "JSON Schema of the query parameters of a leaf.", "application/schema+json", ""},
    {Endpoint::leaf_glb, "GET", "/v1/leaves/{preset}.glb", "get_leaf",
     "Grows a leaf and answers with a GLB file.", glb, ""},
    {Endpoint::leaf_json, "GET", "/v1/leaves/{preset}.json", "describe_leaf",
     "What would be grown: canonical address, effective parameters, cost and bounds.", json, ""},
    {Endpoint::leaf_post, "POST", "/v1/leaves.glb", "post_leaf",
     "Grows a leaf from a body: a preset and what is to differ from it.", glb, json},
    {Endpoint::tree_list, "GET", "/v1/trees", "list_trees", "The trees to begin with.", json, ""},
    {Endpoint::tree_schema, "GET", "/v1/trees/schema", "tree_schema",
     "JSON Schema of the query parameters of a tree.", "application/schema+json", ""},
    {Endpoint::tree_glb, "GET", "/v1/trees/{preset}.glb", "get_tree",
     "Grows a tree and answers with a GLB file.", glb, ""},
    {Endpoint::tree_json, "GET", "/v1/trees/{preset}.json", "describe_tree",
     "What would be grown: canonical address, effective parameters, matrix, cost and bounds.", json,
     ""},
    {Endpoint::tree_post, "POST", "/v1/trees.glb", "post_tree",
     "Grows a tree from a body: a preset and what is to differ from it, also a ramification matrix "
     "of your own.",
     glb, json},
    {Endpoint::surface, "GET", "/v1/surfaces/mushrooms/{mix}/{image}.jpg", "get_surface",
     "One image of a mushroom's atlas; what textures=linked points to.", "image/jpeg", ""},
    {Endpoint::leaf_surface, "GET", "/v1/surfaces/leaves/{preset}/{image}.jpg", "get_leaf_surface",
     "One image of a leaf's atlas; what textures=linked points to.", "image/jpeg", ""},
    {Endpoint::tree_surface, "GET", "/v1/surfaces/trees/{preset}/{image}.jpg", "get_tree_surface",
     "One image of a tree's bark; what textures=linked points to, beside those of its leaves.",
     "image/jpeg", ""},
    {Endpoint::inspect, "POST", "/v1/inspect", "inspect",
     "Reads a GLB of Sporeprint and answers with the request that made it.", json, glb},
    {Endpoint::openapi, "GET", "/openapi.json", "openapi", "This document.", json, ""},
    {Endpoint::problem_type, "GET", "/problems/{type}", "get_problem_type",
     "What a type of problem means and what to do about it.", "text/html", ""},
    {Endpoint::livez, "GET", "/livez", "livez",
     "Whether the process lives; never queued behind work.", "text/plain", ""},
    {Endpoint::readyz, "GET", "/readyz", "readyz",
     "Whether it takes requests: atlas loaded, one mushroom grown, neither draining nor saturated.",
     "text/plain", ""},
    {Endpoint::metrics, "GET", "/metrics", "metrics", "Counters as Prometheus text.", "text/plain",
     ""},
}};

/// Whether a segment of a path fits one of a pattern; keeps what the {name} stands for.
bool fits(std::string_view segment, std::string_view pattern, std::vector<std::string>& captured) {
    if (!pattern.starts_with('{')) return segment == pattern;
    const std::string_view ending = pattern.substr(pattern.find('}') + 1);
    if (!segment.ends_with(ending) || (ending.empty() && segment.empty())) return false;
    captured.emplace_back(segment.substr(0, segment.size() - ending.size()));
    return true;
}

bool served_below(const Route& route) {
    return route.endpoint == Endpoint::livez || route.endpoint == Endpoint::readyz ||
           route.endpoint == Endpoint::metrics;
}

}  // namespace

bool is_generated(Endpoint endpoint) {
    switch (endpoint) {
        case Endpoint::page:
        case Endpoint::docs:
        case Endpoint::asset:
        case Endpoint::root:
        case Endpoint::species_list:
        case Endpoint::species:
        case Endpoint::mushroom_list:
        case Endpoint::mushroom_schema:
        case Endpoint::colony_list:
        case Endpoint::colony_schema:
        case Endpoint::leaf_list:
        case Endpoint::leaf_schema:
        case Endpoint::tree_list:
        case Endpoint::tree_schema:
        case Endpoint::openapi:
        case Endpoint::problem_type:
        case Endpoint::livez:
        case Endpoint::readyz:
        case Endpoint::metrics:
            return false;
        case Endpoint::mushroom_glb:
        case Endpoint::mushroom_json:
        case Endpoint::mushroom_post:
        case Endpoint::morph:
        case Endpoint::morph_post:
        case Endpoint::colony_glb:
        case Endpoint::colony_json:
        case Endpoint::colony_post:
        case Endpoint::leaf_glb:
        case Endpoint::leaf_json:
        case Endpoint::leaf_post:
        case Endpoint::tree_glb:
        case Endpoint::tree_json:
        case Endpoint::tree_post:
        case Endpoint::surface:
        case Endpoint::leaf_surface:
        case Endpoint::tree_surface:
        case Endpoint::inspect:
            return true;
    }
    return true;
}

std::span<const Route> routes() { return table; }

Match match_route(std::string_view method, std::span<const std::string> segments) {
    Match match;
    for (const Route& route : table) {
        if (served_below(route)) continue;
        const std::vector<std::string_view> pattern =
            split(std::string_view(route.pattern).substr(1), '/');
        if (pattern.size() != segments.size()) continue;
        std::vector<std::string> captured;
        bool fitting = true;
        for (std::size_t i = 0; fitting && i < pattern.size(); ++i)
            fitting = fits(segments[i], pattern[i], captured);
        if (!fitting) continue;
        match.allow =
            std::string_view(route.method) == "GET" ? "GET, HEAD, OPTIONS" : "POST, OPTIONS";
        if (method == route.method ||
            (method == "HEAD" && std::string_view(route.method) == "GET")) {
            match.route = &route;
            match.captured = std::move(captured);
        }
        return match;
    }
    return match;
}

std::string closest_route(std::span<const std::string> segments) {
    std::string requested;
    for (const std::string& segment : segments) (requested += '/') += segment;
    std::vector<std::string> candidates;
    for (const Route& route : table) {
        const std::vector<std::string_view> pattern =
            split(std::string_view(route.pattern).substr(1), '/');
        std::string candidate;
        for (std::size_t i = 0; i < pattern.size(); ++i) {
            candidate += '/';
            if (!pattern[i].starts_with('{')) {
                candidate += pattern[i];
                continue;
            }
            const std::string_view ending = pattern[i].substr(pattern[i].find('}') + 1);
            std::string stem = i < segments.size()
                                   ? segments[i]
                                   : std::string(pattern[i].substr(0, pattern[i].find('}') + 1));
            if (!ending.empty()) stem = stem.substr(0, stem.rfind('.'));
            (candidate += stem) += ending;
        }
        if (candidate != requested) candidates.push_back(std::move(candidate));
    }
    return std::string(closest(requested, candidates));
}

std::size_t longest_body(const Route& route) {
    switch (route.endpoint) {
        case Endpoint::inspect:
            return 64u << 20;
        case Endpoint::mushroom_post:
            return 4u << 20;  // images may be uploaded
        default:
            return 256u << 10;
    }
}

}  // namespace sporeprint::api
