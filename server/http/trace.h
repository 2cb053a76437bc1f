// W3C Trace Context: which trace a request belongs to, so that its line in the log can be found from there.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "api/http/message.h"

namespace sporeprint::server {

struct Trace {
    std::string_view trace_id;   ///< 32 of 0-9, a-f, not all 0
    std::string_view parent_id;  ///< 16 likewise: the span that has asked
};

/// What a traceparent says; nothing when it is malformed, of version ff, or of version 00 with more behind. Of later versions
/// the parts that all have in common.
///
/// source  W3C Trace Context, section 3.2
[[nodiscard]] std::optional<Trace> trace_of(std::string_view traceparent);

/// That of a request; nothing when it has none, or several. Points into the headers.
[[nodiscard]] std::optional<Trace> trace_in(std::span<const api::Header> headers);

}  // namespace sporeprint::server
