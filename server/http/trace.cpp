#include "server/http/trace.h"

#include <algorithm>

#include "server/http/head.h"

namespace sporeprint::server {

namespace {

constexpr std::size_t length = 55;  ///< "00-", 32 digits, '-', 16 digits, '-', 2 digits

bool is_hex(std::string_view text) {
    return std::all_of(text.begin(), text.end(),
                       [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

bool is_zero(std::string_view text) { return text.find_first_not_of('0') == text.npos; }

}  // namespace

std::optional<Trace> trace_of(std::string_view text) {
    if (text.size() < length || text[2] != '-' || text[35] != '-' || text[52] != '-')
        return std::nullopt;
    const std::string_view version = text.substr(0, 2);
    const Trace trace{text.substr(3, 32), text.substr(36, 16)};
    const bool valid = is_hex(version) && is_hex(trace.trace_id) && is_hex(trace.parent_id) &&
                       is_hex(text.substr(53, 2)) && !is_zero(trace.trace_id) &&
                       !is_zero(trace.parent_id);
    const bool ends = text.size() == length || (version != "00" && text[length] == '-');
    return valid && ends && version != "ff" ? std::optional(trace) : std::nullopt;
}

std::optional<Trace> trace_in(std::span<const api::Header> headers) {
    std::string_view value;
    int found = 0;
    for (const auto& [name, text] : headers)
        if (same_token(name, "traceparent")) {
            value = text;
            ++found;
        }
    return found == 1 ? trace_of(value) : std::nullopt;
}

}  // namespace sporeprint::server
