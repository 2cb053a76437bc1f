// The schemas of the OpenAPI document, from the descriptions of parameters: what is taken, what is answered.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "api/http/routes.h"
#include "core/atlas/atlas.h"
#include "core/params/value.h"

namespace sporeprint::api {

[[nodiscard]] Value object(std::initializer_list<Value::Member> members);

/// {"$ref":"#/components/…"}
[[nodiscard]] Value reference(std::string_view where);

/// {"type":…}
[[nodiscard]] Value typed(const char* type);

/// A species for examples, and a second one.
[[nodiscard]] std::string example_id(const Atlas& atlas);
[[nodiscard]] std::string other_id(const Atlas& atlas);

/// /components/schemas: what is answered. Whatever is always there is required; nothing has a default.
[[nodiscard]] Value component_schemas();

/// /components/requestBodies. Each schema stands in its body and not in /components/schemas: there, generators of types take
/// properties with a default to be always there, and a minimal body would not compile.
[[nodiscard]] Value component_bodies(const Atlas& atlas);

/// The request body of a route that takes one.
[[nodiscard]] Value taken_body(const Route& route);

/// The schema of what a route answers with 200.
[[nodiscard]] Value response_schema(Endpoint endpoint);

/// The nested schema of the query that a route takes; without properties where it takes none.
[[nodiscard]] Value query_schema(Endpoint endpoint);

}  // namespace sporeprint::api
