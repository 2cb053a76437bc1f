// What keeps each species of a world from fruiting at a place on a day: why there is no mushroom here.
#pragma once

#include "api/products/context.h"
#include "core/params/value.h"

namespace sporeprint::api {

/// Handles GET /v1/worlds/{world}/{time}/limits.json.
Plan plan_limits(RouteCall& call);

/// Returns the schema of the query of limits.
[[nodiscard]] Value limits_query_schema(const Atlas& atlas);

/// Returns the schema of the JSON of limits.
[[nodiscard]] Value limits_schema();

}  // namespace sporeprint::api
