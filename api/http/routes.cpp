#include "api/http/routes.h"

#include <algorithm>
#include <utility>

#include "api/http/text.h"
#include "core/params/messages.h"

namespace sporeprint::api {

namespace {

/// Returns true if a path segment matches a segment of a pattern, and appends the text of its
/// {name}.
bool fits(std::string_view segment, std::string_view pattern, std::vector<std::string>& captured) {
    if (!pattern.starts_with('{')) return segment == pattern;
    const std::string_view ending = pattern.substr(pattern.find('}') + 1);
    if (!segment.ends_with(ending) || (ending.empty() && segment.empty())) return false;
    captured.emplace_back(segment.substr(0, segment.size() - ending.size()));
    return true;
}

bool is_image(const Route* route) { return route->kind == RouteKind::image; }

}  // namespace

bool is_cached(const Route& route) {
    return route.kind == RouteKind::product || route.kind == RouteKind::image;
}

bool is_generated(const Route& route) {
    return is_cached(route) || route.kind == RouteKind::upload;
}

std::vector<std::string_view> body_types(const Route& route) {
    if (*route.body_type == '\0') return {};
    return split(route.body_type, ',');
}

RouteTable::RouteTable(std::vector<RouteGroup> groups) : groups_(std::move(groups)) {
    for (const RouteGroup& group : groups_)
        for (const Route& route : group.routes) routes_.push_back(&route);
    // Images follow the products to which they belong, in the order of the OpenAPI document.
    const auto is_product = [](const Route* route) { return route->kind == RouteKind::product; };
    const auto end = std::find_if(routes_.rbegin(), routes_.rend(), is_product).base();
    std::stable_partition(routes_.begin(), std::find_if_not(end, routes_.end(), is_image),
                          [](const Route* route) { return !is_image(route); });
}

Match RouteTable::match(std::string_view method, std::span<const std::string> segments) const {
    Match match;
    for (const Route* const route : routes_) {
        if (route->kind == RouteKind::health) continue;
        // After the first fitting pattern only its other methods are of interest.
        if (!match.pattern.empty() && match.pattern != route->pattern) continue;
        const std::vector<std::string_view> pattern =
            split(std::string_view(route->pattern).substr(1), '/');
        if (pattern.size() != segments.size()) continue;
        std::vector<std::string> captured;
        bool fitting = true;
        for (std::size_t i = 0; fitting && i < pattern.size(); ++i)
            fitting = fits(segments[i], pattern[i], captured);
        if (!fitting) continue;
        const bool is_get = std::string_view(route->method) == "GET";
        match.pattern = route->pattern;
        (match.allow += route->method) += is_get ? ", HEAD, " : ", ";
        if (method == route->method || (method == "HEAD" && is_get)) {
            match.route = route;
            match.captured = std::move(captured);
        }
    }
    if (!match.allow.empty()) match.allow += "OPTIONS";
    return match;
}

std::string RouteTable::closest(std::span<const std::string> segments) const {
    std::string requested;
    for (const std::string& segment : segments) (requested += '/') += segment;
    std::vector<std::string> candidates;
    for (const Route* const route : routes_) {
        const std::vector<std::string_view> pattern =
            split(std::string_view(route->pattern).substr(1), '/');
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
    return std::string(sporeprint::closest(requested, candidates));
}

}  // namespace sporeprint::api
