// The documents that are made once at start and then only handed out: the page, the lists, the schemas.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "api/http/documents.h"
#include "api/http/query.h"
#include "api/http/response_builder.h"
#include "api/service.h"
#include "core/atlas/atlas.h"

namespace sporeprint::api {

/// For routes without query parameters: adds a fault for each that came.
void refuse_query(const Target& target, ValidationErrors& errors);

class StaticDocuments {
  public:
    /// options  tell the folder of the built page, and whether addresses are signed
    StaticDocuments(std::shared_ptr<const Atlas> atlas, const ResponseBuilder& responses,
                    const ServiceOptions& options);

    /// A file of the page, as the root or a document shows it; a hint in plain text where it is not installed.
    [[nodiscard]] Response page(const Request& request, std::string_view file) const;

    /// A file of the page by name.
    [[nodiscard]] Response asset(const Request& request, const std::string& file) const;

    [[nodiscard]] Response about(const Request& request, const Target& target,
                                 ValidationErrors& errors) const;
    [[nodiscard]] Response mushroom_list(const Request& request, const Target& target,
                                         ValidationErrors& errors) const;
    [[nodiscard]] Response mushroom_schema(const Request& request, const Target& target,
                                           ValidationErrors& errors) const;
    [[nodiscard]] Response colony_list(const Request& request, const Target& target,
                                       ValidationErrors& errors) const;
    [[nodiscard]] Response colony_schema(const Request& request, const Target& target,
                                         ValidationErrors& errors) const;
    [[nodiscard]] Response leaf_list(const Request& request, const Target& target,
                                     ValidationErrors& errors) const;
    [[nodiscard]] Response leaf_schema(const Request& request, const Target& target,
                                       ValidationErrors& errors) const;
    [[nodiscard]] Response tree_list(const Request& request, const Target& target,
                                     ValidationErrors& errors) const;
    [[nodiscard]] Response tree_schema(const Request& request, const Target& target,
                                       ValidationErrors& errors) const;
    [[nodiscard]] Response openapi(const Request& request, const Target& target,
                                   ValidationErrors& errors) const;

    /// The species that pass the filters of the query.
    [[nodiscard]] Response species_list(const Request& request, const Target& target,
                                        ValidationErrors& errors) const;

    /// The template of one species.
    [[nodiscard]] Response species(const Request& request, const Target& target,
                                   const std::string& id, ValidationErrors& errors) const;

    /// The page of one type of problem, which its `type` points to.
    [[nodiscard]] Response problem_type(const Request& request, const Target& target,
                                        const std::string& slug, ValidationErrors& errors) const;

  private:
    Response plain(const Request& request, const Target& target, const Document& document,
                   ValidationErrors& errors) const;

    std::shared_ptr<const Atlas> atlas_;
    const ResponseBuilder& responses_;
    std::map<std::string, Document, std::less<>> assets_, species_, problem_types_;
    Document about_, species_list_, mushroom_list_, schema_, colony_list_, colony_schema_,
        leaf_list_, leaf_schema_, tree_list_, tree_schema_, openapi_, hint_;
};

}  // namespace sporeprint::api
