#include "core/params/value.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "core/params/messages.h"

namespace sporeprint {
namespace {

using Sax = nlohmann::json_sax<nlohmann::json>;

/// Builds a Value from nlohmann's events; returning false ends the parse.
class Builder final : public Sax {
  public:
    explicit Builder(std::vector<Problem>& problems) : problems_(problems) {}

    Value take() { return std::move(root_); }

    bool null() override { return put(nullptr); }
    bool boolean(bool flag) override { return put(flag); }
    bool number_integer(std::int64_t number) override { return put(number); }
    bool number_unsigned(std::uint64_t number) override { return put(number); }
    bool number_float(double parsed, const std::string& digits) override {
        double number = parsed;  // from_chars does not depend on the locale
        std::from_chars(digits.data(), digits.data() + digits.size(), number);
        return put(number);
    }
    bool string(std::string& text) override { return put(std::move(text)); }
    bool binary(nlohmann::json::binary_t&) override { return false; }

    bool start_object(std::size_t) override { return open(Value::object()); }
    bool start_array(std::size_t) override { return open(Value::array()); }

    bool key(std::string& name) override {
        key_ = std::move(name);
        return true;
    }

    bool end_object() override {
        refuse_repeated_keys(open_.back()->members());
        open_.pop_back();
        return true;
    }

    bool end_array() override {
        open_.pop_back();
        return true;
    }

    bool parse_error(std::size_t, const std::string&,
                     const nlohmann::json::exception& error) override {
        const std::string what = error.what();
        if (error.id == 406) {  // "number overflow parsing '1e999'"
            const std::size_t quote = what.find('\'');
            report(problems_, next_path(),
                   printable(what.substr(quote == std::string::npos ? 0 : quote), 60) +
                       " is too large for a number");
            return false;
        }
        // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while
        // parsing value - unexpected end of input; last read: '...'; expected ..."
        std::string place, reason;
        if (const auto at = what.find(" at "), colon = what.find(": ", at);
            at != std::string::npos && colon != std::string::npos)
            place = what.substr(at, colon - at);
        if (const auto dash = what.find(" - "); dash != std::string::npos)
            reason = ": " + what.substr(dash + 3, what.find("; last read") - dash - 3);
        report(problems_, "", "malformed JSON" + printable(place) + printable(reason));
        return false;
    }

  private:
    template <class T>
    bool put(T&& content) {
        return place(Value(std::forward<T>(content))) != nullptr;
    }

    bool open(Value container) {
        if (open_.size() >= deepest_json) {
            report(problems_, next_path(),
                   "nested deeper than " + std::to_string(deepest_json) + " levels");
            return false;
        }
        Value* const placed = place(std::move(container));
        if (placed) open_.push_back(placed);
        return placed != nullptr;
    }

    /// Stores `value` at the current position of the text. Pointers to open containers stay valid:
    /// a container grows only while it is the innermost one.
    Value* place(Value value) {
        if (++count_ > most_json_values) {
            report(problems_, "", "more than " + std::to_string(most_json_values) + " values");
            return nullptr;
        }
        if (open_.empty()) {
            root_ = std::move(value);
            return &root_;
        }
        if (open_.back()->is_array()) return &open_.back()->items().emplace_back(std::move(value));
        return &open_.back()->members().emplace_back(std::move(key_), std::move(value)).second;
    }

    /// Returns the pointer of the innermost open container.
    std::string open_path() const {
        std::string path;
        for (std::size_t i = 0; i + 1 < open_.size(); ++i) path += '/' + last_token(*open_[i]);
        return path;
    }

    static std::string last_token(const Value& container) {
        return container.is_array() ? std::to_string(container.items().size() - 1)
                                    : pointer_token(container.members().back().first);
    }

    /// Returns the pointer of the next value.
    std::string next_path() const {
        if (open_.empty()) return "";
        const Value& inner = *open_.back();
        return open_path() + '/' +
               (inner.is_array() ? std::to_string(inner.items().size()) : pointer_token(key_));
    }

    void refuse_repeated_keys(const Value::Object& members) {
        std::vector<std::string_view> keys;
        keys.reserve(members.size());
        for (const Value::Member& member : members) keys.push_back(member.first);
        std::sort(keys.begin(), keys.end());
        for (std::size_t i = 1; i < keys.size(); ++i)
            if (keys[i] == keys[i - 1] && (i < 2 || keys[i] != keys[i - 2]))
                report(problems_, open_path() + '/' + pointer_token(keys[i]),
                       "given more than once");
    }

