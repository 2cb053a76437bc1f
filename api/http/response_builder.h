// How answers look: the headers that all carry, problems, encodings, documents, 304.
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

/// Value of the header of that name, any case; empty if there is none.
[[nodiscard]] std::string_view header_of(const Response& response, std::string_view name);

/// Sets a header, in place of an earlier value.
void set_header(Response& response, std::string_view name, std::string value);

/// Removes a header and returns its value; empty if there was none.
std::string take_header(Response& response, std::string_view name);

/// Bytes that keeping an answer costs.
[[nodiscard]] std::size_t weight_of(const Response& response);

/// Cache-Control of an answer whose address carries today's version token, or none.
[[nodiscard]] std::string cache_control(bool versioned);

/// Bounds how long an answer to a URL that expires may be cached: max-age is at most what is left of the life of the URL, and
/// nothing lets a cache serve it afterwards. An answer that must not be cached anyway is left as it is.
///
/// seconds_left  of the life of the URL; negative counts as 0
void bound_freshness(Response& response, std::int64_t seconds_left);

/// The entity tags of which either is current for `request`, that of the representation which it gets first. The gzip variant
/// counts for clients that accept gzip, and the identity for all: a client that has it need not fetch the variant.
[[nodiscard]] std::vector<std::string> current_etags(const Request& request,
                                                     const std::string& etag,
                                                     std::string_view content_type);

/// Finishes answers: what is left is only to send them.
class ResponseBuilder {
  public:
    /// allow_origin  Access-Control-Allow-Origin of every answer; empty sends none
    /// base_path     begins every link that an answer tells
    explicit ResponseBuilder(std::string allow_origin, std::string base_path = {})
        : allow_origin_(std::move(allow_origin)), base_path_(std::move(base_path)) {}

    /// An address of ours as clients see it.
    [[nodiscard]] std::string link(std::string_view address) const {
        return base_path_ + std::string(address);
    }
    [[nodiscard]] const std::string& base_path() const { return base_path_; }

    /// 308 from the base path itself to the page under it, whose links are relative.
    [[nodiscard]] Response to_page(const Request& request, std::string_view query) const;

    /// Headers that every answer carries.
    void add_common_headers(const Request& request, Response& response) const;

    [[nodiscard]] Response problem(const Request& request, int status, std::string_view detail,
                                   std::span<const Problem> problems = {},
                                   const Value::Object& more = {}) const;
    [[nodiscard]] Response problem(const Request& request, const ValidationErrors& errors) const;

    /// Makes the answer the representation that the client asked for: encoding, tags, common headers.
    ///
    /// ready  the document that the answer holds, whose gzip is made already; nullptr for none
    void represent(const Request& request, Response& response,
                   const Document* ready = nullptr) const;

    /// Makes 304 of an answer, with the headers that its 200 would carry.
    ///
    /// etag  of the representation that the client has
    [[nodiscard]] Response not_modified(const Request& request, Response response,
                                        const std::string& etag) const;

    /// 412: a condition of the request is false.
    ///
    /// header  that says the condition
    /// etags   those that are current
    [[nodiscard]] Response precondition_failed(const Request& request, std::string_view header,
                                               std::span<const std::string> etags) const;

    /// Makes 206 or 416 of a 200 to GET where the request has one byte range that If-Range lets through. The body is not
    /// copied. Types that are sent as gzip by demand have no ranges.
    void select_range(const Request& request, Response& response) const;

    /// A document, 304, 412, or a range of it.
    [[nodiscard]] Response document(const Request& request, const Document& document) const;

    /// 204 to OPTIONS.
    [[nodiscard]] Response options(const Request& request, const std::string& allow) const;

  private:
    std::string allow_origin_, base_path_;
};

}  // namespace sporeprint::api
