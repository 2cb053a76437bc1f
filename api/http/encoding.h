// ETags and gzip: what makes a response a cacheable representation.
#pragma once

#include <string>
#include <string_view>

#include "core/bytes.h"

namespace sporeprint::api {

/// Returns 32 hexadecimal digits: the XXH3-128 of a text, or of the concatenated slices of a body.
[[nodiscard]] std::string digest_of(std::string_view text);
[[nodiscard]] std::string digest_of(const Body& body);

/// Returns the strong entity tag, with its quotes, of the resource that `key` (canonical text,
/// generator version, templates) names.
[[nodiscard]] std::string etag_of(std::string_view key);

/// Returns the entity tag of the gzip variant: "…" becomes "…-gz".
[[nodiscard]] std::string gzip_etag(std::string_view etag);

/// How entity tags are compared: a weak tag never matches in strong comparison, and matches the
/// strong tag with the same text in weak comparison.
enum class Comparison { weak, strong };

/// Returns true if a list of entity tags, as in If-None-Match and If-Match, names the strong tag
/// `etag`; '*' names none.
[[nodiscard]] bool names_etag(std::string_view list, std::string_view etag,
                              Comparison comparison = Comparison::weak);

/// Returns true if a list of entity tags is '*'.
[[nodiscard]] bool names_any(std::string_view list);

/// Returns true if an Accept-Encoding header allows gzip (by name, "x-gzip" or '*') with a quality
/// above 0.
[[nodiscard]] bool accepts_gzip(std::string_view accept_encoding);

/// Returns a body compressed by gzip at level 6 without name and time: equal input gives equal
/// bytes.
///
/// throws  std::bad_alloc
[[nodiscard]] Slice gzip(const Body& body);

}  // namespace sporeprint::api
