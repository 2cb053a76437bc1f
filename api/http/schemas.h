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

/// Returns {"$ref":"#/components/<where>"}.
[[nodiscard]] Value reference(std::string_view where);

/// Returns {"type":...}.
[[nodiscard]] Value typed(const char* type);

/// Returns the schema of a list.
[[nodiscard]] Value list_of(Value items);

/// Returns the schema of an object whose properties are all required.
[[nodiscard]] Value objects(std::initializer_list<Value::Member> properties);
[[nodiscard]] Value objects(const Value::Object& properties);

/// Returns the schema of an object with any names whose values have one schema.
[[nodiscard]] Value map_of(Value values);

/// Return the schemas of an estimate and of a bounding box, which the JSON descriptions of all
/// products contain.
[[nodiscard]] Value estimate_schema();
[[nodiscard]] Value bounds_schema();

/// Returns the schema of the levels of detail of a product: the requested one and those below it.
[[nodiscard]] Value levels_schema();

/// Adds the optional member "collision" to the schema of the description of a product.
[[nodiscard]] Value with_collision(Value description);

/// Returns the schema of the member "v" of a request body, the version token.
[[nodiscard]] Value version_member();

/// Converts the schema of parameters in requests to that of the same parameters in a response: no
/// property has a default, and all are required except those that a response may omit (optional
/// members and uploads).
[[nodiscard]] Value as_written(Value schema);

/// Returns a schema with "default" renamed to "x-default" in it and all schemas in it, for
/// templates of species: type generators treat a property with "default" as always present.
[[nodiscard]] Value as_template(Value schema);

/// Removes "x-default-from" from a schema and all schemas in it.
[[nodiscard]] Value without_default_source(Value schema);

/// Returns a component of /components/requestBodies with JSON content.
[[nodiscard]] Value json_body(std::string_view description, Value schema, Value example);

/// Returns a schema with `first` before its properties. `required` is the name of the one that is
/// mandatory; "" for none.
[[nodiscard]] Value with_members(Value::Object first, Value schema, const char* required);

/// Return the ids of two different species, to be used in examples.
[[nodiscard]] std::string example_id(const Atlas& atlas);
[[nodiscard]] std::string other_id(const Atlas& atlas);

/// Returns the OpenAPI parameter of a {name} in a path.
[[nodiscard]] Value path_parameter(std::string_view name, std::string_view doc, Value schema,
                                   std::string_view example);

/// Replaces the default of a schema, or of all leaf properties of an object schema, by the note
/// "x-default-from":"preset".
void take_from_preset(Value& leaf);

/// Calls take_from_preset() for each property that is a member of the described struct Own or of a
/// struct inlined into it.
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

/// Returns a schema whose properties that are members of the structs Own... have the value of the
/// preset as their default, by take_from_preset().
template <class... Own>
Value from_preset(Value schema) {
    (mark_members_of<Own>(*schema.find("properties")), ...);
    return schema;
}

/// Calls `change` for a schema and all schemas in its "properties", "items", "oneOf" and "allOf",
/// from the innermost outwards.
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
