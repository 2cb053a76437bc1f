// JSON Schema (2020-12) of parameter structs: the OpenAPI component and the controls of the page.
#pragma once

#include <string>
#include <utility>
#include <variant>

#include "core/params/describe.h"
#include "core/params/reader.h"
#include "core/params/value.h"

namespace sporeprint {

template <class T>
Value schema(const T& fallback = {}, const Info& info = {.name = ""});

template <class T>
void schema_members(const T& fallback, Value& properties, Value& choices);

/// Calls `use(form, alternative)` for each alternative of a variant: the one that `fallback` holds
/// with its values, the others with their defaults.
template <class Use, class... Ts>
void each_form(const std::variant<Ts...>& fallback, Use use) {
    const auto one = [&]<class T>(const T* held) { use(T::form, held ? *held : T{}); };
    (one(std::get_if<Ts>(&fallback)), ...);
}

/// Returns the schema of an object from its `properties` and the `choices` of its inlined variants.
inline Value object_schema(Value properties, Value choices) {
    Value out = Value::object();
    out.set("type", "object");
    out.set("properties", std::move(properties));
    if (choices.items().empty()) {
        out.set("additionalProperties", false);
        return out;
    }
    if (choices.items().size() == 1)
        out.set("oneOf", std::move(choices.items()[0]));
    else {
        Value all = Value::array();
        for (Value& choice : choices.items())
            all.push(Value::object().set("oneOf", std::move(choice)));
        out.set("allOf", std::move(all));
    }
    out.set("unevaluatedProperties", false);
    return out;
}

/// Returns the schema of one alternative: an object whose `form_key` is `form`. As a part of a
/// larger object it does not restrict the other properties.
template <class T>
Value form_schema(const char* form, const T& fallback, bool is_part) {
    Value properties = Value::object(), choices = Value::array();
    properties.set(form_key, Value::object().set("const", form));
    schema_members(fallback, properties, choices);
    Value out = object_schema(std::move(properties), std::move(choices));
    if (is_part) {
        out.erase("additionalProperties");
        out.erase("unevaluatedProperties");
    }
    out.set("required", Value::array().push(form_key));
    return out;
}

/// Adds the members of a described struct or variant to `properties`; an inlined variant of several
/// forms adds its list of alternatives to `choices`.
template <class T>
void schema_members(const T& fallback, Value& properties, Value& choices) {
    if constexpr (is_variant<T>) {
        if constexpr (std::variant_size_v<T> == 1) {
            using Only = std::variant_alternative_t<0, T>;
            properties.set(form_key,
                           Value::object().set("const", Only::form).set("default", Only::form));
            schema_members(std::get<0>(fallback), properties, choices);
        } else {
            Value alternatives = Value::array();
            each_form(fallback, [&](const char* form, const auto& one) {
                alternatives.push(form_schema(form, one, true));
            });
            choices.push(std::move(alternatives));
        }
    } else {
        prove<T>();
        T::fields([&](auto member, const Info& sub) {
            using Member = std::remove_cvref_t<decltype(fallback.*member)>;
            if constexpr (Described<Member> || is_variant<Member>) {
                if (sub.name[0] == '\0')
                    return schema_members(fallback.*member, properties, choices);
            }
            Value property = schema(fallback.*member, sub);
            if (sub.default_from[0] != '\0') {
                property.erase("default");
                property.set("x-default-from", sub.default_from);
            }
            properties.set(sub.name, std::move(property));
        });
    }
}

/// Returns the schema of T with the defaults of `fallback`. Leaves carry type, range or enum,
/// default, title, description, "x-unit", "x-group" and "x-step"; an empty optional has no default
/// but "x-default-from": "species", and one whose default follows from another parameter the name
/// of that parameter. Unknown properties are refused. One function, because it is a
/// table: each branch is the rule of one kind of member.
template <class T>
Value schema(const T& fallback, const Info& info) {
    Value out = Value::object();
    if constexpr (is_optional<T>) {
        using Inner = typename T::value_type;
        out = schema(fallback ? *fallback : Inner{}, info);
        if (!fallback) {
            out.erase("default");
            out.set("x-default-from", "species");
        }
        return out;
    } else if constexpr (Described<T>) {
        Value properties = Value::object(), choices = Value::array();
        schema_members(fallback, properties, choices);
        out = object_schema(std::move(properties), std::move(choices));
    } else if constexpr (is_variant<T>) {
        Value alternatives = Value::array();
        each_form(fallback, [&](const char* form, const auto& one) {
            alternatives.push(form_schema(form, one, false));
        });
        out.set("type", "object");
        out.set("oneOf", std::move(alternatives));
        out.set("default", Value::object().set(form_key, form_of(fallback)));
    } else if constexpr (is_list<T> || is_tuple<T> || std::is_same_v<T, Range>) {
        Value items;
        out.set("type", "array");
        if constexpr (is_list<T>) {
            out.set("maxItems", info.most);
            items = schema(typename T::value_type{}, item_info<typename T::value_type>(info));
        } else if constexpr (is_tuple<T>) {
            out.set("minItems", fallback.size()).set("maxItems", fallback.size());
            items = schema(typename T::value_type{}, info);
        } else {
            out.set("minItems", 2).set("maxItems", 2);
            items = schema(double{}, info);
        }
        for (const char* described_once : {"default", "title", "description"})
            items.erase(described_once);
        out.set("items", std::move(items));
        out.set("default", write(fallback));
    } else if constexpr (NamedEnum<T>) {
        Value names = Value::array();
        for (int i = 0; const char* one = name(static_cast<T>(i)); ++i) names.push(one);
        out.set("type", "string").set("enum", std::move(names));
        out.set("default", write(fallback));
    } else if constexpr (std::is_same_v<T, IdChoice>) {
        Value ids = Value::array();
        for (const std::string& id : fallback.among) ids.push(id);
        out.set("type", "string");
        if (!ids.items().empty()) out.set("enum", std::move(ids));
        out.set("default", write(fallback));
    } else if constexpr (std::is_same_v<T, bool>) {
        out.set("type", "boolean").set("default", fallback);
    } else if constexpr (is_text<T>) {
        out.set("type", "string").set("maxLength", longest_text<T>(info));
        out.set("default", write(fallback));
    } else if constexpr (std::is_same_v<T, Colour>) {
        out.set("type", "string").set("format", "color").set("pattern", "^#[0-9A-Fa-f]{6}$");
        out.set("default", write(fallback));
    } else if constexpr (std::is_same_v<T, Upload>) {
        out.set("type", "string").set("contentEncoding", "base64");
        out.set("maxLength", (info.most + 2) / 3 * 4);
    } else if constexpr (is_choice<T>) {
        Value values = Value::array();
        for (const int one : T::values) values.push(one);
        out.set("type", "integer").set("enum", std::move(values)).set("default", fallback.value);
    } else {
        static_assert(Number<T>, "no rule for this member type");
        out.set("type", std::is_integral_v<T> ? "integer" : "number");
        out.set("minimum", info.min).set("maximum", info.max).set("default", write(fallback));
        if (info.step > 0.0) out.set("x-step", info.step);
    }
    if (*info.unit) out.set("x-unit", info.unit);
    if (*info.group) out.set("x-group", info.group);
    if (*info.name) out.set("title", title_of(info.name));
    if (*info.doc) out.set("description", info.doc);
    return out;
}

/// Returns the schema of T as a document of its own.
template <class T>
Value schema_document(std::string_view title, const T& fallback = {}) {
    Value out = Value::object();
    out.set("$schema", "https://json-schema.org/draft/2020-12/schema").set("title", title);
    Value body = schema(fallback);
    for (auto& [key, value] : body.members()) out.set(key, std::move(value));
    return out;
}

}  // namespace sporeprint