    std::vector<Problem>& problems_;
    Value root_;
    std::string key_;
    std::vector<Value*> open_;
    std::size_t count_ = 0;
};

void write(const Value& value, int indent, int depth, std::string& out) {
    const auto line = [&](int at) {
        if (indent >= 0) {
            out += '\n';
            out.append(static_cast<std::size_t>(indent * at), ' ');
        }
    };
    if (value.is_null()) {
        out += "null";
    } else if (value.is_bool()) {
        out += value.as_bool() ? "true" : "false";
    } else if (value.is_number()) {
        out += std::isfinite(value.as_number()) ? number_text(value.as_number()) : "null";
    } else if (value.is_string()) {
        out += json_string(value.as_string());
    } else if (value.is_array()) {
        out += '[';
        bool first = true;
        for (const Value& item : value.items()) {
            if (!first) out += ',';
            first = false;
            line(depth + 1);
            write(item, indent, depth + 1, out);
        }
        if (!first) line(depth);
        out += ']';
    } else {
        out += '{';
        bool first = true;
        for (const auto& [key, item] : value.members()) {
            if (!first) out += ',';
            first = false;
            line(depth + 1);
            out += json_string(key);
            out += indent >= 0 ? ": " : ":";
            write(item, indent, depth + 1, out);
        }
        if (!first) line(depth);
        out += '}';
    }
}

}  // namespace

const Value* Value::find(std::string_view key) const {
    if (const Object* object = std::get_if<Object>(&data))
        for (const Member& member : *object)
            if (member.first == key) return &member.second;
    return nullptr;
}

Value* Value::find(std::string_view key) {
    return const_cast<Value*>(std::as_const(*this).find(key));
}

const Value* Value::at_pointer(std::string_view pointer) const {
    const Value* at = this;
    while (at && !pointer.empty()) {
        if (pointer[0] != '/') return nullptr;
        pointer.remove_prefix(1);
        const std::size_t end = std::min(pointer.find('/'), pointer.size());
        std::string token;
        for (std::size_t i = 0; i < end; ++i) {
            if (pointer[i] == '~' && i + 1 < end)
                token += pointer[++i] == '1' ? '/' : '~';
            else
                token += pointer[i];
        }
        pointer.remove_prefix(end);
        if (at->is_array()) {
            std::size_t index = 0;
            const auto [stop, error] =
                std::from_chars(token.data(), token.data() + token.size(), index);
            const bool whole = error == std::errc{} && stop == token.data() + token.size() &&
                               (token.size() == 1 || token[0] != '0');
            at = whole && index < at->items().size() ? &at->items()[index] : nullptr;
        } else {
            at = at->find(token);
        }
    }
    return at;
}

Value& Value::set(std::string_view key, Value value) {
    if (is_null()) data = Object{};
    if (Value* present = find(key))
        *present = std::move(value);
    else
        members().emplace_back(std::string(key), std::move(value));
    return *this;
}

Value& Value::push(Value value) {
    if (is_null()) data = Array{};
    items().push_back(std::move(value));
    return *this;
}

void Value::erase(std::string_view key) {
    if (Object* object = std::get_if<Object>(&data))
        std::erase_if(*object, [&](const Member& member) { return member.first == key; });
}

bool operator==(const Value& a, const Value& b) { return a.data == b.data; }

Value parse(std::string_view text, std::vector<Problem>& problems) {
    // The parser takes a zero byte for the end of the text and would ignore the rest.
    if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos) {
        report(problems, "", "not JSON: a zero byte at position " + std::to_string(zero));
        return {};
    }
    Builder builder(problems);
    nlohmann::json::sax_parse(text.begin(), text.end(), &builder);
    return builder.take();
}

bool read_number(std::string_view text, double& out) {
    std::size_t at = 0;
    const auto digits = [&] {
        const std::size_t from = at;
        while (at < text.size() && text[at] >= '0' && text[at] <= '9') ++at;
        return at > from;
    };
    const auto next_is = [&](char c) { return at < text.size() && text[at] == c; };
    if (next_is('-')) ++at;
    if (next_is('0'))
        ++at;
    else if (!digits())
        return false;
    if (next_is('.')) {
        ++at;
        if (!digits()) return false;
    }
    if (next_is('e') || next_is('E')) {
        ++at;
        if (next_is('+') || next_is('-')) ++at;
        if (!digits()) return false;
    }
    if (at != text.size()) return false;
    double number = 0.0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
    if (read.ec == std::errc::result_out_of_range) {  // too large, or so small that it is 0
        std::vector<Problem> problems;
        const Value value = parse(text, problems);
        if (!value.is_number()) return false;
        number = value.as_number();
    }
    out = number;
    return true;
}

std::string dump(const Value& value, int indent) {
    std::string out;
    write(value, indent, 0, out);
    return out;
}

std::string json_string(std::string_view text) {
    std::string out = "\"";
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        const char c = text[0];
        if (length == 0)
            out += "\\ufffd";
        else if (length > 1)
            out += text.substr(0, length);
        else if (c == '"')
            out += "\\\"";
        else if (c == '\\')
            out += "\\\\";
        else if (c == '\n')
            out += "\\n";
        else if (c == '\r')
            out += "\\r";
        else if (c == '\t')
            out += "\\t";
        else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
            out += "\\u00";
            out += "0123456789abcdef"[(c >> 4) & 15];
            out += "0123456789abcdef"[c & 15];
        } else {
            out += c;
        }
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return out + '"';
}

const char* kind_name(const Value& value) {
    if (value.is_null()) return "null";
    if (value.is_bool()) return value.as_bool() ? "true" : "false";
    if (value.is_number()) return "a number";
    if (value.is_string()) return "text";
    if (value.is_array()) return "a list";
    return "an object";
}

std::string shown(const Value& value) {
    if (value.is_number()) return number_text(value.as_number());
    if (value.is_string()) return in_quotes(value.as_string());
    return kind_name(value);
}

}  // namespace sporeprint
