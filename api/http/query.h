// Parsing of a request target into path segments and query parameters, strictly percent-decoded.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/problems.h"

namespace sporeprint::api {

/// Longest target that is accepted, in bytes (414 beyond).
inline constexpr std::size_t longest_target = 4096;

struct Target {
    std::string path;                   ///< decoded, as requested
    std::vector<std::string> segments;  ///< of the path, each decoded after splitting
    /// Decoded pairs in order; '+' is a plus sign.
    std::vector<std::pair<std::string, std::string>> query;
};

/// Returns path and query of a target in origin form, or in absolute form, whose scheme and host
/// are ignored.
[[nodiscard]] std::string_view origin_form(std::string_view target);

/// Returns path and query below a base path. A target that does not begin with it is returned
/// unchanged, since some proxies remove the base path.
///
/// base  "" or "/a/b", without '/' at the end
[[nodiscard]] std::string_view below(std::string_view base, std::string_view target);

/// Parses a request target in origin form, or in absolute form, whose scheme and host are ignored.
///
/// problems  malformed escapes, control characters, invalid UTF-8, empty parameters and parameters
///           without '=' are added to these
[[nodiscard]] Target split_target(std::string_view target, std::vector<Problem>& problems);

/// Replaces each %XX. Returns false and leaves `out` unspecified if a '%' is not followed by two
/// hexadecimal digits.
[[nodiscard]] bool percent_decode(std::string_view text, std::string& out);

}  // namespace sporeprint::api
