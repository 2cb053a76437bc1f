// Photographs that clients upload to be traced: POST, GET and DELETE under /v1/photos.
#pragma once

#include "api/http/routes.h"

namespace sporeprint::api {

/// The path of a photograph. Its name is a secret, which no log may contain.
inline constexpr const char* photo_pattern = "/v1/photos/{photo}.jpg";

/// What is said of a name that no photograph has.
inline constexpr const char* photo_is_gone =
    "there is no photograph of this name, or no longer; upload it again";

extern const RouteGroup photo_routes;

}  // namespace sporeprint::api
