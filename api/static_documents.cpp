#include "api/static_documents.h"

#include <utility>

#include "api/openapi.h"
#include "api/products/catalogue.h"
#include "api/products/mix.h"
#include "api/products/presets.h"
#include "api/products/product.h"
#include "core/grow/mushroom.h"
#include "core/params/messages.h"
#include "core/params/query.h"

#ifndef SPOREPRINT_VERSION
#error "SPOREPRINT_VERSION comes from the project's version in CMakeLists.txt"
#endif

namespace sporeprint::api {

namespace {

/// Text of ours as HTML.
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

/// What a type of problem means, for a person who follows the `type` of an answer.
std::string page_of(const ProblemType& type) {
    const std::string title = std::to_string(type.status) + ' ' + escaped(type.title);
    return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width\">\n<title>" +
           title + " · Sporeprint</title>\n</head>\n<body>\n<h1>" + title + "</h1>\n<p>" +
           escaped(type.meaning) + "</p>\n<h2>What to do</h2>\n<p>" + escaped(type.remedy) +
           "</p>\n</body>\n</html>\n";
}

}  // namespace

void refuse_query(const Target& target, ValidationErrors& errors) {
    for (const auto& pair : target.query)
        errors.add(400, printable(pair.first), "unknown parameter; this route takes none");
}

namespace {

/// The same document with a base path before the addresses in each of its `links`.
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
                                 const ResponseBuilder& responses, const ServiceOptions& options)
    : atlas_(std::move(atlas)), responses_(responses) {
    if (!options.assets.empty()) assets_ = read_assets(options.assets);
    Value links = Value::object();
    links.set("species", "/v1/species");
    links.set("mushrooms", "/v1/mushrooms").set("mushroom_schema", "/v1/mushrooms/schema");
    if (atlas_->entries().size() > 1)  // an example: any two will do
        links.set("morph", "/v1/morphs/" + atlas_->entries()[0].species.id.string() + '/' +
                               atlas_->entries()[1].species.id.string());
    links.set("colonies", "/v1/colonies").set("colony_schema", "/v1/colonies/schema");
    links.set("leaves", "/v1/leaves").set("leaf_schema", "/v1/leaves/schema");
    links.set("trees", "/v1/trees").set("tree_schema", "/v1/trees/schema");
    links.set("openapi", "/openapi.json").set("docs", "/docs");
    Value root = Value::object();
    root.set("name", "sporeprint")
        .set("version", SPOREPRINT_VERSION)
        .set("generator_version", generator_version)
        .set("links", std::move(links));
    const std::string& base = responses_.base_path();
    about_ = json_document(under(base, std::move(root)));
    species_list_ = json_document(under(base, api::species_list(*atlas_)));
    mushroom_list_ = json_document(under(base, api::product_list(*atlas_, "mushrooms")));
    schema_ = json_document(api::mushroom_schema(), "application/schema+json");
    colony_list_ = json_document(under(base, api::product_list(*atlas_, "colonies")));
    colony_schema_ = json_document(api::colony_schema(), "application/schema+json");
    leaf_list_ = json_document(under(base, preset_list<Leaves>()));
    leaf_schema_ = json_document(api::leaf_schema(), "application/schema+json");
    tree_list_ = json_document(under(base, preset_list<Trees>()));
    tree_schema_ = json_document(api::tree_schema(), "application/schema+json");
    openapi_ =
        json_document(api::openapi(*atlas_, SPOREPRINT_VERSION, options.signed_addresses, base));
    for (const ProblemType& type : problem_types())
        problem_types_.emplace(type.slug, document("text/html; charset=utf-8", page_of(type)));
    for (const AtlasEntry& entry : atlas_->entries())
        species_.emplace(entry.species.id.string(), document("application/json", entry.json));
    hint_ = document("text/plain; charset=utf-8",
                     "Sporeprint grows mushrooms. The page is not installed here; the API is:\n"
                     "  GET /v1/species\n  GET /v1/mushrooms/<species>.glb?age=0.6&seed=7\n  "
                     "GET /v1/leaves\n  GET /v1/trees\n  GET /openapi.json\n",
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

Response StaticDocuments::plain(const Request& request, const Target& target,
                                const Document& document, ValidationErrors& errors) const {
    refuse_query(target, errors);
    return errors.empty() ? responses_.document(request, document)
                          : responses_.problem(request, errors);
}

Response StaticDocuments::about(const Request& request, const Target& target,
                                ValidationErrors& errors) const {
    return plain(request, target, about_, errors);
}

Response StaticDocuments::mushroom_list(const Request& request, const Target& target,
                                        ValidationErrors& errors) const {
    return plain(request, target, mushroom_list_, errors);
}

Response StaticDocuments::mushroom_schema(const Request& request, const Target& target,
                                          ValidationErrors& errors) const {
    return plain(request, target, schema_, errors);
}

Response StaticDocuments::colony_list(const Request& request, const Target& target,
                                      ValidationErrors& errors) const {
    return plain(request, target, colony_list_, errors);
}

Response StaticDocuments::colony_schema(const Request& request, const Target& target,
                                        ValidationErrors& errors) const {
    return plain(request, target, colony_schema_, errors);
}

Response StaticDocuments::leaf_list(const Request& request, const Target& target,
                                    ValidationErrors& errors) const {
    return plain(request, target, leaf_list_, errors);
}

Response StaticDocuments::leaf_schema(const Request& request, const Target& target,
                                      ValidationErrors& errors) const {
    return plain(request, target, leaf_schema_, errors);
}

Response StaticDocuments::tree_list(const Request& request, const Target& target,
                                    ValidationErrors& errors) const {
    return plain(request, target, tree_list_, errors);
}

Response StaticDocuments::tree_schema(const Request& request, const Target& target,
                                      ValidationErrors& errors) const {
    return plain(request, target, tree_schema_, errors);
}

Response StaticDocuments::openapi(const Request& request, const Target& target,
                                  ValidationErrors& errors) const {
    return plain(request, target, openapi_, errors);
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

}  // namespace sporeprint::api
