// Byte ranges: parsing of Range headers, and parts of bodies.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "core/bytes.h"

namespace sporeprint::api {

struct ByteRange {
    std::size_t first = 0;
    std::size_t size = 0;  ///< 0 if no byte of the body is in the range: 416
};

/// Returns the range that a Range header requests of a body of `size` bytes: "bytes=a-b",
/// "bytes=a-" or "bytes=-n".
///
/// returns  nothing if the header must be ignored: several ranges, another unit, or malformed
/// source   [RFC9110] section 14.1.2
[[nodiscard]] std::optional<ByteRange> byte_range(std::string_view header, std::size_t size);

/// Returns the bytes of a range as slices of the same memory; nothing is copied.
[[nodiscard]] Body part_of(const Body& body, const ByteRange& range);

}  // namespace sporeprint::api
