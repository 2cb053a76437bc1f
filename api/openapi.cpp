#include "api/openapi.h"

#include <set>
#include <string>
#include <utility>

#include "api/catalogue.h"
#include "api/errors.h"
#include "api/mix.h"
#include "api/morphs.h"
#include "api/presets.h"
#include "api/routes.h"
#include "api/surfaces.h"
#include "core/colony/colony_order.h"
#include "core/grow/species_morph.h"
#include "core/model/request.h"
#include "core/model/species.h"
#include "core/params/schema.h"

namespace sporeprint::api {

namespace {

Value object(std::initializer_list<Value::Member> members) { return Value(Value::Object(members)); }

Value reference(std::string_view where) {
    return object({{"$ref", "#/components/" + std::string(where)}});
}

/// The leaves of a nested schema as query parameters with dotted names.
void add_query_parameters(const Value& schema, const std::string& prefix, Value& parameters) {
    const Value* properties = schema.find("properties");
    if (!properties) return;
    for (const auto& [key, leaf] : properties->members()) {
        if (leaf.find("properties")) {
            add_query_parameters(leaf, prefix + key + '.', parameters);
            continue;
        }
        if (const Value* type = leaf.find("type"); type && *type == Value("array"))
            continue;  // a list comes in a body
        Value plain = leaf;
        Value parameter = object({{"name", prefix + key}, {"in", "query"}, {"required", false}});
        if (const Value* doc = leaf.find("description")) parameter.set("description", *doc);
        plain.erase("description");
        parameter.set("schema", std::move(plain));
        parameters.push(std::move(parameter));
    }
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

Value path_parameter(std::string_view key, std::string_view doc, Value schema,
                     std::string_view example) {
    return object({{"name", key},
                   {"in", "path"},
                   {"required", true},
                   {"description", doc},
                   {"schema", std::move(schema)},
                   {"example", example}});
}

Value version_parameter() {
    return object({{"name", "v"},
                   {"in", "query"},
                   {"required", false},
                   {"description",
                    "Version token. Today's makes the answer immutable; any other is 410 with the "
                    "canonical address of today's."},
                   {"schema", object({{"type", "string"}})}});
}

std::string example_id(const Atlas& atlas) {
    if (atlas.find("amanita_muscaria") || atlas.entries().empty()) return "amanita_muscaria";
    return atlas.entries().front().species.id.string();
}

/// A second species for examples of morphs.
std::string other_id(const Atlas& atlas) {
    const std::string first = example_id(atlas);
    for (const AtlasEntry& entry : atlas.entries())
        if (entry.species.id.string() != first) return entry.species.id.string();
    return "boletus_edulis";
}

Value parameters_of(const Route& route, const Atlas& atlas) {
    Value parameters = Value::array();
    const std::string_view pattern = route.pattern;
    const Value text = object({{"type", "string"}});
    const std::string example = example_id(atlas);
    if (pattern.find("{mix}") != std::string_view::npos)
        parameters.push(path_parameter("mix",
                                       "A species id, or up to " + std::to_string(most_species) +
                                           " with weights: id:0.7,id:0.3.",
                                       text, example));
    if (pattern.find("{id}") != std::string_view::npos)
        parameters.push(path_parameter("id", "A species id.", text, example));
    if (pattern.find("{preset}") != std::string_view::npos)
        parameters.push(path_parameter("preset", "A preset's id.", text,
                                       pattern.find("/trees/") != std::string_view::npos
                                           ? Trees::presets().front().id
                                           : Leaves::presets().front().id));
    if (pattern.find("{a}") != std::string_view::npos) {
        parameters.push(path_parameter("a", "Id of the first species.", text, example));
        parameters.push(path_parameter("b", "Id of the second species.", text, other_id(atlas)));
    }
    if (pattern.find("{name}") != std::string_view::npos)
        parameters.push(path_parameter("name", "Name of the file.", text, "favicon.svg"));
    if (pattern.find("{image}") != std::string_view::npos) {
        Value names = Value::array();
        for (int i = 0; const char* one = name(static_cast<ImageKind>(i)); ++i) names.push(one);
        parameters.push(path_parameter("image", "Which image of the atlas.",
                                       object({{"type", "string"}, {"enum", names}}),
                                       "base_color"));
    }
    switch (route.endpoint) {
        case Endpoint::species_list:
            add_query_parameters(schema<SpeciesFilter>(), "", parameters);
            break;
        case Endpoint::mushroom_glb:
        case Endpoint::mushroom_json:
            add_query_parameters(schema<MushroomParams>(), "", parameters);
            parameters.push(version_parameter());
            break;
        case Endpoint::colony_glb:
        case Endpoint::colony_json:
            add_query_parameters(schema<ColonyParams>(), "", parameters);
            parameters.push(version_parameter());
            break;
        case Endpoint::leaf_glb:
        case Endpoint::leaf_json:
            add_query_parameters(leaf_params_schema(), "", parameters);
            parameters.push(version_parameter());
            break;
        case Endpoint::tree_glb:
        case Endpoint::tree_json:
            add_query_parameters(tree_params_schema(), "", parameters);
            parameters.push(version_parameter());
            break;
        case Endpoint::tree_surface:
            add_query_parameters(from_preset<TreeLook>(schema<TreePaint>()), "", parameters);
            parameters.push(version_parameter());
            break;
        case Endpoint::leaf_surface:
            add_query_parameters(from_preset<LeafShape, LeafPalette>(schema<LeafPaint>()), "",
                                 parameters);
            parameters.push(version_parameter());
            break;
        case Endpoint::morph:
            add_query_parameters(schema<MorphParams>(), "", parameters);
            parameters.push(version_parameter());
            break;
        case Endpoint::surface:
            add_query_parameters(schema<SurfaceAddress>(), "", parameters);
            parameters.push(version_parameter());
            break;
        default:
            break;
    }
    for (Value& parameter :
         parameters.items())  // a filter has no species of its own to take defaults from
        if (route.endpoint == Endpoint::species_list)
            if (Value* leaf = parameter.find("schema")) leaf->erase("x-default-from");
    return parameters;
}

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
        {"model", reference("schemas/model")},
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
    Value out = schema<MorphOrder>();
    out.find("properties")->set("v", version_member());
    return out;
}

Value list_of(Value items) { return object({{"type", "array"}, {"items", std::move(items)}}); }

Value typed(const char* type) { return object({{"type", type}}); }

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
    Value arcs = list_of(schema<Arc>());
    arcs.set("description", "Some of the pairs as shares of arc length, landmarks among them.");
    Value limbs = list_of(schema<LimbPair>());
    limbs.set(
        "description",
        "The limbs of both, fork on fork: entry k of one species becomes entry k of the other. "
        "Each as its template is, branching as that of seed 1.");
    const auto answer = [&](Family family, std::initializer_list<Value::Member> correspondence) {
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
              answer(Family::swept, {{"outlines", objects({{"a", outline}, {"b", outline}})},
                                     {"arcs", arcs},
                                     {"certificate", reference("schemas/certificate")}}),
              answer(Family::branched,
                     {{"limbs", limbs}, {"certificate", schema<LimbCertificate>()}})})}});
}

