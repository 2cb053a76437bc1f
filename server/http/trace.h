// W3C Trace Context: the trace that a request belongs to, by which its log line can be found.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "api/http/message.h"

namespace sporeprint::server {

/// The identifiers of a traceparent header.
struct Trace {
    std::string_view trace_id;   ///< 32 digits 0-9, a-f, not all 0
    std::string_view parent_id;  ///< 16 such digits: the span of the caller
};

/// Parses the value of a traceparent header. Of versions after 00 the fields that all versions have
/// are read.
///
/// returns  views into the value; nothing if it is malformed, of version ff, or of version 00 with
///          extra fields
/// source   W3C Trace Context, section 3.2
[[nodiscard]] std::optional<Trace> trace_of(std::string_view traceparent);

/// Returns the trace of a request; nothing if it has no traceparent header or several.
///
/// returns  views into the headers
[[nodiscard]] std::optional<Trace> trace_in(std::span<const api::Header> headers);

}  // namespace sporeprint::server
