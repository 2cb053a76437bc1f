// What a file that is made in advance says of itself.
#pragma once

#include <string_view>

#include "api/http/message.h"
#include "core/params/value.h"

namespace sporeprint::api {

/// Returns `asset.extras` of a GLB file: effective parameters, bounds, counts. Null for other files.
[[nodiscard]] Value labels_of(const Body& body);

/// Returns the extension of the last segment of a path, without its dot; empty if there is none.
///
/// target  path and query
[[nodiscard]] std::string_view extension_of(std::string_view target);

}  // namespace sporeprint::api
