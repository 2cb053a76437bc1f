// The routes of worlds.
#pragma once

#include "api/http/routes.h"

namespace sporeprint::api {

extern const RouteGroup world_routes;

}  // namespace sporeprint::api
