// A minimal HTTP client for health checks, for containers without curl.
#pragma once

#include <string>

namespace sporeprint::server {

/// Requests an http:// URL and checks the status.
///
/// reason      set to a message for the operator if the result is false
/// returns  true if the status is 200; connecting, sending and receiving may take two seconds each
[[nodiscard]] bool is_healthy(const std::string& url, std::string& reason);

}  // namespace sporeprint::server
