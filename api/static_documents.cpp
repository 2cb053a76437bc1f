#include "api/static_documents.h"

#include <utility>

#include "api/http/schemas.h"
#include "api/openapi.h"
#include "api/products/catalogue.h"
#include "api/products/context.h"
#include "api/products/mix.h"
#include "api/products/product.h"
#include "core/grow/mushroom.h"
#include "core/params/messages.h"
#include "core/params/query.h"
#include "core/params/schema.h"

#ifndef SPOREPRINT_VERSION
#error "SPOREPRINT_VERSION comes from the project's version in CMakeLists.txt"
#endif

namespace sporeprint::api {

namespace {

/// Returns a trusted text as HTML.
std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else
            out += c;
    }
    return out;
}

/// Returns the page that explains a type of problem.
std::string page_of(const ProblemType& type) {
    const std::string title = std::to_string(type.status) + ' ' + escaped(type.title);
    return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width\">\n<title>" +
           title + " · Sporeprint</title>\n</head>\n<body>\n<h1>" + title + "</h1>\n<p>" +
           escaped(type.meaning) + "</p>\n<h2>What to do</h2>\n<p>" + escaped(type.remedy) +
           "</p>\n</body>\n</html>\n";
}

}  // namespace

namespace {

/// Returns a document with a base path before the URLs in each of its `links`.
Value under(const std::string& base, Value value) {
    if (base.empty()) return value;
    if (value.is_array())
        for (Value& item : value.items()) item = under(base, std::move(item));
    if (!value.is_object()) return value;
    for (auto& [key, member] : value.members()) {
        member = under(base, std::move(member));
        if (key != "links" || !member.is_object()) continue;
        for (auto& [name, link] : member.members())
            if (link.is_string() && link.as_string().starts_with('/'))
                link = Value(base + link.as_string());
    }
    return value;
}

}  // namespace

StaticDocuments::StaticDocuments(std::shared_ptr<const Atlas> atlas,
                                 const ResponseBuilder& responses, const ServiceOptions& options,
                                 const RouteTable& routes)
    : atlas_(std::move(atlas)), responses_(responses) {
    if (!options.assets.empty()) assets_ = read_assets(options.assets);
    const std::string& base = responses_.base_path();
    const DocumentInputs inputs{
        *atlas_, routes, options.signed_urls, base, options.has_library, !options.store.empty()};
    for (const Route* const route : routes.routes())
        if (route->document)
            documents_.emplace(
                route, json_document(under(base, route->document(inputs)), route->media_type));
    species_list_ = json_document(under(base, api::species_list(*atlas_)));
    for (const ProblemType& type : problem_types())
        problem_types_.emplace(type.slug, api::document("text/html; charset=utf-8", page_of(type)));
    for (const AtlasEntry& entry : atlas_->entries())
        species_.emplace(entry.species.id.string(), api::document("application/json", entry.json));
    hint_ =
        api::document("text/plain; charset=utf-8",
                      "Sporeprint grows mushrooms. The page is not installed here; the API is:\n"
                      "  GET /v1/species\n  GET /v1/mushrooms/<species>.glb?age=0.6&seed=7\n  "
                      "GET /v1/leaves\n  GET /v1/trees\n  GET /v1/worlds\n  GET /openapi.json\n",
                      revalidated);
}

Response StaticDocuments::page(const Request& request, std::string_view file) const {
    const auto found = assets_.find(file);
    if (found != assets_.end()) return responses_.document(request, found->second);
    if (file == "index.html") return responses_.document(request, hint_);
    return responses_.problem(request, 404,
                              "the page is not installed here; the document is at /openapi.json");
}

Response StaticDocuments::asset(const Request& request, const std::string& file) const {
    const auto found = assets_.find(file);
    if (found != assets_.end()) return responses_.document(request, found->second);
    return responses_.problem(request, 404, "there is no file " + in_quotes(file));
}

Response StaticDocuments::document(const Route& route, const Request& request, const Target& target,
                                   ValidationErrors& errors) const {
    refuse_query(target, errors);
    return errors.empty() ? responses_.document(request, documents_.at(&route))
                          : responses_.problem(request, errors);
}

Response StaticDocuments::species_list(const Request& request, const Target& target,
                                       ValidationErrors& errors) const {
    SpeciesFilter filter;
    std::vector<Problem> problems;
    read_query(target.query, filter, problems);
    add_problems(problems, filter, "", false, errors);
    if (!errors.empty()) return responses_.problem(request, errors);
    return responses_.document(
        request,
        filter == SpeciesFilter{}
            ? species_list_
            : json_document(under(responses_.base_path(), api::species_list(*atlas_, filter))));
}