Value schemas() {
    const Value whole = typed("integer"), text = typed("string");
    const Value pair =
        object({{"type", "array"}, {"items", typed("number")}, {"minItems", 2}, {"maxItems", 2}});
    Value pair_or_null = pair;
    pair_or_null.set("type", Value(Value::Array{"array", "null"}));
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
        {"mushroom_params", schema<MushroomParams>()},
        {"mushroom_order", order_schema()},
        {"morph_order", morph_order_schema()},
        {"morph", morph_schema()},
        {"colony_params", schema<ColonyParams>()},
        {"colony_order", colony_order_schema()},
        {"colony_description",
         objects({{"canonical", text},
                  {"v", text},
                  {"mix", list_of(objects({{"id", text}, {"weight", typed("number")}}))},
                  {"made", whole},
                  {"effective", reference("schemas/colony_params")},
                  {"estimate", estimate},
                  {"bounds_m", bounds}})},
        {"leaf_params", leaf_params_schema()},
        {"leaf_order", preset_order_schema<Leaves>(leaf_params_schema())},
        {"leaf_list",
         objects({{"leaves", list_of(objects({{"id", text}, {"name", text}, {"links", links}}))}})},
        {"leaf_description", objects({{"canonical", text},
                                      {"v", text},
                                      {"preset", text},
                                      {"effective", reference("schemas/leaf_params")},
                                      {"estimate", estimate},
                                      {"bounds_m", bounds}})},
        {"tree_params", tree_params_schema()},
        {"tree_order", preset_order_schema<Trees>(tree_params_schema())},
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
        {"certificate", schema<Certificate>()},
        {"model", schema<Model>()},
        {"species", schema<Species>()},
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
                  {"canonical", text},
                  {"effective", typed("object")},
                  {"counts", object({{"type", "object"}, {"additionalProperties", whole}})}})},
        {"problem", std::move(problem)},
    });
}

