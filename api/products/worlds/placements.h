// Placements of worlds: where trees, dead trunks and fruit bodies stand on a day, as CSV, JSON and a binary table.
#pragma once

#include "api/products/context.h"
#include "core/params/value.h"

namespace sporeprint::api {

/// The files of placements.
enum class PlacementFile { csv, json, bin };

/// Handles GET /v1/worlds/{world}/{time}/placements.csv, .json and .bin.
template <PlacementFile File>
Plan plan_placements(RouteCall& call);

/// Returns the schema of the query of placements.
[[nodiscard]] Value placement_query_schema(const Atlas& atlas);

/// Returns the schema of the JSON of placements.
[[nodiscard]] Value placement_schema();

}  // namespace sporeprint::api
