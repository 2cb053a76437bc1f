// The conditions of a request: If-Match, If-None-Match and If-Range.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "api/http/message.h"

namespace sporeprint::api {

/// Returns all header lines with this name, in any case, as one comma-separated list; nothing if
/// there is none.
[[nodiscard]] std::optional<std::string> header_list(const Request& request, std::string_view name);

/// Returns true if the Accept-Encoding lines of a request allow gzip.
[[nodiscard]] bool accepts_gzip(const Request& request);

/// If-Match and If-None-Match of a request. If-Match is evaluated first; if it fails, the response
/// is 412 whatever If-None-Match says. If-Modified-Since and If-Unmodified-Since are ignored, since
/// no resource has a modification date.
///
/// source  [RFC9110] section 13.2.2
class Conditions {
  public:
    explicit Conditions(const Request& request);

    /// Returns true if there is an If-Match that names none of the current entity tags (strong
    /// comparison). `*` never fails: every resource that passes its checks either exists or can be
    /// generated.
    [[nodiscard]] bool match_fails(std::span<const std::string> current) const;

    /// Returns the first current entity tag that If-None-Match names (weak comparison); nullptr if
    /// it names none.
    [[nodiscard]] const std::string* unchanged(std::span<const std::string> current) const;

    /// Returns true if If-None-Match is `*`.
    [[nodiscard]] bool none_match_any() const;

  private:
    std::optional<std::string> match_, none_match_;
};

/// Returns true if If-Range permits sending a range of the representation with this strong entity
/// tag. True without If-Range; weak tags and dates never match.
///
/// source  [RFC9110] section 13.1.5
[[nodiscard]] bool if_range_matches(const Request& request, std::string_view etag);

}  // namespace sporeprint::api
