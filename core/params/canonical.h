// Canonical text of parameters: equal values have equal text, however the request was spelt.
#pragma once

#include <string>

#include "core/params/describe.h"
#include "core/params/value.h"

namespace sporeprint {

template <class T>
void canonical(const T& value, std::string& out);

/// Appends "name:value," for each member; see `canonical`.
template <class T>
void canonical_members(const T& value, std::string& out) {
    if constexpr (is_variant<T>) {
        (((out += form_key) += ':') += form_of(value)) += ',';
        std::visit([&](const auto& one) { canonical_members(one, out); }, value);
    } else {
        prove<T>();
        T::fields([&](auto member, const Info& sub) {
            const auto& content = value.*member;
            using Member = std::remove_cvref_t<decltype(content)>;
            if constexpr (Described<Member> || is_variant<Member>) {
                if (sub.name[0] == '\0') return canonical_members(content, out);
            }
            if constexpr (is_optional<Member>) {
                if (!content) return;
            } else if constexpr (std::is_same_v<Member, Upload>) {
                if (content.empty()) return;
            }
            (out += sub.name) += ':';
            canonical(content, out);
            out += ',';
        });
    }
}

/// Appends all values of `value` in field order: "{seed:1,cap:{radius:0.04,},list:[1,2,],}".
/// Numbers have their shortest round-trip digits, -0 is 0, text is a JSON string, an enum or id is
/// bare, an upload is "sha256:<hex>", a colour "#RRGGBB"; empty optionals and uploads are absent.
template <class T>
void canonical(const T& value, std::string& out) {
    if constexpr (Described<T> || is_variant<T>) {
        out += '{';
        canonical_members(value, out);
        out += '}';
    } else if constexpr (is_optional<T>) {
        if (value) canonical(*value, out);
    } else if constexpr (is_list<T> || is_tuple<T>) {
        out += '[';
        for (const auto& item : value) {
            canonical<typename T::value_type>(item, out);
            out += ',';
        }
        out += ']';
    } else if constexpr (std::is_same_v<T, Range>) {
        (((((out += '[') += number_text(value.from)) += ',') += number_text(value.to)) += ',') +=
            ']';
    } else if constexpr (NamedEnum<T>) {
        out += name(value);
    } else if constexpr (std::is_same_v<T, IdChoice>) {
        out += value.id.view();
    } else if constexpr (std::is_same_v<T, bool>) {
        out += value ? "true" : "false";
    } else if constexpr (is_text<T>) {
        out += json_string(value);
    } else if constexpr (std::is_same_v<T, Colour>) {
        out += colour_text(value);
    } else if constexpr (std::is_same_v<T, Upload>) {
        if (!value.empty()) (out += "sha256:") += value.sha256.view();
    } else if constexpr (is_choice<T>) {
        out += number_text(value.value);
    } else {
        static_assert(Number<T>, "no rule for this member type");
        out += number_text(value);
    }
}

/// Returns the canonical text of `value` alone.
template <class T>
std::string canonical_text(const T& value) {
    std::string out;
    canonical(value, out);
    return out;
}

}  // namespace sporeprint