Value body_schema(Endpoint endpoint) {
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
            return object({{"type", "string"}, {"format", "binary"}});
        default:
            return typed("string");
    }
}

/// Which problems a route may answer with.
std::set<int> problems_of(Endpoint endpoint) {
    switch (endpoint) {
        case Endpoint::livez:
        case Endpoint::metrics:
            return {};
        case Endpoint::readyz:
            return {503};
        case Endpoint::page:
        case Endpoint::docs:
        case Endpoint::root:
        case Endpoint::openapi:
        case Endpoint::mushroom_schema:
        case Endpoint::species_list:
        case Endpoint::leaf_list:
        case Endpoint::leaf_schema:
        case Endpoint::tree_list:
        case Endpoint::tree_schema:
        case Endpoint::colony_schema:
            return {400, 405, 414, 429, 431, 500, 503};
        case Endpoint::asset:
        case Endpoint::species:
            return {400, 404, 405, 414, 429, 431, 500, 503};
        case Endpoint::inspect:
            return {400, 405, 408, 411, 413, 414, 415, 429, 431, 500, 503, 504};
        case Endpoint::mushroom_post:
        case Endpoint::morph_post:
        case Endpoint::colony_post:
        case Endpoint::leaf_post:
        case Endpoint::tree_post:
            return {400, 404, 405, 408, 410, 411, 413, 414, 415, 422, 429, 431, 500, 503, 504};
        default:
            return {400, 404, 405, 410, 414, 422, 429, 431, 500, 503, 504};
    }
}

/// Whether a route answers with something made and kept: an upload is looked at each time.
bool is_kept(Endpoint endpoint) { return makes(endpoint) && endpoint != Endpoint::inspect; }

/// What a route takes: the schema of its body, and an example where it is JSON.
Value taken(Endpoint endpoint, const Atlas& atlas) {
    switch (endpoint) {
        case Endpoint::mushroom_post:
            return object(
                {{"schema", reference("schemas/mushroom_order")},
                 {"example",
                  object({{"mix", object({{example_id(atlas), 1}})}, {"age", 0.6}, {"seed", 7}})}});
        case Endpoint::colony_post:
            return object({{"schema", reference("schemas/colony_order")},
                           {"example", object({{"mix", object({{example_id(atlas), 1}})},
                                               {"count", 12},
                                               {"seed", 7}})}});
        case Endpoint::leaf_post:
            return object(
                {{"schema", reference("schemas/leaf_order")},
                 {"example", object({{"preset", Leaves::presets().front().id},
                                     {"autumn", 0.5},
                                     {"venation", object({{"lobes", 7}, {"vein_deg", 40}})}})}});
        case Endpoint::tree_post: {
            const auto row = [](std::initializer_list<double> shares) {
                Value list = Value::array();
                for (const double share : shares) list.push(share);
                return list;
            };
            return object(
                {{"schema", reference("schemas/tree_order")},
                 {"example",
                  object({{"preset", Trees::presets().front().id},
                          {"rows", Value(Value::Array{row({0.6, 0.4}), row({0.3, 0.4, 0.3})})},
                          {"leaves", object({{"per_tip", 6}})}})}});
        }
        case Endpoint::morph_post:
            return object(
                {{"schema", reference("schemas/morph_order")},
                 {"example",
                  object(
                      {{"t", 0.4},
                       {"arcs", Value(Value::Array{object(
                                    {{"curve", name(CurveName::cap)}, {"a", 0.25}, {"b", 0.4}})})},
                       {"age", 0.6}})}});
        default:
            return object({{"schema", object({{"type", "string"}, {"format", "binary"}})}});
    }
}

