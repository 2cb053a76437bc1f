// Photographs that clients upload to be traced: POST, GET and DELETE under /v1/photos.
#pragma once

#include "api/http/routes.h"

namespace sporeprint::api {

/// The path of a photograph. Its name is a secret, which no log may contain.
inline constexpr const char* photo_pattern = "/v1/photos/{photo}.jpg";

extern const RouteGroup photo_routes;

}  // namespace sporeprint::api
