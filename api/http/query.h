// A request target taken apart: path segments and query parameters, percent-decoded strictly.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/problems.h"

namespace sporeprint::api {

/// Longest target accepted, in bytes (414 beyond).
inline constexpr std::size_t longest_target = 4096;

struct Target {
    std::string path;                   ///< decoded, as asked
    std::vector<std::string> segments;  ///< of the path, each decoded after splitting
    std::vector<std::pair<std::string, std::string>>
        query;  ///< decoded pairs in order; '+' is a plus sign
};

/// Path and query of a target in origin form, or in absolute form, whose scheme and host are passed over.
[[nodiscard]] std::string_view origin_form(std::string_view target);

/// Path and query below a base path: without it where the target begins with it, as they are elsewhere, since some proxies take the
/// base path off.
///
/// base  "" or "/a/b", no '/' at its end
[[nodiscard]] std::string_view below(std::string_view base, std::string_view target);

/// Takes a request target apart: origin form, or absolute form whose scheme and host are passed over.
///
/// problems  malformed escapes, control characters, bytes that are no UTF-8, empty parameters and parameters without '='
[[nodiscard]] Target split_target(std::string_view target, std::vector<Problem>& problems);

/// Replaces each %XX. Returns false, and leaves `out` unspecified, if a '%' is not followed by two hexadecimal digits.
[[nodiscard]] bool percent_decode(std::string_view text, std::string& out);

}  // namespace sporeprint::api
