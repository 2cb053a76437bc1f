// A request whose target is parsed and whose route is found: computed once, and used by the transport
// (limits, labels), by the check of signatures, by budgets and by Service::plan().
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "api/http/errors.h"
#include "api/http/message.h"
#include "api/http/query.h"
#include "api/http/routes.h"

namespace sporeprint::api {

/// What the head of a request determines. It does not depend on the body.
struct RoutedRequest {
    Target target;            ///< below the base path
    Match match;              ///< of the path and the method
    ValidationErrors errors;  ///< of the syntax of the target
    /// the final response, if the head alone decides it: 308, 400, 404, 405, 414, 415, or that to
    /// OPTIONS
    std::optional<Response> response;
    std::size_t most_body = 256u << 10;  ///< largest accepted body, bytes; 413 beyond

    /// Returns the URL template of the path, for the metrics; "UNKNOWN" if no route has this path.
    [[nodiscard]] std::string_view label() const {
        return match.pattern.empty() ? "UNKNOWN" : match.pattern;
    }
};

}  // namespace sporeprint::api
