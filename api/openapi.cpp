#include "api/openapi.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "api/http/documents.h"
#include "api/http/errors.h"
#include "api/http/routes.h"
#include "api/http/schemas.h"
#include "api/http/text.h"
#include "api/products/mix.h"
#include "core/params/describe.h"
#include "core/plant/wood.h"

namespace sporeprint::api {

namespace {

/// The tag of images, which occur in several products.
constexpr const char* image_tag = "images";
constexpr const char* image_tag_description = "Images that files with textures=linked point to.";

const char* tag_of(const RouteGroup& group, const Route& route) {
    return route.kind == RouteKind::image ? image_tag : group.tag;
}

bool is_get(const Route& route) { return std::string_view(route.method) == "GET"; }

/// Adds the leaves of a nested schema as query parameters with dotted names.
void add_query_parameters(const Value& schema, const std::string& prefix, Value& parameters) {
    const Value* properties = schema.find("properties");
    if (!properties) return;
    for (const auto& [key, leaf] : properties->members()) {
        if (leaf.find("properties")) {
            add_query_parameters(leaf, prefix + key + '.', parameters);
            continue;
        }
        if (const Value* type = leaf.find("type"); type && *type == Value("array"))
            continue;  // lists are possible in bodies only
        Value plain = leaf;
        const Value* const required = schema.find("required");
        const bool is_required =
            required != nullptr &&
            std::ranges::find(required->items(), Value(key)) != required->items().end();
        Value parameter =
            object({{"name", prefix + key}, {"in", "query"}, {"required", is_required}});
        if (const Value* doc = leaf.find("description")) parameter.set("description", *doc);
        plain.erase("description");
        parameter.set("schema", std::move(plain));
        parameters.push(std::move(parameter));
    }
}

Value query_parameter(std::string_view key, bool is_required, std::string_view doc, Value schema) {
    return object({{"name", key},
                   {"in", "query"},
                   {"required", is_required},
                   {"description", doc},
                   {"schema", std::move(schema)}});
}

Value parameters_of(const RouteGroup& group, const Route& route, const DocumentInputs& inputs) {
    const Atlas& atlas = inputs.atlas;
    Value parameters = Value::array();
    const std::string_view pattern = route.pattern;
    const Value text = typed("string");
    const std::string example = example_id(atlas);
    const auto has = [&](const char* capture) {
        return pattern.find(capture) != std::string_view::npos;
    };
    const std::string of_library =
        inputs.has_library ? " Of the library: ~owner.name@3, the newest version without a number, "
                             "or ~owner.name@draft with a token or the key of a share."
                           : "";
    if (has("{mix}"))
        parameters.push(path_parameter("mix",
                                       "A species id, or up to " + std::to_string(most_species) +
                                           " with weights: id:0.7,id:0.3." + of_library,
                                       text, example));
    if (has("{id}")) parameters.push(path_parameter("id", "A species id.", text, example));
    if (has("{preset}"))
        parameters.push(path_parameter("preset", "A preset's id.", text, route.example(atlas)));
    if (has("{a}")) {
        parameters.push(
            path_parameter("a", "Id of the first species." + of_library, text, example));
        parameters.push(
            path_parameter("b", "Id of the second species." + of_library, text, other_id(atlas)));
    }
    if (has("{wood}")) {
        Value names = Value::array();
        for (const Substrate wood : all_woods) names.push(name(wood));
        parameters.push(path_parameter("wood", "The tree that the wood is of.",
                                       object({{"type", "string"}, {"enum", names}}),
                                       name(all_woods.front())));
    }
    if (has("{name}"))
        parameters.push(path_parameter("name", "Name of the file.", text, "favicon.svg"));
    if (has("{photo}"))
        parameters.push(path_parameter("photo", "The secret name of a photograph.", text,
                                       "AAAAAAAAAAAAAAAAAAAAAA"));
    if (has("{terrain}"))
        parameters.push(path_parameter("terrain", "The id of a terrain.", text,
                                       "t-0123456789abcdef0123456789abcdef"));
    if (has("{species}"))
        parameters.push(path_parameter("species",
                                       "A species of the library: ~owner.name, or ~owner.name@3.",
                                       text, "~kaja.red_bolete"));
    if (has("{lod}"))
        parameters.push(path_parameter("lod", "A level of detail that is baked.", text, "0"));
    if (has("{share}"))
        parameters.push(path_parameter("share", "The id of a key.", text, "abcdefgh"));
    if (has("{token}"))
        parameters.push(path_parameter("token", "The id of a token.", text, "abcdefgh"));
    if (route.has_condition)
        parameters.push(
            object({{"name", "If-Match"},
                    {"in", "header"},
                    {"required", true},
                    {"description", "The entity tag of the draft that was read, or * for any."},
                    {"schema", text}}));
    if (has("{type}"))
        parameters.push(path_parameter("type", "What follows /problems/ in a problem's `type`.",
                                       text, problem_types().front().slug));
    if (has("{image}")) {
        Value names = Value::array();
        // The base colour alone has alpha, and is a PNG file.
        const bool is_png = pattern.ends_with(".png");
        for (int i = 0; const char* one = name(static_cast<ImageKind>(i)); ++i)
            if (!is_png || static_cast<ImageKind>(i) == ImageKind::base_color) names.push(one);
        parameters.push(path_parameter("image", "Which image of the atlas.",
                                       object({{"type", "string"}, {"enum", names}}),
                                       "base_color"));
    }
    if (route.query_schema) add_query_parameters(route.query_schema(atlas), "", parameters);
    if (group.add_parameters) group.add_parameters(parameters, route, atlas);
    if (is_cached(route) && is_get(route) && !route.has_version_in_path)
        parameters.push(query_parameter(
            "v", false,
            "Version token. Today's makes the answer immutable; any other is 410 with the "
            "canonical address of today's.",
            text));
    if (inputs.signed_urls && is_generated(route)) {
        parameters.push(
            query_parameter("key", true, "Id of the key that signed the address.", text));
        parameters.push(query_parameter("expires", false,
                                        "Until when the address is good, in seconds since 1970.",
                                        object({{"type", "integer"}, {"minimum", 0}})));
        parameters.push(query_parameter(
            "sig", true, "The signature: the last parameter, after key and expires.", text));
    }
    return parameters;
}

// --- Responses --------------------------------------------------------------------------

/// A header of responses. `is_required` is true if it is always present.
struct HeaderInfo {
    const char* name;
    const char* description;
    const char* type = "string";
};

constexpr std::array<HeaderInfo, 18> header_infos = {{
    {"Accept-Ranges", "`bytes`, where a single range of the body can be asked for."},
    {"Allow", "Every method of the route."},
    {"Cache-Control", "How long the answer may be kept."},
    {"Cache-Status",
     "Which of the service's caches knew the answer, RFC 9211; the last is the answer's own."},
    {"Content-Disposition", "A file name for whoever saves the answer."},
    {"Content-Encoding", "`gzip`, where the client accepts it and the body gains by it."},
    {"Content-Location", "The canonical address of what was made, with today's version."},
    {"Content-Range", "Which bytes of how many; of how many, where there are none in the range."},
    {"ETag", "Names this representation; the same tag, the same bytes."},
    {"Location", "Where the new thing is."},
    {"RateLimit", "What is left of the client's share of work, where there is a limit."},
    {"RateLimit-Policy", "The client's share of work, where there is a limit."},
    {"Retry-After", "Seconds to wait.", "integer"},
    {"Server-Timing", "Milliseconds per step of the work."},
    {"Vary", "Which headers of the request choose among representations."},
    {"X-Request-Id", "The request in the log."},
    {"X-Content-Type-Options", "`nosniff`."},
    {"Access-Control-Allow-Origin", "Which pages may read the answer."},
}};

/// Returns references to the headers of a response. A '?' at the end of a name marks a header that
/// is not always present.
Value headers_of(std::initializer_list<std::string_view> names) {
    Value headers = Value::object();
    for (std::string_view name : names) {
        const bool is_optional = name.ends_with('?');
        if (is_optional) name.remove_suffix(1);
        headers.set(name, reference("headers/" + std::string(is_optional ? "" : "always-") +
                                    std::string(name)));
    }
    return headers;
}

Value component_headers() {
    Value headers = Value::object();
    for (const bool is_required : {false, true})
        for (const HeaderInfo& info : header_infos)
            headers.set((is_required ? "always-" : "") + std::string(info.name),
                        object({{"description", info.description},
                                {"required", is_required},
                                {"schema", typed(info.type)}}));
    return headers;
}

/// Returns the statuses of the problems that a route can respond with.
std::set<int> problems_of(const Route& route, bool is_signed, bool has_library) {
    std::set<int> problems = {400, 405, 408, 414, 429, 431, 500, 503};  // of all routes
    switch (route.kind) {
        case RouteKind::health:
            if (route.may_be_elsewhere) problems.insert(404);
            return problems;
        case RouteKind::document:
            problems.insert(412);
            if (std::string_view(route.pattern).find('{') != std::string_view::npos)
                problems.insert(404);
            if (route.query_schema) problems.insert(422);
            return problems;
        case RouteKind::page:
            problems.insert({404, 412});
            return problems;
        case RouteKind::upload:
            // What a path or a body in JSON names may be gone.
            if (*route.body_type == '\0' || route.request_body) problems.insert(404);
            if (*route.body_type != '\0') problems.insert({411, 413, 415, 422, 504});
            break;
        case RouteKind::record:
            problems.insert({404, 504});
            if (route.access != Access::open) problems.insert({401, 403});
            if (std::string_view(route.pattern).find("{species}") != std::string_view::npos)
                problems.insert(410);
            if (route.has_condition) problems.insert({412, 428});
            if (is_get(route) && route.has_etag) problems.insert(412);
            if (*route.body_type != '\0') problems.insert({409, 411, 413, 415, 422, 507});
            break;
        case RouteKind::product:
        case RouteKind::image:
            problems.insert({404, 410, 412, 422, 504});
            if (has_library) problems.insert(401);
            if (!is_get(route)) problems.insert({411, 413, 415});
            break;
    }
    if (is_signed) problems.insert(403);
    return problems;
}

/// Returns true if ranges of the body may be requested: for files that are not compressed on
/// demand. A range of a response to POST is never sent.
bool has_ranges(const Route& route) {
    return is_get(route) && route.kind != RouteKind::upload &&
           (route.kind != RouteKind::record || route.has_etag) && !compressible(route.media_type);
}

Value success_headers(const Route& route, bool is_signed) {
    Value headers = Value::object();
    const auto add = [&](std::initializer_list<std::string_view> names) {
        const Value more = headers_of(names);
        for (const auto& [key, value] : more.members()) headers.set(key, value);
    };
    if (route.kind == RouteKind::health) {
        add({"Cache-Control", "X-Request-Id"});
        return headers;
    }
    add({"Cache-Control", "X-Request-Id", "X-Content-Type-Options", "Access-Control-Allow-Origin?",
         "Vary?", "Content-Encoding?"});
    if (is_generated(route)) add({"Server-Timing?", "RateLimit?", "RateLimit-Policy?"});
    if (route.success == 201) add({"Location"});
    if (route.kind == RouteKind::upload) return headers;
    if (route.kind == RouteKind::record) {
        if (route.has_etag) add({"ETag"});
        return headers;
    }
    add({"ETag"});
    if (has_ranges(route)) add({"Accept-Ranges?"});
    if (!is_cached(route)) return headers;
    add({"Cache-Status", "Content-Disposition"});
    if (!is_signed) {
        // The request of a body may have no URL.
        add({is_get(route) ? "Content-Location" : "Content-Location?"});
    }
    return headers;
}

/// Returns the schema of the body of a response that is no problem.
Value response_schema(const Route& route) {
    const std::string_view type = route.media_type;
    if (route.response_schema) return reference(std::string("schemas/") + route.response_schema);
    if (type.ends_with("json")) return typed("object");
    if (type.starts_with("text/")) return typed("string");
    return object({{"type", "string"}, {"format", "binary"}});
}

/// Returns the request body of a route that has one.
Value request_body(const Route& route) {
    if (route.request_body) return reference(std::string("requestBodies/") + route.request_body);
    const Value file = object({{"type", "string"}, {"format", "binary"}});
    Value content = Value::object();
    for (const std::string_view type : body_types(route))
        content.set(type, object({{"schema", file}}));
    return object(
        {{"required", true}, {"description", "The whole file."}, {"content", std::move(content)}});
}

/// Returns the media types of a response that is no problem, each with its schema.
Value success_content(const Route& route) {
    const Value schema = response_schema(route);
    const std::string_view pattern = route.pattern;
    Value content = Value::object();
    // Files of the page have many types; without an installed page the root is plain text.
    content.set(pattern == "/assets/{name}" ? "*/*" : route.media_type,
                object({{"schema", schema}}));
    if (pattern == "/") content.set("text/plain", object({{"schema", schema}}));
    return content;
}

std::string description(const Route& route, bool is_head, bool is_signed) {
    std::string text = route.summary;
    if (is_head)
        return text +
               " Answers with the headers of GET and no body; nothing is made for it, and "
               "Content-Length is told only of what is kept.";
    if (is_cached(route))
        text +=
            " The same request gives the same bytes. The key of the answer is known before it "
            "is made, so a condition that holds costs nothing.";
    if (is_cached(route) && is_get(route) && !is_signed)
        text += " Content-Location is the canonical address.";
    if (is_signed && is_generated(route)) text += " The address has to be signed.";
    return text;
}

/// Returns the alternatives of what a request to a route has to carry; none if it needs nothing.
Value security_of(const Route& route, const DocumentInputs& inputs) {
    Value security = Value::array();
    Value needed = Value::object();
    if (inputs.signed_urls && is_generated(route)) needed.set("signature", Value::array());
    // A token is needed for what is not public; of products, drafts.
    const bool is_product = route.kind == RouteKind::product || route.kind == RouteKind::image;
    const bool takes_token = route.access != Access::open || (inputs.has_library && is_product);
    if (takes_token ? route.access != Access::required : !needed.members().empty())
        security.push(needed);
    if (takes_token) security.push(std::move(needed.set("token", Value::array())));
    return security;
}

/// Returns the operation of a route; for GET also that of HEAD.
Value operation(const RouteGroup& group, const Route& route, const DocumentInputs& inputs,
                bool is_head) {
    const bool is_signed = inputs.signed_urls;
    Value out = object({{"operationId", (is_head ? "head_" : "") + std::string(route.id)},
                        {"summary", route.summary},
                        {"description", description(route, is_head, is_signed)},
                        {"tags", Value(Value::Array{tag_of(group, route)})}});
    Value parameters = parameters_of(group, route, inputs);
    if (!parameters.items().empty()) out.set("parameters", std::move(parameters));
    if (*route.body_type) out.set("requestBody", request_body(route));
    Value security = security_of(route, inputs);
    if (!security.items().empty()) out.set("security", std::move(security));

    Value responses = Value::object();
    Value success =
        object({{"description", is_head ? "It is there; these are its headers." : route.summary},
                {"headers", success_headers(route, is_signed)}});
    if (!is_head && *route.media_type != '\0') success.set("content", success_content(route));
    if (!is_head && has_ranges(route)) {
        Value part = success;
        part.set("description", "The range of bytes that was asked for.");
        part.find("headers")->set("Content-Range", reference("headers/always-Content-Range"));
        responses.set("206", std::move(part));
    }
    if (route.may_be_stored) {
        Value known = success;
        known.set("description", "It is stored already.");
        responses.set("200", std::move(known));
    }
    responses.set(std::to_string(route.success), std::move(success));
    std::set<int> problems = problems_of(route, is_signed, inputs.has_library);
    if (is_get(route) && route.kind != RouteKind::health && route.kind != RouteKind::upload &&
        (route.kind != RouteKind::record || route.has_etag))
        responses.set("304", reference("responses/not-modified"));
    if (!is_head && has_ranges(route)) problems.insert(416);
    for (const int status : problems) {
        const bool is_withdrawn = status == 410 && route.kind == RouteKind::record;
        responses.set(
            std::to_string(status),
            reference("responses/" +
                      std::string(is_withdrawn ? "withdrawn" : problem_type(status).slug)));
    }
    out.set("responses", std::move(responses));
    return out;
}

Value component_responses() {
    Value responses = object(
        {{"not-modified",
          object({{"description",
                   "Not modified: the ETag of If-None-Match is today's. Nothing was made."},
                  {"headers", headers_of({"ETag", "Cache-Control", "X-Request-Id", "Cache-Status?",
                                          "Content-Location?", "Vary?"})}})}});
    for (const ProblemType& type : problem_types()) {
        if (type.status == 501) continue;  // for methods without operations
        Value headers = headers_of({"Cache-Control", "X-Request-Id", "Access-Control-Allow-Origin?",
                                    "X-Content-Type-Options?"});
        const auto add = [&](const char* name, bool is_required) {
            headers.set(name,
                        reference(std::string("headers/") + (is_required ? "always-" : "") + name));
        };
        if (type.status == 405) add("Allow", true);
        if (type.status == 416) add("Content-Range", true);
        if (type.status == 429 || type.status == 503) add("Retry-After", true);
        if (type.status == 422 || type.status == 429 || type.status == 503 || type.status == 504)
            for (const char* name : {"RateLimit", "RateLimit-Policy"}) add(name, false);
        responses.set(
            type.slug,
            object({{"description", std::string(type.meaning) + ' ' + type.remedy},
                    {"headers", std::move(headers)},
                    {"content",
                     object({{"application/problem+json",
                              object({{"schema", reference("schemas/problem")},
                                      {"example",
                                       object({{"type", std::string("/problems/") + type.slug},
                                               {"title", type.title},
                                               {"status", type.status},
                                               {"detail", type.meaning},
                                               {"instance", "8f14e45fceea167a"}})}})}})}}));
    }
    return responses;
}

/// Returns the members of `headers` to which `document` refers.
Value used_headers(const Value& document, const Value& headers) {
    std::set<std::string> used;
    const auto walk = [&](const auto& again, const Value& value) -> void {
        if (value.is_array())
            for (const Value& item : value.items()) again(again, item);
        if (!value.is_object()) return;
        for (const auto& [key, member] : value.members()) {
            if (key == "$ref") used.insert(member.as_string());
            again(again, member);
        }
    };
    walk(walk, document);
    Value cached = Value::object();
    for (const auto& [name, header] : headers.members())
        if (used.contains("#/components/headers/" + name)) cached.set(name, header);
    return cached;
}

/// Returns the security scheme of signed URLs.
Value signature_scheme() {
    return object({{"type", "apiKey"},
                   {"in", "query"},
                   {"name", "sig"},
                   {"description",
                    "Addresses of what is made are signed: they end with key, expires if they do, "
                    "and sig, in "
                    "this order. Whoever runs the service gives them out."}});
}

/// Returns the security scheme of tokens.
Value token_scheme() {
    return object(
        {{"type", "http"},
         {"scheme", "bearer"},
         {"description",
          "A token of an owner of species, spk_ and 52 characters. Whoever runs the service "
          "gives out the first one. For a draft named ~owner.name@draft also the key of a "
          "share."}});
}

}  // namespace

Value openapi(const DocumentInputs& inputs, std::string_view version) {
    const bool is_signed = inputs.signed_urls;
    std::map<const Route*, const RouteGroup*> group_of;
    Value tags = Value::array(), schemas = Value::object(), bodies = Value::object();
    const auto add_tag = [&](const char* name, const char* description) {
        tags.push(object({{"name", name}, {"description", description}}));
    };
    const auto is_product = [](const RouteGroup& group) {
        return std::any_of(group.routes.begin(), group.routes.end(), is_cached);
    };
    for (const RouteGroup& group : inputs.routes.groups()) {
        for (const Route& route : group.routes) group_of.emplace(&route, &group);
        if (group.add_schemas) group.add_schemas(schemas, inputs.atlas);
        if (group.add_bodies) group.add_bodies(bodies, inputs.atlas);
        if (is_product(group)) add_tag(group.tag, group.description);
    }
    add_tag(image_tag, image_tag_description);
    for (const RouteGroup& group : inputs.routes.groups())
        if (!is_product(group) && *group.description) add_tag(group.tag, group.description);
    Value paths = Value::object();
    for (const Route* const route : inputs.routes.routes()) {
        const RouteGroup& group = *group_of.at(route);
        const Value* const others = paths.find(route->pattern);
        Value item = others ? *others : Value::object();
        item.set(lower(route->method), operation(group, *route, inputs, false));
        if (is_get(*route)) item.set("head", operation(group, *route, inputs, true));
        paths.set(route->pattern, std::move(item));
    }
    Value components = object({{"schemas", std::move(schemas)},
                               {"requestBodies", std::move(bodies)},
                               {"responses", component_responses()}});
    Value schemes = object({{"token", token_scheme()}});
    if (is_signed) schemes.set("signature", signature_scheme());
    components.set("securitySchemes", std::move(schemes));
    Value document = object({
        {"openapi", "3.1.0"},
        {"info", object({{"title", "Sporeprint"},
                         {"version", version},
                         {"description",
                          "Grows mushrooms, colonies, leaves and trees on demand and answers with "
                          "game-ready GLB files. The "
                          "same request gives the same bytes. "
                          "For pictures, never for identifying mushrooms to eat."},
                         {"license", object({{"name", "MIT"}, {"identifier", "MIT"}})}})},
        {"servers",
         Value(Value::Array{
             object({{"url", std::string(inputs.base_path.empty() ? "/" : inputs.base_path)}})})},
        {"security", Value::array()},
        {"tags", std::move(tags)},
        {"paths", std::move(paths)},
        {"components", std::move(components)},
    });
    Value headers = used_headers(document, component_headers());
    document.find("components")->set("headers", std::move(headers));
    return document;
}

}  // namespace sporeprint::api
