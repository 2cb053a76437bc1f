#include "server/http/head.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace sporeprint::server {

namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool is_token(std::string_view text) {
    constexpr std::string_view punctuation = "!#$%&'*+-.^_`|~";
    return !text.empty() && std::all_of(text.begin(), text.end(), [&](char c) {
        return (c >= '0' && c <= '9') || (lower(c) >= 'a' && lower(c) <= 'z') ||
               punctuation.find(c) != std::string_view::npos;
    });
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
}

/// Returns true if the text has no control characters other than tabs.
bool is_field_value(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte == '\t' || (byte >= 0x20 && byte != 0x7f);
    });
}

bool is_visible(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte > 0x20 && byte < 0x7f;
    });
}

bool is_version(std::string_view text) {
    const auto digit = [](char c) { return c >= '0' && c <= '9'; };
    return text.size() == 8 && text.starts_with("HTTP/") && digit(text[5]) && text[6] == '.' &&
           digit(text[7]);
}

Scan refused(Scan scan, int status, std::string detail) {
    scan.state = Scan::State::refused;
    scan.status = status;
    scan.detail = std::move(detail);
    return scan;
}

Scan too_long_uri(Scan scan) {
    return refused(std::move(scan), 414,
                   "the address is longer than " + std::to_string(longest_uri) + " bytes");
}

/// Splits a request line into method and target, and returns the version; empty if the line is
/// malformed.
std::string_view split_request_line(std::string_view line, Head& head) {
    const std::size_t first = line.find(' ');
    if (first == std::string_view::npos) return {};
    head.method = line.substr(0, first);
    const std::size_t second = line.find(' ', first + 1);
    if (second == std::string_view::npos) return {};
    head.target = line.substr(first + 1, second - first - 1);
    return line.substr(second + 1);
}

/// Status and message of a refusal; status 0 if there is none.
using Refusal = std::pair<int, std::string>;

/// Reads the header lines, each of which ends in CR LF.
Refusal read_fields(std::string_view lines, Head& head) {
    while (!lines.empty()) {
        const std::size_t stop = lines.find("\r\n");
        const std::string_view field = lines.substr(0, stop);
        lines.remove_prefix(stop + 2);
        const std::size_t colon = field.find(':');
        if (colon == std::string_view::npos || !is_token(field.substr(0, colon)))
            return {400, "a header line is malformed"};
        const std::string_view value = trimmed(field.substr(colon + 1));
        if (!is_field_value(value)) return {400, "a header holds control characters"};
        if (head.headers.size() == most_headers)
            return {431, "more than " + std::to_string(most_headers) + " header lines"};
        head.headers.emplace_back(field.substr(0, colon), value);
    }
    return {0, {}};
}

/// Reads the headers that frame the body and the connection.
///
/// returns  status and message if they are contradictory or unsupported; otherwise status 0
Refusal read_framing(Head& head) {
    for (const auto& [name, value] : head.headers) {
        if (same_token(name, "Transfer-Encoding"))
            return {411, "send Content-Length instead of Transfer-Encoding"};
        if (same_token(name, "Content-Encoding"))
            return {415, "bodies with a Content-Encoding are not taken; send it plain"};
        if (same_token(name, "Content-Length")) {
            std::uint64_t length = 0;
            const char* const end = value.data() + value.size();
            const auto [stop, error] = std::from_chars(value.data(), end, length);
            const bool all_digits = !value.empty() && value[0] != '-' && stop == end;
            if (all_digits && error == std::errc::result_out_of_range)
                length = UINT64_MAX;
            else if (!all_digits || error != std::errc())
                return {400, "Content-Length is not a whole number"};
            if (head.content_length) return {400, "Content-Length is given more than once"};
            head.content_length = length;
        } else if (same_token(name, "Connection")) {
            if (lists_token(value, "close"))
                head.keep_alive = false;
            else if (lists_token(value, "keep-alive"))
                head.keep_alive = true;
        } else if (same_token(name, "Expect")) {
            head.expects_continue = head.expects_continue || same_token(value, "100-continue");
        }
    }
    return {0, {}};
}

}  // namespace

bool same_token(std::string_view a, std::string_view b) {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(),
                                              [](char x, char y) { return lower(x) == lower(y); });
}

bool lists_token(std::string_view list, std::string_view token) {
    while (!list.empty()) {
        const std::size_t comma = list.find(',');
        if (same_token(trimmed(list.substr(0, comma)), token)) return true;
        if (comma == std::string_view::npos) break;
        list.remove_prefix(comma + 1);
    }
    return false;
}

Scan scan_head(std::string_view bytes) {
    Scan scan;
    std::size_t begin = 0;
    while (bytes.substr(begin, 2) == "\r\n") begin += 2;  // empty lines before a request: RFC 9112
    const std::string_view all = bytes.substr(0, longest_head);
    const std::size_t end = all.find("\r\n\r\n", begin);
    const bool complete = end != std::string_view::npos;
    std::string_view rest = all.substr(std::min(begin, all.size()),
                                       complete ? end + 2 - begin : std::string_view::npos);

    for (std::size_t i = 0; i < rest.size(); ++i)
        if (rest[i] == '\n' && (i == 0 || rest[i - 1] != '\r'))
            return refused(std::move(scan), 400, "a line of the head does not end in CR LF");

    const std::size_t line_end = rest.find("\r\n");
    const std::string_view line = rest.substr(0, line_end);
    const std::string_view version = split_request_line(line, scan.head);
    if (line_end == std::string_view::npos) {
        if (line.size() > longest_uri + 32) return too_long_uri(std::move(scan));
        return scan;
    }
    if (scan.head.target.size() > longest_uri) {
        scan.head.target.resize(longest_uri);
        return too_long_uri(std::move(scan));
    }
    if (!is_token(scan.head.method) || scan.head.method.size() > longest_method ||
        !is_visible(scan.head.target) || scan.head.target.empty() || !is_version(version))
        return refused(std::move(scan), 400, "the request line is malformed");
    if (version != "HTTP/1.1" && version != "HTTP/1.0")
        return refused(std::move(scan), 400, "HTTP/1.1 is spoken here");
    if (!complete) {
        if (bytes.size() >= longest_head)
            return refused(std::move(scan), 431,
                           "the header is longer than " + std::to_string(longest_head) + " bytes");
        return scan;
    }
    const std::string_view target = scan.head.target;
    if (target.front() != '/' && target != "*" && !target.starts_with("http://") &&
        !target.starts_with("https://"))
        return refused(std::move(scan), 400, "the request target is not a path");
    scan.head.keep_alive = version == "HTTP/1.1";

    rest.remove_prefix(line_end + 2);
    if (auto [status, detail] = read_fields(rest, scan.head); status != 0)
        return refused(std::move(scan), status, std::move(detail));
    if (auto [status, detail] = read_framing(scan.head); status != 0)
        return refused(std::move(scan), status, std::move(detail));
    scan.used = end + 4;
    scan.state = Scan::State::complete;
    return scan;
}

}  // namespace sporeprint::server
