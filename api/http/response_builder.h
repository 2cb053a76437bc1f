// Builds responses: common headers, problems, encodings, documents, 304, ranges.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "api/http/documents.h"
#include "api/http/errors.h"
#include "api/http/message.h"

namespace sporeprint::api {

/// Returns the value of the header with this name, in any case; empty if there is none.
[[nodiscard]] std::string_view header_of(const Response& response, std::string_view name);

/// Sets a header and replaces an earlier value.
void set_header(Response& response, std::string_view name, std::string value);

/// Removes a header and returns its value; empty if there was none.
std::string take_header(Response& response, std::string_view name);

/// Returns the number of bytes that a response takes in the cache.
[[nodiscard]] std::size_t weight_of(const Response& response);

/// Returns the Cache-Control of a response.
///
/// versioned  true if its URL contains the current version token
[[nodiscard]] std::string cache_control(bool versioned);

/// Returns a response in JSON that nobody but the client may have.
[[nodiscard]] Response private_json(const Value& body, int status = 200);

/// Returns 204: what was to be removed is gone.
[[nodiscard]] Response no_content();

/// Bounds how long the response to a URL that expires may be cached: max-age is at most the
/// remaining lifetime of the URL, and nothing permits a cache to serve it afterwards. A response
/// that must not be cached is left unchanged.
///
/// seconds_left  remaining lifetime of the URL; negative counts as 0
void bound_freshness(Response& response, std::int64_t seconds_left);

/// Returns the entity tags that are current for `request`, first that of the representation which
/// it would get. The gzip variant is current for clients that accept gzip; the identity is current
/// for all, so that a client which has it need not fetch the variant.
[[nodiscard]] std::vector<std::string> current_etags(const Request& request,
                                                     const std::string& etag,
                                                     std::string_view content_type);

/// Builds complete responses, which only have to be sent.
class ResponseBuilder {
  public:
    /// allow_origin  Access-Control-Allow-Origin of every response; empty sends none
    /// base_path     prefix of every link in a response
    explicit ResponseBuilder(std::string allow_origin, std::string base_path = {})
        : allow_origin_(std::move(allow_origin)), base_path_(std::move(base_path)) {}

    /// Returns a URL of the service as clients see it.
    [[nodiscard]] std::string link(std::string_view address) const {
        return base_path_ + std::string(address);
    }
    [[nodiscard]] const std::string& base_path() const { return base_path_; }

    /// Returns 308 from the base path itself to the page below it, whose links are relative.
    [[nodiscard]] Response to_page(const Request& request, std::string_view query) const;

    /// Adds the headers that every response has.
    void add_common_headers(const Request& request, Response& response) const;

    [[nodiscard]] Response problem(const Request& request, int status, std::string_view detail,
                                   std::span<const Problem> problems = {},
                                   const Value::Object& more = {}) const;
    [[nodiscard]] Response problem(const Request& request, const ValidationErrors& errors) const;

    /// Turns a response into the representation that the client requested: encoding, entity tags,
    /// common headers.
    ///
    /// ready  the document in the response, whose gzip variant exists already; nullptr for none
    void represent(const Request& request, Response& response,
                   const Document* ready = nullptr) const;

    /// Turns a response into 304, with the headers that its 200 would have.
    ///
    /// etag  of the representation that the client has
    [[nodiscard]] Response not_modified(const Request& request, Response response,
                                        const std::string& etag) const;

    /// Returns 412: a condition of the request is false.
    ///
    /// header  name of the header with that condition
    /// etags   the current ones
    [[nodiscard]] Response precondition_failed(const Request& request, std::string_view header,
                                               std::span<const std::string> etags) const;

    /// Turns a 200 to GET into 206 or 416 if the request has one byte range and If-Range permits
    /// it. The body is not copied. Media types that are compressed on demand have no ranges.
    void select_range(const Request& request, Response& response) const;

    /// Returns a document, or 304, 412, or a range of it.
    [[nodiscard]] Response document(const Request& request, const Document& document) const;

    /// Returns 204 to OPTIONS.
    [[nodiscard]] Response options(const Request& request, const std::string& allow) const;

  private:
    std::string allow_origin_, base_path_;
};

}  // namespace sporeprint::api
