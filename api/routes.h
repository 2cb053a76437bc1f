// The table of all routes: one row for each product or group of documents.
#pragma once

#include "api/http/routes.h"

namespace sporeprint::api {

/// Returns the table of all routes, which is built at the first call.
[[nodiscard]] const RouteTable& route_table();

}  // namespace sporeprint::api
