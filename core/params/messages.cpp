#include "core/params/messages.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <vector>

namespace sporeprint {
namespace {

template <class T>
std::string shortest(T value) {
    if (value == T{0}) return "0";
    if (!(value >= std::numeric_limits<T>::lowest() && value <= std::numeric_limits<T>::max()))
        return value > 0 ? "inf" : value < 0 ? "-inf" : "nan";
    char text[64];
    constexpr T exact = T{1} / std::numeric_limits<T>::epsilon();  // integers below are exact
    const bool as_integer =
        value > -exact && value < exact && value == static_cast<T>(static_cast<long long>(value));
    const auto end =
        as_integer ? std::to_chars(text, text + sizeof text, static_cast<long long>(value)).ptr
                   : std::to_chars(text, text + sizeof text, value).ptr;
    std::string out(text, end);
    // "1e-07" and "1e+20" become "1e-7" and "1e20": shorter, and no '+' that a query would decode
    // as a space.
    if (const std::size_t e = out.find('e'); e != std::string::npos) {
        std::size_t digits = e + 1;
        if (out[digits] == '+') out.erase(digits, 1);
        if (out[digits] == '-') ++digits;
        while (digits + 1 < out.size() && out[digits] == '0') out.erase(digits, 1);
    }
    return out;
}

constexpr bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

constexpr char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }

/// Longer names are not treated as typing errors.
constexpr std::size_t longest_name = 64;

/// Returns the edit distance with transpositions of neighbours (optimal string alignment), ignoring
/// case.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    using Row = std::array<std::size_t, longest_name + 1>;
    Row older{}, old{}, now{};
    for (std::size_t j = 0; j <= b.size(); ++j) old[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        now[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const char x = lower(a[i - 1]), y = lower(b[j - 1]);
            now[j] = std::min({old[j] + 1, now[j - 1] + 1, old[j - 1] + (x == y ? 0u : 1u)});
            if (i > 1 && j > 1 && x == lower(b[j - 2]) && lower(a[i - 2]) == y)
                now[j] = std::min(now[j], older[j - 2] + 1);
        }
        older = old;
        old = now;
    }
    return old[b.size()];
}

}  // namespace

std::string number_text(double value) { return shortest(value); }

std::string number_text(float value) { return shortest(value); }

std::size_t utf8_length(std::string_view text) {
    if (text.empty()) return 0;
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(0);
    if (first < 0x80) return 1;
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
    // The second byte excludes overlong forms, surrogates and code points beyond U+10FFFF.
    const unsigned char low = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
    const unsigned char high = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
    if (byte(1) < low || byte(1) > high) return 0;
    for (std::size_t i = 2; i < length; ++i)
        if (byte(i) < 0x80 || byte(i) > 0xbf) return 0;
    return length;
}

bool is_plain_text(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        if (length == 0 || is_control(text[0])) return false;
        text.remove_prefix(length);
    }
    return true;
}

std::string printable(std::string_view text, std::size_t most) {
    std::string out;
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        if (out.size() + std::max<std::size_t>(length, 1) > most) return out + "...";
        if (length == 0 || is_control(text[0]))
            out += '?';
        else
            out += text.substr(0, length);
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return out;
}

std::string in_quotes(std::string_view text) { return "'" + printable(text, 40) + "'"; }

std::string_view closest(std::string_view name, std::span<const std::string> candidates) {
    if (name.size() > longest_name) return {};
    std::string_view best;
    std::size_t least = std::max<std::size_t>(name.size() / 3, 1) + 1;
    for (const std::string& candidate : candidates) {
        if (candidate.size() > longest_name) continue;
        const std::size_t gap = candidate.size() > name.size() ? candidate.size() - name.size()
                                                               : name.size() - candidate.size();
        if (gap >= least) continue;
        const std::size_t distance = edit_distance(name, candidate);
        if (distance < least && distance < std::max(name.size(), candidate.size())) {
            least = distance;
            best = candidate;
        }
    }
    return best;
}

std::string unknown_message(std::string_view name, std::span<const std::string> known) {
    std::string message = "unknown parameter";
    if (const std::string_view near = closest(name, known); !near.empty())
        message += "; did you mean '" + std::string(near) + "'?";
    return message;
}

std::string invalid_id_message(std::string_view id) {
    if (id.empty()) return "is missing";
    for (const char c : id)
        if (!((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'))
            return "'" + std::string(id) + "' has other characters than a-z, 0-9 and _";
    return {};
}

std::string pointer_token(std::string_view key) {
    std::string out;
    for (const char c : printable(key)) {
        if (c == '~')
            out += "~0";
        else if (c == '/')
            out += "~1";
        else
            out += c;
    }
    return out;
}

std::string percent_encoded(std::string_view text) {
    std::string out;
    for (const char c : text) {
        const bool unreserved = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                                (c >= '0' && c <= '9') || c == '-' || c == '.' || c == '_' ||
                                c == '~';
        if (unreserved) {
            out += c;
        } else {
            out += '%';
            out += "0123456789ABCDEF"[(c >> 4) & 15];
            out += "0123456789ABCDEF"[c & 15];
        }
    }
    return out;
}

std::string title_of(std::string_view name) {
    if (name.ends_with("_deg")) name.remove_suffix(4);
    std::string title(name);
    std::replace(title.begin(), title.end(), '_', ' ');
    return title;
}

}  // namespace sporeprint
