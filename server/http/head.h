// The head of an HTTP/1.1 request, scanned strictly and within bounds before any library sees it.
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

struct Head {
    std::string method;
    std::string target;  ///< as received
    std::vector<api::Header> headers;
    std::optional<std::uint64_t> content_length;
    bool keep_alive = true;
    bool expects_continue = false;
};

struct Scan {
    enum class State { incomplete, complete, refused };
    State state = State::incomplete;
    std::size_t used = 0;  ///< bytes of the head with its empty line, when complete
    Head head;             ///< when refused: as much as was understood, for the log
    int status = 0;        ///< when refused
    std::string detail;    ///< when refused: a sentence for the client
};

/// Scans the bytes received so far.
///
/// bytes    from the first byte of a request on; may hold more than its head
/// returns  incomplete while the empty line is missing and nothing is wrong yet; refused with
///          400 (malformed, a bare line feed, folded or repeated framing headers, another
///          version), 411 (any Transfer-Encoding), 414, 415 (any Content-Encoding), 431. Any token
///          is a method: which are answered, the route says (405)
/// cost     O(bytes), at most longest_head of them
/// source   RFC 9112 sections 2 to 6; differs: a server may be lenient in many places, this is not
[[nodiscard]] Scan scan_head(std::string_view bytes);

/// Whether the comma-separated `list` holds `token`, capitals ignored.
[[nodiscard]] bool lists_token(std::string_view list, std::string_view token);

/// Whether two header names or tokens are the same, capitals ignored.
[[nodiscard]] bool same_token(std::string_view a, std::string_view b);

}  // namespace sporeprint::server
