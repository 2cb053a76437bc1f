// A request for a part of a world, in a URL (the world and the time in the path, all else in the query) or in a body,
// which may also edit the world.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/http/errors.h"
#include "api/products/context.h"
#include "api/products/worlds/parts.h"
#include "api/products/worlds/worlds.h"
#include "core/params/query.h"
#include "core/params/reader.h"

namespace sporeprint::api {

/// Largest body of a request for a part of a world, bytes: masks in base64, and some text.
inline constexpr std::size_t most_part_body = 6u << 20;

/// What a request for a part of a world says.
struct PartRequest {
    WorldRequest world;
    std::string time;
    std::vector<std::pair<std::string, std::string>> query;  ///< of a URL
    std::optional<Value> body;                               ///< what else a body has
};

/// Reads the world and the time of a request: the first two {names} of the path of a GET, or `world`, `time`, `ecology`,
/// `founders`, `masks` and `v` of a body.
[[nodiscard]] PartRequest read_part(const RouteCall& call, ValidationErrors& errors);

/// Reads all else.
template <class Params>
void read_params(const PartRequest& part, Params& params, ValidationErrors& errors) {
    std::vector<Problem> problems;
    if (part.body)
        sporeprint::read(*part.body, params, Info{.name = ""}, "", problems);
    else
        read_query(part.query, params, problems);
    errors.add(400, problems);
}

/// Ends the reading of a request: of one with a body, errors name places in the body, and a query is an error.
void finish_reading(const RouteCall& call, ValidationErrors& errors);

/// Returns the schema of the body of a request for a part of a world.
///
/// params  schema of the query of the same part
[[nodiscard]] Value part_body_schema(const Atlas& atlas, Value params);

/// Returns an example of such a body.
[[nodiscard]] Value part_body_example(const Atlas& atlas);

}  // namespace sporeprint::api
