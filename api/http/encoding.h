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

/// How entity tags are compared: weak tags are equal to nothing strongly, and to the strong tag of the same text weakly.
enum class Comparison { weak, strong };

/// Whether a list of entity tags, as If-None-Match and If-Match have it, names the strong tag `etag`; '*' names none.
[[nodiscard]] bool names_etag(std::string_view list, std::string_view etag,
                              Comparison comparison = Comparison::weak);

/// Whether a list of entity tags is '*'.
[[nodiscard]] bool names_any(std::string_view list);

/// Whether an Accept-Encoding header allows gzip (by name, "x-gzip" or '*') with a quality above 0.
[[nodiscard]] bool accepts_gzip(std::string_view accept_encoding);

/// gzip at level 6 with no name and no time: equal input, equal bytes.
///
/// throws  std::bad_alloc
[[nodiscard]] Slice gzip(const Body& body);

}  // namespace sporeprint::api
