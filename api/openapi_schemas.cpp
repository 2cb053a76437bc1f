#include "api/openapi_schemas.h"

#include <string>
#include <utility>

#include "api/http/errors.h"
#include "api/openapi.h"
#include "api/products/catalogue.h"
#include "api/products/mix.h"
#include "api/products/morphs.h"
#include "api/products/presets.h"
#include "api/products/surfaces.h"
#include "core/colony/colony_spec.h"
#include "core/grow/species_morph.h"
#include "core/individual/mushroom_spec.h"
#include "core/model/species.h"
#include "core/params/schema.h"

namespace sporeprint::api {

Value object(std::initializer_list<Value::Member> members) { return Value(Value::Object(members)); }

Value reference(std::string_view where) {
    return object({{"$ref", "#/components/" + std::string(where)}});
}

Value typed(const char* type) { return object({{"type", type}}); }

namespace {

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

/// The schema of what is written, not read: whatever is never left out is required, and nothing has a default. What may be
/// left out are empty optionals ("x-default-from") and uploads.
Value as_written(Value schema) {
    each_schema(schema, [](Value& one) {
        one.erase("default");
        const Value* properties = one.find("properties");
        if (!properties) return;
        Value required = Value::array();
        for (const auto& [key, property] : properties->members())
            if (!property.find("x-default-from") && !property.find("contentEncoding"))
                required.push(key);
        if (!required.items().empty()) one.set("required", std::move(required));
    });
    each_schema(schema, [](Value& one) { one.erase("x-default-from"); });
    return schema;
}

/// The schema of a template, which may leave out what has a default: as "x-default", for generators of types take a property
/// with "default" to be there always.
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

/// A bush of order 1 would have no fork: Branched::check() refuses it, where a tree of order 1 is a twig.
Value with_branch_graphs(Value schema) {
    each_schema(schema, [](Value& one) {
        if (Value* properties = one.find("properties"))
            if (Value* ramification = properties->find("ramification"))
                if (Value* inner = ramification->find("properties"))
                    inner->find("order")->set("minimum", 2);
    });
    return schema;
}

/// What a preset brings: its own unless it is given.
void take_from_preset(Value& leaf) {
    if (Value* properties = leaf.find("properties")) {
        for (auto& [key, property] : properties->members()) take_from_preset(property);
        return;
    }
    leaf.erase("default");
    leaf.set("x-default-from", "preset");
}

/// Marks the members of Own, and those that are inlined into it, as the preset's.
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

/// A schema whose members that Own... have too are the preset's.
template <class... Own>
Value from_preset(Value schema) {
    (mark_members_of<Own>(*schema.find("properties")), ...);
    return schema;
}

Value leaf_params_schema() { return from_preset<LeafShape, LeafPalette>(schema<LeafParams>()); }

Value tree_params_schema() { return from_preset<TreeLook>(schema<TreeParams>()); }

Value version_member() {
    return object(
        {{"type", "string"}, {"description", "Version token; another than today's is 410."}});
}

/// A mix as a body has it.
Value mix_schema() {
    return object({{"type", "object"},
                   {"minProperties", 1},
                   {"maxProperties", most_species},
                   {"additionalProperties", object({{"type", "number"}, {"exclusiveMinimum", 0}})},
                   {"description", "Species ids and their weights."}});
}

/// Body of POST /v1/mushrooms.glb: mix or model, beside the nested parameters.
Value order_schema() {
    Value out = schema<MushroomParams>();
    Value properties = object({
        {"mix", mix_schema()},
        {"model", with_branch_graphs(schema<Model>())},
        {"v", version_member()},
    });
    for (const auto& [key, property] : out.find("properties")->members())
        properties.set(key, property);
    out.set("properties", std::move(properties));
    out.set("oneOf", Value(Value::Array{object({{"required", Value(Value::Array{"mix"})}}),
                                        object({{"required", Value(Value::Array{"model"})}})}));
    return out;
}

/// Body of POST /v1/colonies.glb.
Value colony_order_schema() {
    Value out = schema<ColonyParams>();
    Value properties = object({{"mix", mix_schema()}, {"v", version_member()}});
    for (const auto& [key, property] : out.find("properties")->members())
        properties.set(key, property);
    out.set("properties", std::move(properties));
    out.set("required", Value(Value::Array{"mix"}));
    return out;
}

/// Body of POST /v1/leaves.glb, /v1/trees.glb.
template <class Kind>
Value preset_order_schema(Value out) {
    Value ids = Value::array();
    for (const auto& preset : Kind::presets()) ids.push(preset.id);
    Value properties = object({
        {"preset", object({{"type", "string"},
                           {"enum", std::move(ids)},
                           {"description", "What to begin with."}})},
        {"v", version_member()},
    });
    for (const auto& [key, property] : out.find("properties")->members())
        properties.set(key, property);
    out.set("properties", std::move(properties));
    out.set("required", Value(Value::Array{"preset"}));
    return out;
}

/// Body of POST /v1/morphs/{a}/{b}.glb.
Value morph_order_schema() {
    Value out = schema<MorphSpec>();
    out.find("properties")->set("v", version_member());
    return out;
}

Value list_of(Value items) { return object({{"type", "array"}, {"items", std::move(items)}}); }

Value objects(std::initializer_list<Value::Member> properties) {
    Value required = Value::array();
    for (const auto& property : properties) required.push(property.first);
    return object({{"type", "object"},
                   {"properties", object(properties)},
                   {"required", std::move(required)}});
}

Value triple() {
    return object(
        {{"type", "array"}, {"items", typed("number")}, {"minItems", 3}, {"maxItems", 3}});
}

/// What GET /v1/morphs/{a}/{b} answers.
Value morph_schema() {
    Value polyline = list_of(
        object({{"type", "array"}, {"items", typed("number")}, {"minItems", 2}, {"maxItems", 2}}));
    polyline.set("description",
                 "Points [r, y] in metres from base to apex. Point k of one species becomes point "
                 "k of the other.");
    const Value outline =
        objects({{"stem", polyline}, {"hymenium", polyline}, {"cap", std::move(polyline)}});
    Value arcs = list_of(as_written(schema<Arc>()));
    arcs.set("description", "Some of the pairs as shares of arc length, landmarks among them.");
    Value segments = list_of(as_written(schema<SegmentPair>()));
    segments.set(
        "description",
        "The limbs of both, fork on fork: entry k of one species becomes entry k of the other. "
        "Each as its template is, branching as that of seed 1.");
    const auto response = [&](Family family, std::initializer_list<Value::Member> correspondence) {
        Value out = objects({{"canonical", typed("string")},
                             {"v", typed("string")},
                             {"a", typed("string")},
                             {"b", typed("string")},
                             {"age", typed("number")},
                             {"family", object({{"const", name(family)}})}});
        for (const auto& [key, value] : correspondence) {
            out.find("properties")->set(key, value);
            out.find("required")->push(key);
        }
        return out;
    };
    return object(
        {{"oneOf",
          Value(Value::Array{
              response(Family::swept, {{"outlines", objects({{"a", outline}, {"b", outline}})},
                                       {"arcs", arcs},
                                       {"certificate", reference("schemas/certificate")}}),
              response(Family::branched,
                       {{"limbs", segments},
                        {"certificate", as_written(schema<SegmentCertificate>())}})})}});
}

}  // namespace

Value component_schemas() {
    const Value whole = typed("integer"), text = typed("string");
    const Value pair =
        object({{"type", "array"}, {"items", typed("number")}, {"minItems", 2}, {"maxItems", 2}});
    Value pair_or_null = pair;
    pair_or_null.set("type", Value(Value::Array{"array", "null"}));
    const Value text_or_null =
        object({{"type", Value(Value::Array{"string", "null"})},
                {"description",
                 "The address that makes it again; null for a model or arcs of one's own."}});
    const Value product_items =
        list_of(objects({{"id", text},
                         {"name", text},
                         {"links", object({{"type", "object"}, {"additionalProperties", text}})}}));
    Value problem = objects(
        {{"type", text}, {"title", text}, {"status", whole}, {"detail", text}, {"instance", text}});
    problem.find("properties")
        ->set("errors", list_of(objects({{"parameter", text}, {"detail", text}})));
    problem.find("properties")
        ->set("canonical", object({{"type", "string"},
                                   {"description", "On 410: the address of today's answer."}}));
    const Value links = object({{"type", "object"}, {"additionalProperties", text}});
    const Value estimate = objects({{"vertices", whole}, {"triangles", whole}, {"bytes", whole}});
    const Value bounds = objects({{"min", triple()}, {"max", triple()}});
    return object({
        {"mushroom_params", as_written(schema<MushroomParams>())},
        {"morph", morph_schema()},
        {"colony_params", as_written(schema<ColonyParams>())},
        {"colony_description",
         objects({{"canonical", text},
                  {"v", text},
                  {"mix", list_of(objects({{"id", text}, {"weight", typed("number")}}))},
                  {"made", whole},
                  {"effective", reference("schemas/colony_params")},
                  {"estimate", estimate},
                  {"bounds_m", bounds}})},
        {"leaf_params", as_written(schema<LeafParams>())},
        {"leaf_list",
         objects({{"leaves", list_of(objects({{"id", text}, {"name", text}, {"links", links}}))}})},
        {"leaf_description", objects({{"canonical", text},
                                      {"v", text},
                                      {"preset", text},
                                      {"effective", reference("schemas/leaf_params")},
                                      {"estimate", estimate},
                                      {"bounds_m", bounds}})},
        {"tree_params", as_written(schema<TreeParams>())},
        {"tree_list",
         objects({{"trees",
                   list_of(objects(
                       {{"id", text}, {"name", text}, {"order", whole}, {"links", links}}))}})},
        {"tree_description", objects({{"canonical", text},
                                      {"v", text},
                                      {"preset", text},
                                      {"effective", reference("schemas/tree_params")},
                                      {"estimate", estimate},
                                      {"bounds_m", bounds},
                                      {"matrix", list_of(list_of(typed("number")))},
                                      {"expected_twigs", typed("number")}})},
        {"mushroom_list", objects({{"mushrooms", product_items}})},
        {"colony_list", objects({{"colonies", product_items}})},
        {"certificate", as_written(schema<Certificate>())},
        {"species", as_template(with_branch_graphs(schema<Species>()))},
        {"species_list", objects({{"species", list_of(objects({{"id", text},
                                                               {"scientific_name", text},
                                                               {"common_name", text},
                                                               {"family", text},
                                                               {"form", text},
                                                               {"cap_diameter_m", pair_or_null},
                                                               {"height_m", pair},
                                                               {"substrate", text},
                                                               {"habit", text},
                                                               {"season", list_of(whole)},
                                                               {"links", links}}))}})},
        {"about",
         objects(
             {{"name", text}, {"version", text}, {"generator_version", whole}, {"links", links}})},
        {"mushroom_description",
         objects({{"canonical", text},
                  {"v", text},
                  {"mix", list_of(objects({{"id", text}, {"weight", typed("number")}}))},
                  {"effective", reference("schemas/mushroom_params")},
                  {"estimate", estimate},
                  {"bounds_m", bounds},
                  {"certificate", reference("schemas/certificate")}})},
        {"inspection",
         objects({{"generator", text},
                  {"canonical", text_or_null},
                  {"effective", typed("object")},
                  {"counts", object({{"type", "object"}, {"additionalProperties", whole}})}})},
        {"problem", std::move(problem)},
    });
}

Value response_schema(Endpoint endpoint) {
    switch (endpoint) {
        case Endpoint::root:
            return reference("schemas/about");
        case Endpoint::species_list:
            return reference("schemas/species_list");
        case Endpoint::species:
            return reference("schemas/species");
        case Endpoint::mushroom_json:
            return reference("schemas/mushroom_description");
        case Endpoint::inspect:
            return reference("schemas/inspection");
        case Endpoint::mushroom_list:
            return reference("schemas/mushroom_list");
        case Endpoint::colony_list:
            return reference("schemas/colony_list");
        case Endpoint::morph:
            return reference("schemas/morph");
        case Endpoint::leaf_list:
            return reference("schemas/leaf_list");
        case Endpoint::leaf_json:
            return reference("schemas/leaf_description");
        case Endpoint::colony_json:
            return reference("schemas/colony_description");
        case Endpoint::tree_list:
            return reference("schemas/tree_list");
        case Endpoint::tree_json:
            return reference("schemas/tree_description");
        case Endpoint::mushroom_schema:
        case Endpoint::leaf_schema:
        case Endpoint::tree_schema:
        case Endpoint::colony_schema:
        case Endpoint::openapi:
            return typed("object");
        case Endpoint::mushroom_glb:
        case Endpoint::mushroom_post:
        case Endpoint::morph_post:
        case Endpoint::colony_glb:
        case Endpoint::colony_post:
        case Endpoint::leaf_glb:
        case Endpoint::leaf_post:
        case Endpoint::tree_glb:
        case Endpoint::tree_post:
        case Endpoint::surface:
        case Endpoint::leaf_surface:
        case Endpoint::tree_surface:
        case Endpoint::asset:
            return object({{"type", "string"}, {"format", "binary"}});
        default:
            return typed("string");
    }
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

Value component_bodies(const Atlas& atlas) {
    const auto body = [](std::string_view description, Value schema, Value example) {
        return object({{"required", true},
                       {"description", description},
                       {"content", object({{"application/json",
                                            object({{"schema", std::move(schema)},
                                                    {"example", std::move(example)}})}})}});
    };
    const auto row = [](std::initializer_list<double> shares) {
        Value list = Value::array();
        for (const double share : shares) list.push(share);
        return list;
    };
    const std::string species = example_id(atlas);
    return object({
        {"mushroom_order",
         body("A mix of species, or a whole model of your own, and what is to differ.",
              order_schema(),
              object({{"mix", object({{species, 1}})}, {"age", 0.6}, {"seed", 7}}))},
        {"colony_order",
         body("A mix of species and what is to differ from its habit.", colony_order_schema(),
              object({{"mix", object({{species, 1}})}, {"count", 12}, {"seed", 7}}))},
        {"leaf_order", body("A preset and what is to differ from it.",
                            preset_order_schema<Leaves>(leaf_params_schema()),
                            object({{"preset", Leaves::presets().front().id},
                                    {"autumn", 0.5},
                                    {"venation", object({{"lobes", 7}, {"vein_deg", 40}})}}))},
        {"tree_order",
         body("A preset and what is to differ from it, also a ramification matrix of your own.",
              preset_order_schema<Trees>(tree_params_schema()),
              object({{"preset", Trees::presets().front().id},
                      {"rows", Value(Value::Array{row({0.6, 0.4}), row({0.3, 0.4, 0.3})})},
                      {"leaves", object({{"per_tip", 6}})}}))},
        {"morph_order",
         body("How far from the first species to the second, and arcs of your own.",
              morph_order_schema(),
              object({{"t", 0.4},
                      {"arcs", Value(Value::Array{object(
                                   {{"curve", name(CurveName::cap)}, {"a", 0.25}, {"b", 0.4}})})},
                      {"age", 0.6}}))},
    });
}

Value taken_body(const Route& route) {
    switch (route.endpoint) {
        case Endpoint::mushroom_post:
            return reference("requestBodies/mushroom_order");
        case Endpoint::colony_post:
            return reference("requestBodies/colony_order");
        case Endpoint::leaf_post:
            return reference("requestBodies/leaf_order");
        case Endpoint::tree_post:
            return reference("requestBodies/tree_order");
        case Endpoint::morph_post:
            return reference("requestBodies/morph_order");
        default:
            return object(
                {{"required", true},
                 {"description", "The whole file."},
                 {"content",
                  object({{route.takes, object({{"schema", object({{"type", "string"},
                                                                   {"format", "binary"}})}})}})}});
    }
}

Value query_schema(Endpoint endpoint) {
    switch (endpoint) {
        case Endpoint::species_list: {
            Value filter = schema<SpeciesFilter>();  // it has no species to take defaults from
            each_schema(filter, [](Value& one) { one.erase("x-default-from"); });
            return filter;
        }
        case Endpoint::mushroom_glb:
        case Endpoint::mushroom_json:
            return schema<MushroomParams>();
        case Endpoint::colony_glb:
        case Endpoint::colony_json:
            return schema<ColonyParams>();
        case Endpoint::leaf_glb:
        case Endpoint::leaf_json:
            return leaf_params_schema();
        case Endpoint::tree_glb:
        case Endpoint::tree_json:
            return tree_params_schema();
        case Endpoint::tree_surface:
            return from_preset<TreeLook>(schema<TreePaint>());
        case Endpoint::leaf_surface:
            return from_preset<LeafShape, LeafPalette>(schema<LeafPaint>());
        case Endpoint::morph:
            return schema<MorphParams>();
        case Endpoint::surface:
            return schema<SurfaceAddress>();
        default:
            return Value::object();
    }
}

Value mushroom_schema() { return schema_document<MushroomParams>("Parameters of a mushroom"); }

Value colony_schema() { return schema_document<ColonyParams>("Parameters of a colony"); }

Value leaf_schema() {
    return from_preset<LeafShape, LeafPalette>(schema_document<LeafParams>("Parameters of a leaf"));
}

Value tree_schema() {
    return from_preset<TreeLook>(schema_document<TreeParams>("Parameters of a tree"));
}

}  // namespace sporeprint::api
