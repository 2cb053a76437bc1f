// The OpenAPI 3.1 document, built from the table of routes and the descriptions of parameters.
#pragma once

#include <string_view>

#include "api/http/routes.h"
#include "core/params/value.h"

namespace sporeprint::api {

/// Returns the OpenAPI document.
///
/// version  of the service
[[nodiscard]] Value openapi(const DocumentInputs& inputs, std::string_view version);

}  // namespace sporeprint::api
