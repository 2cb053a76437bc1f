// Leaf types of parameters beyond numbers, booleans and enums: text, colour, range, choices, upload.
// Each is a literal type, so that defaults are proven at compile time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sporeprint {

/// UTF-8 text of at most `Capacity` bytes, stored in place. A literal that is too long does not
/// compile.
template <std::size_t Capacity>
class Text {
  public:
    static constexpr std::size_t capacity = Capacity;

    constexpr Text() = default;
    template <std::size_t Size>
    consteval Text(const char (&literal)[Size]) : Text(std::string_view(literal)) {
        static_assert(Size <= Capacity + 1, "this literal is longer than the text can hold");
    }
    /// Throws std::length_error when `text` is longer than the capacity.
    constexpr explicit Text(std::string_view text) {
        if (text.size() > Capacity) throw std::length_error("text is too long");
        size_ = text.size();
        for (std::size_t i = 0; i < size_; ++i) bytes_[i] = text[i];
    }

    constexpr std::string_view view() const { return {bytes_, size_}; }
    constexpr operator std::string_view() const { return view(); }
    std::string string() const { return std::string(view()); }
    constexpr bool empty() const { return size_ == 0; }
    constexpr std::size_t size() const { return size_; }

    friend constexpr bool operator==(const Text& a, const Text& b) { return a.view() == b.view(); }

  private:
    char bytes_[Capacity + 1] = {};
    std::size_t size_ = 0;
};

/// An sRGB colour of 8 bits per channel; "#RRGGBB" in JSON and text.
struct Colour {
    std::uint8_t r = 0, g = 0, b = 0;
    bool operator==(const Colour&) const = default;
};

/// A closed range of numbers, from <= to; [from, to] in JSON.
struct Range {
    double from = 0.0, to = 0.0;
    bool operator==(const Range&) const = default;
};

/// One of a few integers, such as the side of an image; a number in JSON and text. In `Choice<256,
/// 512> side{512}` a value that is not among them does not compile as a default.
template <int... Values>
struct Choice {
    static_assert(sizeof...(Values) > 0);
    static constexpr int values[] = {Values...};
    int value = values[0];
    static constexpr bool allows(double candidate) { return ((candidate == Values) || ...); }
    constexpr operator int() const { return value; }
};

/// One of several ids that are known at run time only, such as those of the leaves of an atlas. In
/// JSON, text and schema it is like an enum.
struct IdChoice {
    Text<48> id;
    /// The allowed ids, in the order of messages and of the schema; empty if any id is allowed. Their
    /// owner, such as the atlas, must outlive every use of the choice.
    std::span<const std::string> among{};

    /// Returns true if `candidate` is an id and allowed.
    bool allows(std::string_view candidate) const;
    friend constexpr bool operator==(const IdChoice& a, const IdChoice& b) { return a.id == b.id; }
};

/// Bytes sent by the user, such as an image; base64 in JSON, "sha256:<hex>" in canonical text.
/// Empty means that nothing was sent. `uploaded` makes one with the matching digest.
struct Upload {
    std::vector<std::uint8_t> bytes;
    Text<64> sha256;  ///< lower-case hexadecimal digest of `bytes`; empty when there are none
    bool empty() const { return bytes.empty(); }
    bool operator==(const Upload&) const = default;
};

/// Returns the upload of `bytes` with its SHA-256. Throws std::runtime_error if the digest fails.
Upload uploaded(std::vector<std::uint8_t> bytes);

/// Returns the lower-case hexadecimal SHA-256 of `bytes` (64 characters), by OpenSSL's libcrypto.
std::string sha256_hex(const void* bytes, std::size_t size);

/// Reads "#RRGGBB" (either case). Returns false and leaves `out` unchanged if `text` is anything
/// else.
bool read_colour(std::string_view text, Colour& out);

/// Returns "#RRGGBB", upper case.
std::string colour_text(Colour colour);

/// Reads strict base64 (RFC 4648 §4: padded, no white space, unused bits zero). Returns false if
/// `text` is anything else.
bool read_base64(std::string_view text, std::vector<std::uint8_t>& out);

/// Returns the base64 of `bytes`, padded.
std::string base64_text(std::span<const std::uint8_t> bytes);

}  // namespace sporeprint