Response StaticDocuments::species(const Request& request, const Target& target,
                                  const std::string& id, ValidationErrors& errors) const {
    refuse_query(target, errors);
    const auto found = species_.find(id);
    if (found == species_.end()) errors.add(404, "id", unknown_species(id, *atlas_));
    return errors.empty() ? responses_.document(request, found->second)
                          : responses_.problem(request, errors);
}

Response StaticDocuments::problem_type(const Request& request, const Target& target,
                                       const std::string& slug, ValidationErrors& errors) const {
    refuse_query(target, errors);
    const auto found = problem_types_.find(slug);
    if (found == problem_types_.end()) {
        std::vector<std::string> slugs;
        for (const ProblemType& type : problem_types()) slugs.emplace_back(type.slug);
        const std::string_view meant = closest(slug, slugs);
        errors.add(404, "type",
                   "unknown type of problem " + in_quotes(slug) +
                       (meant.empty() ? "" : "; did you mean " + in_quotes(meant) + "?"));
    }
    return errors.empty() ? responses_.document(request, found->second)
                          : responses_.problem(request, errors);
}

namespace {

constexpr const char *json = "application/json", *html = "text/html", *plain = "text/plain";

Value about(const DocumentInputs& inputs) {
    Value links = Value::object();
    for (const RouteGroup& group : inputs.routes.groups())
        if (group.add_links) group.add_links(links, inputs.atlas);
    if (inputs.has_library) links.set("library", "/v1/library");
    if (inputs.has_terrains) links.set("terrains", "/v1/terrains").set("scenes", "/v1/scenes");
    Value root = Value::object();
    root.set("name", "sporeprint")
        .set("version", SPOREPRINT_VERSION)
        .set("generator_version", generator_version)
        .set("links", std::move(links));
    return root;
}

constexpr Route pages[] = {
    {.kind = RouteKind::page,
     .method = "GET",
     .pattern = "/",
     .id = "page",
     .summary = "The viewer page.",
     .media_type = html,
     .plan = [](RouteCall& call) -> Plan {
         return call.context.documents->page(call.request, "index.html");
     }},
    {.kind = RouteKind::page,
     .method = "GET",
     .pattern = "/docs",
     .id = "docs",
     .summary = "A page that shows this document.",
     .media_type = html,
     .plan = [](RouteCall& call) -> Plan {
         return call.context.documents->page(call.request, "docs.html");
     }},
    {.kind = RouteKind::page,
     .method = "GET",
     .pattern = "/editor",
     .id = "editor",
     .summary = "The page that makes a species of a photograph.",
     .media_type = html,
     .plan = [](RouteCall& call) -> Plan {
         return call.context.documents->page(call.request, "editor.html");
     }},
    {.kind = RouteKind::page,
     .method = "GET",
     .pattern = "/breed",
     .id = "breed",
     .summary = "The page that breeds species of two parents.",
     .media_type = html,
     .plan = [](RouteCall& call) -> Plan {
         return call.context.documents->page(call.request, "breed.html");
     }},
    {.kind = RouteKind::page,
     .method = "GET",
     .pattern = "/world",
     .id = "world",
     .summary =
         "The page that shows worlds: on any day, with maps, and why a fungus fruits or not.",
     .media_type = html,
     .plan = [](RouteCall& call) -> Plan {
         return call.context.documents->page(call.request, "world.html");
     }},
    {.kind = RouteKind::page,
     .method = "GET",
     .pattern = "/assets/{name}",
     .id = "asset",
     .summary = "A file of the viewer page.",
     .media_type = "application/octet-stream",
     .plan = [](RouteCall& call) -> Plan {
         return call.context.documents->asset(call.request, call.captured[0]);
     }},
    {.kind = RouteKind::document,
     .method = "GET",
     .pattern = "/v1",
     .id = "about",
     .summary = "Name, version and links.",
     .media_type = json,
     .response_schema = "about",
     .document = about},
};

constexpr Route species[] = {
    {.kind = RouteKind::document,
     .method = "GET",
     .pattern = "/v1/species",
     .id = "list_species",
     .summary = "The species of the atlas, filtered.",
     .media_type = json,
     .response_schema = "species_list",
     // A filter has no preset to take defaults from.
     .query_schema = [](const Atlas&) { return without_default_source(schema<SpeciesFilter>()); },
     .plan = [](RouteCall& call) -> Plan {
         return call.context.documents->species_list(call.request, call.target, call.errors);
     }},
    {.kind = RouteKind::document,
     .method = "GET",
     .pattern = "/v1/species/{id}",
     .id = "get_species",
     .summary = "The template of a species.",
     .media_type = json,
     .response_schema = "species",
     .plan = [](RouteCall& call) -> Plan {
         return call.context.documents->species(call.request, call.target, call.captured[0],
                                                call.errors);
     }},
};

constexpr Route references[] = {
    {.kind = RouteKind::document,
     .method = "GET",
     .pattern = "/openapi.json",
     .id = "openapi",
     .summary = "This document.",
     .media_type = json,
     .document = [](const DocumentInputs& inputs) { return openapi(inputs, SPOREPRINT_VERSION); }},
    {.kind = RouteKind::page,
     .method = "GET",
     .pattern = "/problems/{type}",
     .id = "get_problem_type",
     .summary = "What a type of problem means and what to do about it.",
     .media_type = html,
     .plan = [](RouteCall& call) -> Plan {
         return call.context.documents->problem_type(call.request, call.target, call.captured[0],
                                                     call.errors);
     }},
};

constexpr Route health[] = {
    {.kind = RouteKind::health,
     .method = "GET",
     .pattern = "/livez",
     .id = "livez",
     .summary = "Whether the process lives; never queued behind work.",
     .media_type = plain},
    {.kind = RouteKind::health,
     .method = "GET",
     .pattern = "/readyz",
     .id = "readyz",
     .summary = "Whether it takes requests: atlas loaded, one mushroom grown, neither draining nor "
                "saturated.",
     .media_type = plain},
    {.kind = RouteKind::health,
     .method = "GET",
     .pattern = "/metrics",
     .id = "metrics",
     .summary = "Counters as Prometheus text.",
     .media_type = plain,
     .may_be_elsewhere = true},
};

void add_species_schemas(Value& schemas, const Atlas&) {
    const Value text = typed("string"), whole = typed("integer");
    const Value pair =
        object({{"type", "array"}, {"items", typed("number")}, {"minItems", 2}, {"maxItems", 2}});
    Value pair_or_null = pair;
    pair_or_null.set("type", Value(Value::Array{"array", "null"}));
    schemas.set("species", as_template(with_branched_order(schema<Species>())))
        .set("species_list", objects({{"species", list_of(objects({{"id", text},
                                                                   {"scientific_name", text},
                                                                   {"common_name", text},
                                                                   {"family", text},
                                                                   {"form", text},
                                                                   {"cap_diameter_m", pair_or_null},
                                                                   {"height_m", pair},
                                                                   {"substrate", text},
                                                                   {"habit", text},
                                                                   {"season", list_of(whole)},
                                                                   {"links", map_of(text)}}))}}));
}

void add_service_schemas(Value& schemas, const Atlas&) {
    const Value text = typed("string"), whole = typed("integer");
    Value problem = objects(
        {{"type", text}, {"title", text}, {"status", whole}, {"detail", text}, {"instance", text}});
    problem.find("properties")
        ->set("errors", list_of(objects({{"parameter", text}, {"detail", text}})));
    problem.find("properties")
        ->set("canonical", object({{"type", "string"},
                                   {"description", "On 410: the address of the current file."}}));
    schemas
        .set("about", objects({{"name", text},
                               {"version", text},
                               {"generator_version", whole},
                               {"links", map_of(text)}}))
        .set("problem", std::move(problem));
}

constexpr const char* service_tag = "service";

}  // namespace

const RouteGroup page_routes = {
    .tag = service_tag, .description = "", .routes = pages, .add_schemas = add_service_schemas};

const RouteGroup species_routes = {
    .tag = "species",
    .description = "The templates that mushrooms are grown of.",
    .routes = species,
    .add_links = [](Value& links, const Atlas&) { links.set("species", "/v1/species"); },
    .add_schemas = add_species_schemas};

const RouteGroup reference_routes = {.tag = service_tag,
                                     .description = "",
                                     .routes = references,
                                     .add_links = [](Value& links, const Atlas&) {
                                         links.set("openapi", "/openapi.json").set("docs", "/docs");
                                     }};

const RouteGroup health_routes = {
    .tag = service_tag,
    .description = "The page, documents, files that are read back, and how the service is.",
    .routes = health};

}  // namespace sporeprint::api
