// The routes of worlds.
#pragma once

#include "api/http/routes.h"

namespace sporeprint::api {

extern const RouteGroup world_routes;

/// Return the OpenAPI parameters of {world} and {time}.
[[nodiscard]] Value world_path_parameter(const Atlas& atlas);
[[nodiscard]] Value time_path_parameter();

}  // namespace sporeprint::api
