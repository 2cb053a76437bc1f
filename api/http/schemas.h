// Parts of JSON Schemas for the OpenAPI document, built from the descriptions of parameters.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/atlas/atlas.h"
#include "core/params/describe.h"
#include "core/params/schema.h"
#include "core/params/value.h"

namespace sporeprint::api {

/// Returns a JSON object.
[[nodiscard]] Value object(std::initializer_list<Value::Member> members);

/// Returns {"$ref":"#/components/..."}.
[[nodiscard]] Value reference(std::string_view where);

/// Returns {"type":...}.
[[nodiscard]] Value typed(const char* type);

/// Returns the schema of a list.
[[nodiscard]] Value list_of(Value items);

/// Returns the schema of an object whose properties are all required.
[[nodiscard]] Value objects(std::initializer_list<Value::Member> properties);

/// Returns the schema of an object with any names whose values have one schema.
[[nodiscard]] Value map_of(Value values);

/// Returns schemas that the descriptions of all products share.
[[nodiscard]] Value estimate_schema();
[[nodiscard]] Value bounds_schema();

/// Returns the schema of `v` in a request body.
[[nodiscard]] Value version_member();

/// Returns the schema of a response: every property that is never left out is required, and none
/// has a default. Optional members without a value and uploads may be left out.
[[nodiscard]] Value as_written(Value schema);

/// Returns the schema of a template with its defaults as "x-default", since type generators treat a
/// property with "default" as always present.
[[nodiscard]] Value as_template(Value schema);

/// Removes "x-default-from" from a schema and all schemas in it.
[[nodiscard]] Value without_default_source(Value schema);

/// Returns a component of /components/requestBodies with JSON content.
[[nodiscard]] Value json_body(std::string_view description, Value schema, Value example);

/// Returns a schema with `first` before its properties. `required` is the name of the one that is
/// mandatory; "" for none.
[[nodiscard]] Value with_members(Value::Object first, Value schema, const char* required);

/// Returns the ids of two different species for examples.
[[nodiscard]] std::string example_id(const Atlas& atlas);
[[nodiscard]] std::string other_id(const Atlas& atlas);

/// Marks the leaves of a schema as taken from the preset by default.
void take_from_preset(Value& leaf);

/// Marks the members of Own, also of structs inlined into it, as taken from the preset by default.
template <class Own>
void mark_members_of(Value& properties) {
    const Own* none = nullptr;
    Own::fields([&](auto member, const Info& info) {
        using Member = std::remove_cvref_t<decltype(none->*member)>;
        if constexpr (Described<Member>) {
            if (*info.name == '\0') return mark_members_of<Member>(properties);
        }
        if (Value* property = properties.find(info.name)) take_from_preset(*property);
    });
}

/// Returns a schema in which the members that occur in Own... are marked as taken from the preset
/// by default.
template <class... Own>
Value from_preset(Value schema) {
    (mark_members_of<Own>(*schema.find("properties")), ...);
    return schema;
}

/// Calls `change` for a schema and all schemas in it, from the innermost outwards.
template <class Change>
void each_schema(Value& schema, Change change) {
    if (Value* properties = schema.find("properties"))
        for (auto& [key, property] : properties->members()) each_schema(property, change);
    if (Value* items = schema.find("items")) each_schema(*items, change);
    for (const char* choice : {"oneOf", "allOf"})
        if (Value* list = schema.find(choice))
            for (Value& one : list->items()) each_schema(one, change);
    change(schema);
}

}  // namespace sporeprint::api
