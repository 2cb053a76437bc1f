// A JSON value type, its strict reader and its writer.
#pragma once

#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/problems.h"

namespace sporeprint {

/// A JSON value. Objects keep the order of their members; numbers are doubles.
struct Value {
    using Array = std::vector<Value>;
    using Member = std::pair<std::string, Value>;
    using Object = std::vector<Member>;

    std::variant<std::nullptr_t, bool, double, std::string, Array, Object> data = nullptr;

    Value() = default;
    Value(std::nullptr_t) {}
    Value(std::same_as<bool> auto flag) : data(flag) {}
    template <class T>
    requires(std::integral<T> || std::floating_point<T>) && (!std::same_as<T, bool>)Value(T number)
        : data(static_cast<double>(number)) {}
    Value(const char* text) : data(std::string(text)) {}
    Value(std::string_view text) : data(std::string(text)) {}
    Value(std::string text) : data(std::move(text)) {}
    Value(Array items) : data(std::move(items)) {}
    Value(Object members) : data(std::move(members)) {}

    static Value array() { return Value(Array{}); }
    static Value object() { return Value(Object{}); }

    bool is_null() const { return std::holds_alternative<std::nullptr_t>(data); }
    bool is_bool() const { return std::holds_alternative<bool>(data); }
    bool is_number() const { return std::holds_alternative<double>(data); }
    bool is_string() const { return std::holds_alternative<std::string>(data); }
    bool is_array() const { return std::holds_alternative<Array>(data); }
    bool is_object() const { return std::holds_alternative<Object>(data); }

    /// Returns the content; throws std::bad_variant_access if the value is of another kind.
    bool as_bool() const { return std::get<bool>(data); }
    double as_number() const { return std::get<double>(data); }
    const std::string& as_string() const { return std::get<std::string>(data); }
    const Array& items() const { return std::get<Array>(data); }
    Array& items() { return std::get<Array>(data); }
    const Object& members() const { return std::get<Object>(data); }
    Object& members() { return std::get<Object>(data); }

    /// Returns the member `key`, or nullptr if there is none or this is not an object.
    const Value* find(std::string_view key) const;
    Value* find(std::string_view key);

    /// Returns the value at an RFC 6901 pointer such as "/cap/3/r" ("" is this value), or nullptr.
    const Value* at_pointer(std::string_view pointer) const;

    /// Sets the member `key`, appending it if it is new, and returns *this. Null becomes an object
    /// first; a value of another kind throws std::bad_variant_access.
    Value& set(std::string_view key, Value value);

    /// Appends an item and returns *this. Null becomes an array first; a value of another kind
    /// throws std::bad_variant_access.
    Value& push(Value value);

    /// Removes the member `key` if this is an object that has one.
    void erase(std::string_view key);
};

bool operator==(const Value& a, const Value& b);

/// The deepest nesting of arrays and objects that `parse` accepts.
inline constexpr std::size_t deepest_json = 32;

/// The greatest number of values in one text that `parse` accepts.
inline constexpr std::size_t most_json_values = 200'000;

/// Parses JSON (RFC 8259). Text that is malformed, is not UTF-8, is nested deeper than
/// deepest_json, has more than most_json_values values, has a number beyond the range of a double
/// (1e999) or repeats a key is appended to `problems` with its JSON pointer; the result is then
/// null or incomplete. Never throws on invalid text.
Value parse(std::string_view text, std::vector<Problem>& problems);

/// Reads one number in JSON's grammar and nothing else: no "+1", ".5", "1.", hexadecimal or space.
/// Returns false if `text` is anything else or too large for a double.
bool read_number(std::string_view text, double& out);

/// Returns the JSON text of a value: numbers with the fewest digits that read back equal, -0 as 0,
/// integers without ".0". If `indent` < 0, it is one line without spaces, otherwise each level is
/// indented by `indent` spaces. Bytes that are not UTF-8 become U+FFFD; numbers that are not finite
/// become null.
std::string dump(const Value& value, int indent = -1);

/// Returns `text` as a JSON string with its quotes.
std::string json_string(std::string_view text);

/// Returns the kind of a value for messages: "a number", "text", "a list", "an object"; "true",
/// "false" or "null" for these values.
const char* kind_name(const Value& value);

/// Returns the value for an error message: the digits of a number, in_quotes() of a text, otherwise
/// kind_name().
std::string shown(const Value& value);

}  // namespace sporeprint
