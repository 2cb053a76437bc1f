// Terrains that clients upload for worlds to stand on: under /v1/terrains.
#pragma once

#include "api/http/routes.h"

namespace sporeprint::api {

extern const RouteGroup terrain_routes;

}  // namespace sporeprint::api
