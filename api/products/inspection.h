// POST /v1/inspect: the parameters and statistics of a GLB file of this service.
#pragma once

#include "api/http/routes.h"

namespace sporeprint::api {

extern const RouteGroup inspection_routes;

}  // namespace sporeprint::api
