// What the conditions of a request ask for: If-Match, If-None-Match and If-Range.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "api/http/message.h"

namespace sporeprint::api {

/// All header lines of that name, any case, as one comma-separated list; nothing if there is none.
[[nodiscard]] std::optional<std::string> header_list(const Request& request, std::string_view name);

/// Whether the Accept-Encoding lines of a request allow gzip.
[[nodiscard]] bool accepts_gzip(const Request& request);

/// If-Match and If-None-Match of a request. If-Match is evaluated first; a request for which it fails is answered 412 whatever
/// If-None-Match says. If-Modified-Since and If-Unmodified-Since are ignored, since no resource has a modification date.
///
/// source  [RFC9110] section 13.2.2
class Conditions {
  public:
    explicit Conditions(const Request& request);

    /// Whether there is an If-Match that names none of the current entity tags, compared strongly. `*` never fails: every
    /// resource that passes its checks either exists or can be made.
    [[nodiscard]] bool match_fails(std::span<const std::string> current) const;

    /// The first of the current entity tags that If-None-Match names, compared weakly; nullptr if it names none.
    [[nodiscard]] const std::string* unchanged(std::span<const std::string> current) const;

    /// Whether If-None-Match is `*`.
    [[nodiscard]] bool none_match_any() const;

  private:
    std::optional<std::string> match_, none_match_;
};

/// Whether If-Range lets a range of the representation with this strong entity tag be sent. True without If-Range; weak tags
/// and dates never match.
///
/// source  [RFC9110] section 13.1.5
[[nodiscard]] bool if_range_matches(const Request& request, std::string_view etag);

}  // namespace sporeprint::api
