// ETags and gzip: how one answer becomes a representation that a client may keep.
#pragma once

#include <string>
#include <string_view>

#include "core/bytes.h"

namespace sporeprint::api {

/// 32 hexadecimal digits of the XXH3-128 of a text, or of a body as if it were one.
[[nodiscard]] std::string digest_of(std::string_view text);
[[nodiscard]] std::string digest_of(const Body& body);

/// Strong entity tag, with its quotes, of what `key` (canonical text, generator version, templates) names.
[[nodiscard]] std::string etag_of(std::string_view key);

/// The tag of the gzip variant: "…" becomes "…-gz".
[[nodiscard]] std::string gzip_etag(std::string_view etag);

/// Whether an If-None-Match header names `etag`: lists and weak tags (compared weakly), not '*'.
[[nodiscard]] bool names_etag(std::string_view if_none_match, std::string_view etag);

/// Whether an If-None-Match header is '*'.
[[nodiscard]] bool names_any(std::string_view if_none_match);

/// Whether an Accept-Encoding header allows gzip (by name, "x-gzip" or '*') with a quality above 0.
[[nodiscard]] bool accepts_gzip(std::string_view accept_encoding);

/// gzip at level 6 with no name and no time: equal input, equal bytes.
///
/// throws  std::bad_alloc
[[nodiscard]] Slice gzip(const Body& body);

}  // namespace sporeprint::api
