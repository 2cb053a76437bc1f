// Text for error messages: numbers as text, quoted input, and the name that was probably meant.
#pragma once

#include <concepts>
#include <span>
#include <string>
#include <string_view>

namespace sporeprint {

/// Returns the shortest decimal text that reads back as the same number: "0.04", "1e-7",
/// "4294967295". It follows JSON's grammar without a '+'; -0 is "0"; not finite is "nan", "inf",
/// "-inf".
std::string number_text(double value);
std::string number_text(float value);
template <std::integral T>
std::string number_text(T value) {
    return std::to_string(value);
}

/// Returns `text` between single quotes for an error message: at most 40 bytes, then "..."; control
/// characters and bytes that are not UTF-8 become '?'.
std::string in_quotes(std::string_view text);

/// Returns `text` with control characters and bytes that are not UTF-8 replaced by '?', at most
/// `most` bytes.
std::string printable(std::string_view text, std::size_t most = 120);

/// Returns the length in bytes of the valid UTF-8 sequence at the front of `text`, 0 if there is
/// none.
std::size_t utf8_length(std::string_view text);

/// Returns true if all of `text` is UTF-8 without control characters.
bool is_plain_text(std::string_view text);

/// Returns the candidate that was most likely meant by `name` (edit distance with transpositions,
/// at most a third of its length, ignoring case), or "" if none is close.
std::string_view closest(std::string_view name, std::span<const std::string> candidates);

/// Returns "unknown parameter", with "; did you mean 'seed'?" if a known name is close.
std::string unknown_message(std::string_view name, std::span<const std::string> known);

/// Returns the message for an id that is empty or has other characters than a-z, 0-9 and _, or ""
/// for a valid id.
std::string invalid_id_message(std::string_view id);

/// Returns one reference token of a JSON pointer (RFC 6901): '~' and '/' escaped, made printable.
std::string pointer_token(std::string_view key);

/// Returns `text` with everything but RFC 3986's unreserved characters percent-encoded.
std::string percent_encoded(std::string_view text);

/// Returns the label of a control: "gill_count" is "gill count", "bend_deg" is "bend".
std::string title_of(std::string_view name);

}  // namespace sporeprint
