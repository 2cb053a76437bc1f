#include "api/http/ranges.h"

#include <algorithm>
#include <cstdint>

#include "api/http/text.h"

namespace sporeprint::api {

namespace {

/// Returns the value of decimal digits, at most the largest std::size_t; nothing for other text.
std::optional<std::size_t> number_of(std::string_view digits) {
    if (digits.empty()) return std::nullopt;
    std::size_t value = 0;
    for (const char c : digits) {
        if (c < '0' || c > '9') return std::nullopt;
        const auto digit = static_cast<std::size_t>(c - '0');
        value = value > (SIZE_MAX - digit) / 10 ? SIZE_MAX : value * 10 + digit;
    }
    return value;
}

}  // namespace

std::optional<ByteRange> byte_range(std::string_view header, std::size_t size) {
    header = trimmed(header);
    const std::size_t equals = header.find('=');
    if (equals == std::string_view::npos || !same_word(header.substr(0, equals), "bytes"))
        return std::nullopt;
    const std::string_view range = trimmed(header.substr(equals + 1));
    const std::size_t dash = range.find('-');
    if (dash == std::string_view::npos) return std::nullopt;
    const std::string_view from = range.substr(0, dash), to = range.substr(dash + 1);
    const std::optional<std::size_t> last = number_of(to);
    if (from.empty()) {
        if (!last) return std::nullopt;
        const std::size_t count = std::min(*last, size);
        return ByteRange{size - count, count};
    }
    const std::optional<std::size_t> first = number_of(from);
    if (!first || (!to.empty() && (!last || *last < *first))) return std::nullopt;
    if (*first >= size) return ByteRange{};
    return ByteRange{*first, std::min(last.value_or(SIZE_MAX), size - 1) - *first + 1};
}

Body part_of(const Body& body, const ByteRange& range) {
    Body part;
    std::size_t begin = range.first, left = range.size;
    for (const Slice& slice : body) {
        if (begin >= slice.size) {
            begin -= slice.size;
            continue;
        }
        const std::size_t taken = std::min(slice.size - begin, left);
        if (taken == 0) break;
        part.emplace_back(slice.owner, slice.offset + begin, taken);
        begin = 0;
        left -= taken;
    }
    return part;
}

}  // namespace sporeprint::api
