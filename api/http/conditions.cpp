#include "api/http/conditions.h"

#include <algorithm>

#include "api/http/encoding.h"
#include "api/http/text.h"

namespace sporeprint::api {

std::optional<std::string> header_list(const Request& request, std::string_view name) {
    std::optional<std::string> list;
    for (const auto& [key, value] : request.headers) {
        if (!same_word(key, name)) continue;
        if (list)
            (*list += ", ") += value;
        else
            list = value;
    }
    return list;
}

bool accepts_gzip(const Request& request) {
    return accepts_gzip(header_list(request, "Accept-Encoding").value_or(""));
}

Conditions::Conditions(const Request& request)
    : match_(header_list(request, "If-Match")),
      none_match_(header_list(request, "If-None-Match")) {}

bool Conditions::match_fails(std::span<const std::string> current) const {
    if (!match_ || names_any(*match_)) return false;
    return std::none_of(current.begin(), current.end(), [&](const std::string& etag) {
        return names_etag(*match_, etag, Comparison::strong);
    });
}

const std::string* Conditions::unchanged(std::span<const std::string> current) const {
    if (!none_match_) return nullptr;
    const auto named = std::find_if(current.begin(), current.end(), [&](const std::string& etag) {
        return names_etag(*none_match_, etag);
    });
    return named == current.end() ? nullptr : &*named;
}

bool Conditions::none_match_any() const { return none_match_ && names_any(*none_match_); }

bool if_range_matches(const Request& request, std::string_view etag) {
    const std::optional<std::string> given = header_list(request, "If-Range");
    return !given || (etag.starts_with('"') && trimmed(*given) == etag);
}

}  // namespace sporeprint::api
