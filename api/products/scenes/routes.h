// The routes of uploaded scenes: under /v1/scenes.
#pragma once

#include "api/http/routes.h"

namespace sporeprint::api {

extern const RouteGroup scene_routes;

}  // namespace sporeprint::api
