// Responses as text, for messages and indices of operators.
#pragma once

#include <string>

#include "api/http/message.h"
#include "core/params/value.h"

namespace sporeprint::api {

/// Returns the bytes of a body in one piece.
[[nodiscard]] std::string text_of(const Body& body);

/// Returns the problem of a response as a client would receive it; its status if it has none.
[[nodiscard]] Value problem_of(const Response& response);

}  // namespace sporeprint::api
