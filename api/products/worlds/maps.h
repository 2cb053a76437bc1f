// Maps of worlds as PNG files, as raw numbers, and what they mean as JSON.
#pragma once

#include "api/http/errors.h"
#include "api/http/routes.h"
#include "api/products/context.h"
#include "core/params/value.h"
#include "core/world/world_params.h"

namespace sporeprint::api {

/// The files of a map.
enum class MapFile {
    png,  ///< grey, 16 bits; in the colours of Terrarium for the map of that name
    r16,  ///< the same numbers, low byte first
    json
};

/// Handles GET /v1/worlds/{world}/{time}/maps/{map}.png, .r16 and .json, and POST /v1/worlds/maps/{map}.png and .json.
template <MapFile File>
Plan plan_map(RouteCall& call);

/// Returns the schema of the query of a map.
[[nodiscard]] Value map_query_schema(const Atlas& atlas);

/// Returns the names of the maps that have a file.
[[nodiscard]] Value map_names(MapFile file);

/// Returns the schema of the JSON of a map.
[[nodiscard]] Value map_schema();

/// Returns what each map shows, by name, as the description of a world lists it.
///
/// world  URL of the world, without an ending
[[nodiscard]] Value map_list(const ResponseBuilder& responses, const std::string& world);

}  // namespace sporeprint::api
