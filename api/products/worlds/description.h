// What a world is like, in words and numbers: the list of presets, the description of one world, its weather.
#pragma once

#include "api/products/context.h"
#include "core/params/value.h"

namespace sporeprint::api {

/// Handles GET /v1/worlds/{world}.json.
Plan plan_description(RouteCall& call);

/// Handles GET /v1/worlds/{world}/weather.json.
Plan plan_weather(RouteCall& call);

/// Returns the schema of the query of the weather.
[[nodiscard]] Value weather_query_schema(const Atlas& atlas);

/// Returns the list of all presets of worlds.
[[nodiscard]] Value world_list(const Atlas& atlas);

}  // namespace sporeprint::api
