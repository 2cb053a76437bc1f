// The documents that are made once at start and then only handed out: the page, the lists, the schemas.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "api/answers.h"
#include "api/documents.h"
#include "api/query.h"
#include "api/service.h"
#include "core/atlas/atlas.h"

namespace sporeprint::api {

/// For routes without query parameters: adds a fault for each that came.
void refuse_query(const Target& target, Faults& faults);

class Shelf {
  public:
    /// options  tell the folder of the built page, and whether addresses are signed
    Shelf(std::shared_ptr<const Atlas> atlas, const Answers& answers,
          const ServiceOptions& options);

    /// A file of the page, as the root or a document shows it; a hint in plain text where it is not installed.
    [[nodiscard]] Answer page(const Request& request, std::string_view file) const;

    /// A file of the page by name.
    [[nodiscard]] Answer asset(const Request& request, const std::string& file) const;

    [[nodiscard]] Answer about(const Request& request, const Target& target, Faults& faults) const;
    [[nodiscard]] Answer mushroom_list(const Request& request, const Target& target,
                                       Faults& faults) const;
    [[nodiscard]] Answer mushroom_schema(const Request& request, const Target& target,
                                         Faults& faults) const;
    [[nodiscard]] Answer colony_list(const Request& request, const Target& target,
                                     Faults& faults) const;
    [[nodiscard]] Answer colony_schema(const Request& request, const Target& target,
                                       Faults& faults) const;
    [[nodiscard]] Answer leaf_list(const Request& request, const Target& target,
                                   Faults& faults) const;
    [[nodiscard]] Answer leaf_schema(const Request& request, const Target& target,
                                     Faults& faults) const;
    [[nodiscard]] Answer tree_list(const Request& request, const Target& target,
                                   Faults& faults) const;
    [[nodiscard]] Answer tree_schema(const Request& request, const Target& target,
                                     Faults& faults) const;
    [[nodiscard]] Answer openapi(const Request& request, const Target& target,
                                 Faults& faults) const;

    /// The species that pass the filters of the query.
    [[nodiscard]] Answer species_list(const Request& request, const Target& target,
                                      Faults& faults) const;

    /// The template of one species.
    [[nodiscard]] Answer species(const Request& request, const Target& target,
                                 const std::string& id, Faults& faults) const;

    /// The page of one type of problem, which its `type` points to.
    [[nodiscard]] Answer problem_type(const Request& request, const Target& target,
                                      const std::string& slug, Faults& faults) const;

  private:
    Answer plain(const Request& request, const Target& target, const Document& document,
                 Faults& faults) const;

    std::shared_ptr<const Atlas> atlas_;
    const Answers& answers_;
    std::map<std::string, Document, std::less<>> assets_, species_, problem_types_;
    Document about_, species_list_, mushroom_list_, schema_, colony_list_, colony_schema_,
        leaf_list_, leaf_schema_, tree_list_, tree_schema_, openapi_, hint_;
};

}  // namespace sporeprint::api
