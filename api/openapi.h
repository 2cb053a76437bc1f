// OpenAPI 3.1 from the table of routes and the descriptions of parameters; nothing is told twice.
#pragma once

#include <string_view>

#include "core/atlas/atlas.h"
#include "core/params/value.h"

namespace sporeprint::api {

/// The whole document.
///
/// is_signed  what is made is answered to signed addresses only
/// base_path  path before /v1, as clients see it
[[nodiscard]] Value openapi(const Atlas& atlas, std::string_view version, bool is_signed = false,
                            std::string_view base_path = {});

/// JSON Schema of a mushroom's query parameters, nested: the page's controls.
[[nodiscard]] Value mushroom_schema();

/// The same for a colony.
[[nodiscard]] Value colony_schema();

/// The same for a leaf: what a preset brings has no default, but "x-default-from": "preset".
[[nodiscard]] Value leaf_schema();

/// The JSON Schema document of the query parameters of a tree.
[[nodiscard]] Value tree_schema();

}  // namespace sporeprint::api
