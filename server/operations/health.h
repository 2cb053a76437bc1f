// A health check as small as a client can be, for containers that have no curl.
#pragma once

#include <string>

namespace sporeprint::server {

/// Asks for an http:// address and looks at the status alone.
///
/// why      when the result is false: a sentence for a person
/// returns  whether 200 came back within two seconds
[[nodiscard]] bool is_healthy(const std::string& url, std::string& why);

}  // namespace sporeprint::server
