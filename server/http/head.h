// The head of an HTTP/1.1 request: a strict scanner with fixed limits, run before any library
// parses the request.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "api/http/message.h"

namespace sporeprint::server {

inline constexpr std::size_t longest_head = 16 * 1024;  ///< bytes, request line included (431)
inline constexpr std::size_t longest_uri = 4096;        ///< bytes (414)
inline constexpr std::size_t most_headers = 64;         ///< lines (431)
inline constexpr std::size_t longest_method = 32;       ///< bytes (400)

/// The request line and headers of a request.
struct Head {
    std::string method;
    std::string target;  ///< as received
    std::vector<api::Header> headers;
    std::optional<std::uint64_t> content_length;
    bool keep_alive = true;
    bool expects_continue = false;
};

/// The outcome of scan_head().
struct Scan {
    enum class State { incomplete, complete, refused };
    State state = State::incomplete;
    std::size_t used = 0;  ///< if complete: bytes of the head with its empty line
    Head head;             ///< if refused: the part parsed so far, for the log
    int status = 0;        ///< if refused
    std::string detail;    ///< if refused: a message for the client
};

/// Scans the bytes received so far.
///
/// bytes    start at the first byte of a request and may extend beyond its head
/// returns  incomplete while the empty line is missing and no error is found; refused with 400
///          (malformed, bare line feed, folded or repeated framing headers, other version), 411
///          (any Transfer-Encoding), 414, 415 (any Content-Encoding) or 431. Any token is accepted
///          as a method; the router refuses unsupported ones (405)
/// cost     O(bytes), of which at most longest_head are read
/// source   RFC 9112 sections 2 to 6; differs: none of the leniency that it permits a server
[[nodiscard]] Scan scan_head(std::string_view bytes);

/// Returns true if the comma-separated `list` contains `token`, ignoring case.
[[nodiscard]] bool lists_token(std::string_view list, std::string_view token);

/// Returns true if two header names or tokens are equal, ignoring case.
[[nodiscard]] bool same_token(std::string_view a, std::string_view b);

}  // namespace sporeprint::server