Value operation(const Route& route, const Atlas& atlas) {
    Value out = object({{"operationId", route.id}, {"summary", route.summary}});
    Value parameters = parameters_of(route, atlas);
    if (!parameters.items().empty()) out.set("parameters", std::move(parameters));
    if (*route.takes)
        out.set("requestBody",
                object({{"required", true},
                        {"content", object({{route.takes, taken(route.endpoint, atlas)}})}}));
    Value success = object({{"description", route.summary}});
    if (is_kept(route.endpoint)) {
        Value headers = Value::object();
        for (const char* header : {"ETag", "Cache-Control", "Content-Location", "Cache-Status",
                                   "Server-Timing", "X-Request-Id"})
            headers.set(header, object({{"schema", typed("string")}}));
        success.set("headers", std::move(headers));
    }
    success.set("content",
                object({{route.answers, object({{"schema", body_schema(route.endpoint)}})}}));
    Value responses = object({{"200", std::move(success)}});
    if (std::string_view(route.method) == "GET" && !problems_of(route.endpoint).empty() &&
        route.endpoint != Endpoint::readyz)
        responses.set(
            "304",
            object(
                {{"description",
                  "Not modified: the ETag of If-None-Match is today's. Nothing was generated."}}));
    for (const int status : problems_of(route.endpoint))
        responses.set(std::to_string(status),
                      reference("responses/" + std::string(problem_type(status).slug)));
    out.set("responses", std::move(responses));
    return out;
}

}  // namespace

Value mushroom_schema() { return schema_document<MushroomParams>("Parameters of a mushroom"); }

Value colony_schema() { return schema_document<ColonyParams>("Parameters of a colony"); }

Value leaf_schema() {
    return from_preset<LeafShape, LeafPalette>(schema_document<LeafParams>("Parameters of a leaf"));
}

Value tree_schema() {
    return from_preset<TreeLook>(schema_document<TreeParams>("Parameters of a tree"));
}

Value openapi(const Atlas& atlas, std::string_view version) {
    Value paths = Value::object();
    for (const Route& route : routes()) {
        const char* method = std::string_view(route.method) == "GET" ? "get" : "post";
        paths.set(route.pattern, object({{method, operation(route, atlas)}}));
    }
    Value responses = Value::object();
    for (const ProblemType& type : problem_types())
        responses.set(
            type.slug,
            object({{"description", type.meaning},
                    {"content",
                     object({{"application/problem+json",
                              object({{"schema", reference("schemas/problem")},
                                      {"example",
                                       object({{"type", std::string("/problems/") + type.slug},
                                               {"title", type.title},
                                               {"status", type.status},
                                               {"detail", type.meaning},
                                               {"instance", "8f14e45fceea167a"}})}})}})}}));
    return object({
        {"openapi", "3.1.0"},
        {"info", object({{"title", "Sporeprint"},
                         {"version", version},
                         {"description",
                          "Grows mushrooms, colonies, leaves and trees on demand and answers with "
                          "game-ready GLB files. The "
                          "same request gives the same bytes. "
                          "For pictures, never for identifying mushrooms to eat."},
                         {"license", object({{"name", "MIT"}, {"identifier", "MIT"}})}})},
        {"servers", Value(Value::Array{object({{"url", "/"}})})},
        {"security", Value::array()},
        {"paths", std::move(paths)},
        {"components", object({{"schemas", schemas()}, {"responses", std::move(responses)}})},
    });
}

}  // namespace sporeprint::api
