#include "api/http/schemas.h"

namespace sporeprint::api {

namespace {

Value triple() {
    return object(
        {{"type", "array"}, {"items", typed("number")}, {"minItems", 3}, {"maxItems", 3}});
}

}  // namespace

Value object(std::initializer_list<Value::Member> members) { return Value(Value::Object(members)); }

Value reference(std::string_view where) {
    return object({{"$ref", "#/components/" + std::string(where)}});
}

Value typed(const char* type) { return object({{"type", type}}); }

Value list_of(Value items) { return object({{"type", "array"}, {"items", std::move(items)}}); }

Value objects(std::initializer_list<Value::Member> properties) {
    return objects(Value::Object(properties));
}

Value objects(const Value::Object& properties) {
    Value required = Value::array();
    for (const auto& property : properties) required.push(property.first);
    return object(
        {{"type", "object"}, {"properties", Value(properties)}, {"required", std::move(required)}});
}

Value map_of(Value values) {
    return object({{"type", "object"}, {"additionalProperties", std::move(values)}});
}

Value estimate_schema() {
    const Value whole = typed("integer");
    return objects({{"vertices", whole}, {"triangles", whole}, {"bytes", whole}});
}

Value bounds_schema() { return objects({{"min", triple()}, {"max", triple()}}); }

Value levels_schema() {
    Value coverage = typed("number");
    coverage.set(
        "description",
        "Longest side of the box over the height of the screen, down to which this level is "
        "drawn; below that of the last there is nothing to see.");
    Value lod = typed("number");
    lod.set("description", "A whole level, or a place between two of them.");
    return list_of(objects({{"lod", std::move(lod)},
                            {"vertices", typed("integer")},
                            {"triangles", typed("integer")},
                            {"screen_coverage", std::move(coverage)}}));
}

Value with_collision(Value description) {
    const Value number = typed("number");
    Value shape = objects({{"part", typed("string")}});
    shape.find("properties")
        ->set("capsule", objects({{"radius_m", number}, {"height_m", number}}))
        .set("convex", objects({{"points_m", list_of(triple())}}));
    const Value collider = objects({{"shape", typed("integer")},
                                    {"translation_m", triple()},
                                    {"rotation", list_of(number)},
                                    {"scale", number}});
    Value collision =
        objects({{"shapes", list_of(std::move(shape))}, {"colliders", list_of(collider)}});
    collision.set("description",
                  "Present unless the request says collision=none. A shape is a capsule along +y "
                  "whose height includes its round ends, or the convex hull of points; a collider "
                  "is a shape at a place, its rotation a unit quaternion x, y, z, w.");
    description.find("properties")->set("collision", std::move(collision));
    return description;
}

Value version_member() {
    return object(
        {{"type", "string"}, {"description", "Version token; another than today's is 410."}});
}

Value as_written(Value schema) {
    each_schema(schema, [](Value& one) {
        one.erase("default");
        const Value* properties = one.find("properties");
        if (!properties) return;
        Value required = Value::array();
        for (const auto& [key, property] : properties->members()) {
            // What a profile sets is always written, what species or presets have is not.
            const Value* const from = property.find("x-default-from");
            if ((!from || *from == Value("profile")) && !property.find("contentEncoding"))
                required.push(key);
        }
        if (!required.items().empty()) one.set("required", std::move(required));
    });
    each_schema(schema, [](Value& one) { one.erase("x-default-from"); });
    return schema;
}

Value as_template(Value schema) {
    each_schema(schema, [](Value& one) {
        if (const Value* given = one.find("default")) {
            Value fallback = *given;
            one.erase("default");
            one.set("x-default", std::move(fallback));
        }
    });
    return schema;
}

Value without_default_source(Value schema) {
    each_schema(schema, [](Value& one) { one.erase("x-default-from"); });
    return schema;
}

Value json_body(std::string_view description, Value schema, Value example) {
    return object(
        {{"required", true},
         {"description", description},
         {"content", object({{"application/json", object({{"schema", std::move(schema)},
                                                          {"example", std::move(example)}})}})}});
}

Value with_members(Value::Object first, Value schema, const char* required) {
    Value properties(std::move(first));
    for (const auto& [key, property] : schema.find("properties")->members())
        properties.set(key, property);
    schema.set("properties", std::move(properties));
    if (*required != '\0') schema.set("required", Value(Value::Array{required}));
    return schema;
}

std::string example_id(const Atlas& atlas) {
    if (atlas.find("amanita_muscaria") || atlas.entries().empty()) return "amanita_muscaria";
    return atlas.entries().front().species.id.string();
}

std::string other_id(const Atlas& atlas) {
    const std::string first = example_id(atlas);
    for (const AtlasEntry& entry : atlas.entries())
        if (entry.species.id.string() != first) return entry.species.id.string();
    return "boletus_edulis";
}

Value path_parameter(std::string_view name, std::string_view doc, Value schema,
                     std::string_view example) {
    return object({{"name", name},
                   {"in", "path"},
                   {"required", true},
                   {"description", doc},
                   {"schema", std::move(schema)},
                   {"example", example}});
}

void take_from_preset(Value& leaf) {
    if (Value* properties = leaf.find("properties")) {
        for (auto& [key, property] : properties->members()) take_from_preset(property);
        return;
    }
    leaf.erase("default");
    leaf.set("x-default-from", "preset");
}

}  // namespace sporeprint::api
