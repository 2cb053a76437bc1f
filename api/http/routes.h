// The description of a route, and the table in which a request's path is looked up. Matching is
// literal, without regular expressions. Each product describes its own routes.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "api/http/message.h"
#include "core/atlas/atlas.h"
#include "core/params/value.h"

namespace sporeprint::api {

struct RouteCall;
class RouteTable;

/// The kind of a response. It decides how the response is cached, which problems it can have, and
/// whether a signature is required.
enum class RouteKind {
    page,      ///< a file of the viewer, or a page in HTML
    document,  ///< JSON about the service, computed without a job
    product,   ///< a generated file or its description; cached
    image,     ///< an image of a product; cached
    upload,    ///< a client's file, or a report about one; never cached
    record,    ///< of the library: read from or written to a database, for its owner; never cached
    health     ///< the process itself; served by `server`
};

/// The inputs of documents that are computed when the service starts.
struct DocumentInputs {
    const Atlas& atlas;
    const RouteTable& routes;
    bool signed_urls = false;
    std::string_view base_path;
    bool has_library = false;   ///< of users' species
    bool has_terrains = false;  ///< that users send
};

/// Whether a route needs a token (`Authorization: Bearer`).
enum class Access {
    open,    ///< tokens have no meaning here
    chosen,  ///< with a token there is more to see
    required
};

struct Route {
    RouteKind kind;
    const char* method;   ///< "GET" (HEAD is served too), "POST", "PUT" or "DELETE"
    const char* pattern;  ///< "/a/{name}.glb": {name} stands before a literal ending
    const char* id;       ///< operationId
    const char* summary;
    const char* media_type;             ///< of the response; empty for none
    const char* body_type = "";         ///< media types of the body, by commas
    int success = 200;                  ///< the status of a response that is no problem
    bool may_be_stored = false;         ///< 200 for what is stored already
    std::size_t most_body = 256 << 10;  ///< bytes of the request body
    std::string (*example)(const Atlas&) = nullptr;      ///< returns an example of {preset}
    const char* response_schema = nullptr;               ///< name in /components/schemas
    const char* request_body = nullptr;                  ///< name in /components/requestBodies
    Value (*query_schema)(const Atlas&) = nullptr;       ///< nested schema of the query parameters
    Value (*document)(const DocumentInputs&) = nullptr;  ///< a document without query parameters
    Plan (*plan)(RouteCall&) = nullptr;                  ///< the handler of all other routes
    bool may_be_elsewhere = false;                       ///< 404 here if it has a separate port
    Access access = Access::open;
    bool has_condition = false;        ///< If-Match is required
    bool has_etag = false;             ///< of records: responses have an entity tag
    bool has_version_in_path = false;  ///< the version token is part of a {name}, not of the query
};

/// Returns true for products, images and uploads: their responses are generated on demand at a
/// cost, and a signature is required where URLs are signed.
[[nodiscard]] bool is_generated(const Route& route);

/// Returns the media types that a route accepts as that of a request's body.
[[nodiscard]] std::vector<std::string_view> body_types(const Route& route);

/// Returns true for products and images: their responses are cached.
[[nodiscard]] bool is_cached(const Route& route);

/// The routes of one product or service, and what they add to common documents.
struct RouteGroup {
    const char* tag;          ///< of the OpenAPI document, also the first segment after /v1/
    const char* description;  ///< of that tag
    std::span<const Route> routes;
    void (*add_links)(Value& links, const Atlas& atlas) = nullptr;      ///< to GET /v1
    void (*add_schemas)(Value& schemas, const Atlas& atlas) = nullptr;  ///< /components/schemas
    void (*add_bodies)(Value& bodies, const Atlas& atlas) = nullptr;    ///< requestBodies
    /// Adds the OpenAPI parameters of {names} that no other product has.
    void (*add_parameters)(Value& parameters, const Route& route, const Atlas& atlas) = nullptr;
};

/// The result of a lookup.
struct Match {
    const Route* route = nullptr;       ///< null when the path or the method is unknown
    std::string_view pattern;           ///< of the path, whatever the method; "" if it is unknown
    std::vector<std::string> captured;  ///< in the order of the {names}
    std::string allow;  ///< every method of the path, "GET, HEAD, OPTIONS"; empty if it is unknown
};

class RouteTable {
  public:
    explicit RouteTable(std::vector<RouteGroup> groups);

    [[nodiscard]] std::span<const RouteGroup> groups() const { return groups_; }

    /// Returns the routes of all groups, in their order, except that routes of images follow the
    /// last product.
    [[nodiscard]] std::span<const Route* const> routes() const { return routes_; }

    /// Finds the route of a path and a method; HEAD counts as GET. Routes of kind `health` are not
    /// found.
    ///
    /// segments  percent-decoded, of the path below the base path
    [[nodiscard]] Match match(std::string_view method, std::span<const std::string> segments) const;

    /// Returns the path of a route that resembles an unknown path most, for suggestions; "" if none
    /// is similar.
    [[nodiscard]] std::string closest(std::span<const std::string> segments) const;

  private:
    std::vector<RouteGroup> groups_;
    std::vector<const Route*> routes_;
};

}  // namespace sporeprint::api
