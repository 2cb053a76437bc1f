// Species of users: POST, GET, PUT and DELETE under /v1/library, and the tokens of their owners.
#pragma once

#include "api/http/routes.h"

namespace sporeprint::api {

extern const RouteGroup library_routes, token_routes;

}  // namespace sporeprint::api
