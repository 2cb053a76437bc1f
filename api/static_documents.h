// Documents that are computed once when the service starts: the page, lists and schemas.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "api/http/documents.h"
#include "api/http/query.h"
#include "api/http/response_builder.h"
#include "api/http/routes.h"
#include "api/http/service_options.h"
#include "core/atlas/atlas.h"

namespace sporeprint::api {

class StaticDocuments {
  public:
    /// options  contain the folder of the built page, and whether URLs are signed
    StaticDocuments(std::shared_ptr<const Atlas> atlas, const ResponseBuilder& responses,
                    const ServiceOptions& options, const RouteTable& routes);

    /// Returns an HTML file of the viewer page. If the page is not installed, returns a hint in
    /// plain text for "index.html" and 404 for other files.
    [[nodiscard]] Response page(const Request& request, std::string_view file) const;

    /// Returns a file of the viewer page by name; 404 if there is none.
    [[nodiscard]] Response asset(const Request& request, const std::string& file) const;

    /// Returns the document of a route, which was computed when the service started; 400 for a
    /// query or previous `errors`.
    ///
    /// pre  route.document is not null
    [[nodiscard]] Response document(const Route& route, const Request& request,
                                    const Target& target, ValidationErrors& errors) const;

    /// Returns the list of species that match the filters of the query; 400 for invalid filters.
    [[nodiscard]] Response species_list(const Request& request, const Target& target,
                                        ValidationErrors& errors) const;

    /// Returns the template of one species; 404 for an unknown id.
    [[nodiscard]] Response species(const Request& request, const Target& target,
                                   const std::string& id, ValidationErrors& errors) const;

    /// Returns the HTML page about one type of problem, to which the member `type` of problem+json
    /// links; 404 for an unknown slug.
    [[nodiscard]] Response problem_type(const Request& request, const Target& target,
                                        const std::string& slug, ValidationErrors& errors) const;

  private:
    std::shared_ptr<const Atlas> atlas_;
    const ResponseBuilder& responses_;
    std::map<const Route*, Document> documents_;
    std::map<std::string, Document, std::less<>> assets_, species_, problem_types_;
    Document species_list_, hint_;
};

extern const RouteGroup page_routes, species_routes, reference_routes, health_routes;

}  // namespace sporeprint::api
