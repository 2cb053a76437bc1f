// Seasons of worlds: how many fruit bodies of each species stand on each day of a year, beside the weather.
#pragma once

#include "api/products/context.h"
#include "core/params/value.h"

namespace sporeprint::api {

/// Handles GET /v1/worlds/{world}/season.json.
Plan plan_season(RouteCall& call);

/// Returns the schema of the query of a season.
[[nodiscard]] Value season_query_schema(const Atlas& atlas);

/// Returns the schema of the JSON of a season.
[[nodiscard]] Value season_schema();

}  // namespace sporeprint::api
