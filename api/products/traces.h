// POST /v1/traces: the species of a photographed mushroom; POST /v1/outlines/check: whether an outline can be
// grown.
#pragma once

#include "api/http/routes.h"

namespace sporeprint::api {

extern const RouteGroup trace_routes;

}  // namespace sporeprint::api
