// Conversion between JSON and parameter structs, derived from their fields().
#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/params/describe.h"
#include "core/params/value.h"

namespace sporeprint {

template <class T>
void read(const Value& json, T& out, const Info& info, const std::string& path,
          std::vector<Problem>& problems);

/// Reads the members of the object `json` into a described struct or variant and appends the keys
/// of T to `known`. A variant is selected by its discriminator, the member "form". Returns false if
/// that names no alternative, because the valid keys are then undetermined.
template <class T>
bool read_members(const Value& json, T& out, const std::string& path,
                  std::vector<std::string>& known, std::vector<Problem>& problems) {
    if constexpr (is_variant<T>) {
        using Forms = FormsOf<T>;
        known.emplace_back(form_key);
        if (const Value* form = json.find(form_key)) {
            std::string names;
            for (const char* one : Forms::names)
                names += (names.empty() ? "" : ", ") + std::string(one);
            if (!form->is_string() || !Forms::select(out, form->as_string())) {
                report(problems, path + '/' + form_key, shown(*form) + " is not one of " + names);
                return false;
            }
        }
        return std::visit([&](auto& one) { return read_members(json, one, path, known, problems); },
                          out);
    } else {
        prove<T>();
        const std::size_t before = problems.size();
        bool forms_known = true;
        T::fields([&](auto member, const Info& sub) {
            using Member = std::remove_cvref_t<decltype(out.*member)>;
            if constexpr (Described<Member> || is_variant<Member>) {
                if (sub.name[0] == '\0') {
                    forms_known &= read_members(json, out.*member, path, known, problems);
                    return;
                }
            }
            known.emplace_back(sub.name);
            if (const Value* found = json.find(sub.name))
                read(*found, out.*member, sub, path + '/' + sub.name, problems);
        });
        if constexpr (requires { out.check(path, problems); })
            if (problems.size() == before) out.check(path, problems);
        return forms_known;
    }
}

/// Reads `json` over the values already in `out`; absent members keep their value, a list is
/// replaced as a whole, a variant keeps its alternative unless "form" selects another. Appends
/// every problem with its JSON pointer, unknown keys included; a faulty leaf keeps its value. One
/// function, because it is a table: each branch is the rule of one kind of member.
template <class T>
void read(const Value& json, T& out, const Info& info, const std::string& path,
          std::vector<Problem>& problems) {
    const auto expected = [&](const std::string& what) {
        report(problems, path, "expected " + what + ", got " + shown(json));
    };
    // Assigns a leaf once it has passed the check of values.
    const auto take = [&](T value) {
        const std::size_t before = problems.size();
        check(value, info, path, problems);
        if (problems.size() == before) out = std::move(value);
    };
    if constexpr (Described<T> || is_variant<T>) {
        if (!json.is_object()) return expected("an object");
        std::vector<std::string> known;
        if (!read_members(json, out, path, known, problems)) return;
        for (const auto& [key, ignored] : json.members()) {
            if (problems.size() >= most_problems) return;
            if (std::find(known.begin(), known.end(), key) == known.end())
                report(problems, path + '/' + pointer_token(key), unknown_message(key, known));
        }
    } else if constexpr (is_optional<T>) {
        if (json.is_null())
            return report(problems, path,
                          "null is not a value; leave the parameter out for the species' own");
        typename T::value_type value = out ? *out : typename T::value_type{};
        const std::size_t before = problems.size();
        read(json, value, info, path, problems);
        if (problems.size() == before) out = std::move(value);
    } else if constexpr (is_list<T>) {
        if (!json.is_array()) return expected("a list");
        if (json.items().size() > info.most)
            return report(problems, path,
                          "a list of " + std::to_string(json.items().size()) + " items; at most " +
                              std::to_string(info.most) + " are allowed");
        out.assign(json.items().size(), typename T::value_type{});
        for (std::size_t i = 0; i < out.size(); ++i) {
            if constexpr (std::is_same_v<T, std::vector<bool>>) {
                bool item = false;
                read(json.items()[i], item, info, path + '/' + std::to_string(i), problems);
                out[i] = item;
            } else {
                read(json.items()[i], out[i], item_info<typename T::value_type>(info),
                     path + '/' + std::to_string(i), problems);
            }
        }
    } else if constexpr (is_tuple<T>) {
        if (!json.is_array() || json.items().size() != out.size())
            return expected("a list of " + std::to_string(out.size()) + " numbers");
        for (std::size_t i = 0; i < out.size(); ++i)
            read(json.items()[i], out[i], info, path + '/' + std::to_string(i), problems);
    } else if constexpr (std::is_same_v<T, Range>) {
        if (!json.is_array() || json.items().size() != 2) return expected("a range [from, to]");
        Range value = out;
        const std::size_t before = problems.size();
        read(json.items()[0], value.from, info, path + "/0", problems);
        read(json.items()[1], value.to, info, path + "/1", problems);
        if (problems.size() == before) take(value);
    } else if constexpr (NamedEnum<T>) {
        if (json.is_string())
            for (int i = 0; const char* one = name(static_cast<T>(i)); ++i)
                if (json.as_string() == one) {
                    out = static_cast<T>(i);
                    return;
                }
        report(problems, path, shown(json) + " is not one of " + enum_names<T>());
    } else if constexpr (std::is_same_v<T, IdChoice>) {
        if (!json.is_string() || !out.allows(json.as_string()))
            return report(problems, path, not_allowed_message(shown(json), out));
        out.id = decltype(out.id)(std::string_view(json.as_string()));
    } else if constexpr (std::is_same_v<T, bool>) {
        if (!json.is_bool()) return expected("true or false");
        out = json.as_bool();
    } else if constexpr (is_text<T>) {
        if (!json.is_string()) return expected("text");
        if (json.as_string().size() > longest_text<T>(info))
            return report(problems, path,
                          in_quotes(json.as_string()) + " is longer than " +
                              std::to_string(longest_text<T>(info)) + " bytes");
        take(T(std::string_view(json.as_string())));
    } else if constexpr (std::is_same_v<T, Colour>) {
        if (!json.is_string() || !read_colour(json.as_string(), out))
            return expected("a colour like #D22B1F");
    } else if constexpr (std::is_same_v<T, Upload>) {
        if (!json.is_string()) return expected("base64 text");
        if (json.as_string().size() / 4 > info.most / 3 + 1)
            return report(problems, path,
                          "more than " + std::to_string(info.most) + " bytes; at most " +
                              std::to_string(info.most) + " are allowed");
        std::vector<std::uint8_t> bytes;
        if (!read_base64(json.as_string(), bytes))
            return report(problems, path, "this is not base64 (RFC 4648, padded, no white space)");
        take(uploaded(std::move(bytes)));
    } else if constexpr (is_choice<T>) {
        if (!json.is_number() || !T::allows(json.as_number()))
            return report(problems, path, shown(json) + " is not one of " + choice_names<T>());
        out.value = static_cast<int>(json.as_number());
    } else {
        static_assert(Number<T>, "no rule for this member type");
        if (!json.is_number())
            return expected(std::is_integral_v<T> ? "a whole number" : "a number");
        const double value = json.as_number();
        if constexpr (std::is_integral_v<T>) {
            if (value >= -9e15 && value <= 9e15 &&
                value != static_cast<double>(static_cast<long long>(value)))
                return expected("a whole number");
        }
        // The value is compared as a double first, so that the cast below cannot overflow.
        if constexpr (std::is_same_v<T, float>) {
            if (!(value >= std::numeric_limits<float>::lowest() &&
                  value <= std::numeric_limits<float>::max()))
                return report(problems, path, outside_message(value, info));
        } else {
            if (!in_range(value, info)) return report(problems, path, outside_message(value, info));
        }
        take(static_cast<T>(value));
    }
}

/// Returns the T that `json` describes, over T's defaults. Appends every problem.
template <class T>
T read_all(const Value& json, std::vector<Problem>& problems) {
    T out{};
    read(json, out, Info{.name = ""}, "", problems);
    return out;
}

/// Returns the T that the JSON text describes, over T's defaults. Appends every problem; if the
/// text is malformed or repeats a key, only that is reported.
template <class T>
T read_json(std::string_view text, std::vector<Problem>& problems) {
    const std::size_t before = problems.size();
    const Value json = parse(text, problems);
    return problems.size() == before ? read_all<T>(json, problems) : T{};
}

template <class T>
Value write(const T& value);

/// Sets the members of `object` from a described struct or variant.
template <class T>
void write_members(const T& value, Value& object) {
    if constexpr (is_variant<T>) {
        object.set(form_key, form_of(value));
        std::visit([&](const auto& one) { write_members(one, object); }, value);
    } else {
        prove<T>();
        T::fields([&](auto member, const Info& sub) {
            const auto& content = value.*member;
            using Member = std::remove_cvref_t<decltype(content)>;
            if constexpr (Described<Member> || is_variant<Member>) {
                if (sub.name[0] == '\0') return write_members(content, object);
            }
            if constexpr (is_optional<Member>) {
                if (content) object.set(sub.name, write(*content));
            } else if constexpr (std::is_same_v<Member, Upload>) {
                if (!content.empty()) object.set(sub.name, write(content));
            } else {
                object.set(sub.name, write(content));
            }
        });
    }
}

/// Returns all values as JSON, in field order; empty optionals and uploads are absent. Reading it
/// back gives an equal value.
template <class T>
Value write(const T& value) {
    if constexpr (Described<T> || is_variant<T>) {
        Value object = Value::object();
        write_members(value, object);
        return object;
    } else if constexpr (is_optional<T>) {
        return value ? write(*value) : Value();
    } else if constexpr (is_list<T> || is_tuple<T>) {
        Value list = Value::array();
        for (const auto& item : value) list.push(write<typename T::value_type>(item));
        return list;
    } else if constexpr (std::is_same_v<T, Range>) {
        return Value::Array{Value(value.from), Value(value.to)};
    } else if constexpr (NamedEnum<T>) {
        return name(value);
    } else if constexpr (std::is_same_v<T, IdChoice>) {
        return value.id.view();
    } else if constexpr (std::is_same_v<T, bool>) {
        return value;
    } else if constexpr (is_text<T>) {
        return value.view();
    } else if constexpr (std::is_same_v<T, Colour>) {
        return colour_text(value);
    } else if constexpr (std::is_same_v<T, Upload>) {
        return base64_text(value.bytes);
    } else if constexpr (is_choice<T>) {
        return value.value;
    } else {
        static_assert(Number<T>, "no rule for this member type");
        // A float is written with its own shortest digits: 0.3f is 0.3, not 0.30000001192092896.
        if constexpr (std::is_same_v<T, float>) {
            double digits = 0.0;
            read_number(number_text(value), digits);
            return digits;
        } else {
            return value;
        }
    }
}

}  // namespace sporeprint
