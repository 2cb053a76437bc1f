#include "api/http/response_builder.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "api/http/conditions.h"
#include "api/http/encoding.h"
#include "api/http/ranges.h"
#include "api/http/text.h"

namespace sporeprint::api {

namespace {

constexpr const char* exposed_headers =
    "Accept-Ranges, Cache-Status, Content-Disposition, Content-Encoding, Content-Length, "
    "Content-Location, Content-Range, ETag, Location, RateLimit, RateLimit-Policy, Retry-After, "
    "Server-Timing, X-Request-Id";

/// The permissions of pages: their own scripts and styles, WebAssembly for the decoder of compressed
/// geometry, images that they create themselves, no embedding in frames. The pages contain the same
/// policy in HTML, but that cannot forbid frames.
constexpr std::pair<const char*, const char*> page_headers[] = {
    {"Content-Security-Policy",
     "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; img-src 'self' blob: data:; "
     "connect-src 'self' blob:; object-src 'none'; base-uri 'none'; form-action 'none'; "
     "frame-ancestors 'none'"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Permissions-Policy", "camera=(), geolocation=(), microphone=()"},
    {"Referrer-Policy", "same-origin"}};

bool proper_id(std::string_view id) {
    return !id.empty() && id.size() <= 64 && std::all_of(id.begin(), id.end(), [](char c) {
        return (c >= '0' && c <= '9') || (lower(c) >= 'a' && lower(c) <= 'z') || c == '_' ||
               c == '-';
    });
}

}  // namespace

std::string_view header_of(const Response& response, std::string_view name) {
    for (const auto& [key, value] : response.headers)
        if (same_word(key, name)) return value;
    return {};
}

void set_header(Response& response, std::string_view name, std::string value) {
    for (auto& [key, old] : response.headers)
        if (same_word(key, name)) {
            old = std::move(value);
            return;
        }
    response.headers.emplace_back(std::string(name), std::move(value));
}

std::string take_header(Response& response, std::string_view name) {
    const auto found =
        std::find_if(response.headers.begin(), response.headers.end(),
                     [&](const Header& header) { return same_word(header.first, name); });
    if (found == response.headers.end()) return {};
    std::string value = std::move(found->second);
    response.headers.erase(found);
    return value;
}

std::size_t weight_of(const Response& response) {
    std::size_t bytes =
        size_of(response.body) + sizeof(Response) + response.body.size() * (sizeof(Slice) + 64);
    for (const auto& [name, value] : response.headers)
        bytes += name.size() + value.size() + 2 * sizeof(Header);
    return bytes;
}

std::string cache_control(bool versioned) {
    return versioned ? immutable_for_a_year : cached_for_an_hour;
}

Response private_json(const Value& body, int status) {
    Response response;
    response.status = status;
    response.headers = {{"Content-Type", "application/json"}, {"Cache-Control", private_to_client}};
    response.body = {slice_of(dump(body))};
    return response;
}

Response no_content() {
    Response response;
    response.status = 204;
    response.has_body = false;
    response.headers = {{"Cache-Control", "no-store"}};
    return response;
}

void bound_freshness(Response& response, std::int64_t seconds_left) {
    constexpr std::string_view age = "max-age=";
    const std::string_view given = header_of(response, "Cache-Control");
    const std::size_t at = given.find(age);
    if (at == std::string_view::npos) return;
    std::int64_t seconds = 0;
    std::from_chars(given.data() + at + age.size(), given.data() + given.size(), seconds);
    seconds = std::clamp<std::int64_t>(seconds_left, 0, seconds);
    // `public` and not `private`: the signature is part of the URL and so of the key in every
    // cache, hence a shared cache sends the response only to clients that have the signed URL.
    // `s-maxage` would repeat max-age. `must-revalidate` forbids stale responses when the server
    // cannot be reached, which RFC 9111 section 4.2.4 otherwise allows. `immutable` and
    // `stale-while-revalidate` are left out, so that no cache serves the response after the URL has
    // expired.
    set_header(response, "Cache-Control",
               "public, max-age=" + std::to_string(seconds) + ", must-revalidate");
}

std::vector<std::string> current_etags(const Request& request, const std::string& etag,
                                       std::string_view content_type) {
    if (compressible(content_type) && accepts_gzip(request)) return {gzip_etag(etag), etag};
    return {etag};
}

void ResponseBuilder::add_common_headers(const Request& request, Response& response) const {
    if (proper_id(request.id)) set_header(response, "X-Request-Id", request.id);
    if (!allow_origin_.empty()) {
        set_header(response, "Access-Control-Allow-Origin", allow_origin_);
        set_header(response, "Access-Control-Expose-Headers", exposed_headers);
        set_header(response, "Timing-Allow-Origin", allow_origin_);
    }
    set_header(response, "Cross-Origin-Resource-Policy", "cross-origin");
    set_header(response, "X-Content-Type-Options", "nosniff");
}

Response ResponseBuilder::problem(const Request& request, int status, std::string_view detail,
                                  std::span<const Problem> problems,
                                  const Value::Object& more) const {
    Response response = problem_response(request, status, detail, problems, more, base_path_);
    add_common_headers(request, response);
    return response;
}

Response ResponseBuilder::problem(const Request& request, const ValidationErrors& errors) const {
    return problem(request, errors.status(), {}, errors.problems());
}

Response ResponseBuilder::to_page(const Request& request, std::string_view query) const {
    Response response;
    response.status = 308;
    response.headers = {{"Location", base_path_ + '/' + std::string(query)},
                        {"Cache-Control", cached_for_an_hour}};
    add_common_headers(request, response);
    return response;
}

void ResponseBuilder::represent(const Request& request, Response& response,
                                const Document* ready) const {
    const std::string type(header_of(response, "Content-Type"));
    if (compressible(type)) {
        set_header(response, "Vary", "Accept-Encoding");
        if (accepts_gzip(request)) {
            const std::string etag(header_of(response, "ETag"));
            if (!etag.empty()) set_header(response, "ETag", gzip_etag(etag));
            set_header(response, "Content-Encoding", "gzip");
            response.body = {ready ? ready->gzipped : gzip(response.body)};
        }
    } else if (response.status == 200 && request.method != "POST") {
        set_header(response, "Accept-Ranges", "bytes");
    }
    add_common_headers(request, response);
}

Response ResponseBuilder::not_modified(const Request& request, Response response,
                                       const std::string& etag) const {
    const std::string type = take_header(response, "Content-Type");
    take_header(response, "Content-Disposition");
    set_header(response, "ETag", etag);
    if (compressible(type)) set_header(response, "Vary", "Accept-Encoding");
    response.status = 304;
    response.body.clear();
    response.has_body = false;
    add_common_headers(request, response);
    return response;
}

Response ResponseBuilder::precondition_failed(const Request& request, std::string_view header,
                                              std::span<const std::string> etags) const {
    std::string current;
    for (const std::string& etag : etags) (current += current.empty() ? "" : " and ") += etag;
    return problem(request, 412,
                   std::string(header) + " does not hold: the current entity tag is " + current);
}

void ResponseBuilder::select_range(const Request& request, Response& response) const {
    if (request.method != "GET" || response.status != 200 || !response.has_body ||
        compressible(header_of(response, "Content-Type")))
        return;
    const std::optional<std::string> given = header_list(request, "Range");
    if (!given || !if_range_matches(request, header_of(response, "ETag"))) return;
    const std::size_t size = size_of(response.body);
    const std::optional<ByteRange> range = byte_range(*given, size);
    if (!range) return;
    const std::string length = '/' + std::to_string(size);
    if (range->size == 0) {
        response = problem(request, 416, "the body has " + std::to_string(size) + " bytes");
        set_header(response, "Accept-Ranges", "bytes");
        set_header(response, "Content-Range", "bytes *" + length);
        return;
    }
    response.status = 206;
    response.cacheable = false;
    response.body = part_of(response.body, *range);
    set_header(response, "Content-Range",
               "bytes " + std::to_string(range->first) + '-' +
                   std::to_string(range->first + range->size - 1) + length);
}

Response ResponseBuilder::document(const Request& request, const Document& document) const {
    Response response;
    response.headers = {{"Content-Type", document.content_type},
                        {"Cache-Control", document.cache_control},
                        {"ETag", document.etag}};
    if (document.content_type.starts_with("text/html"))
        for (const auto& [name, value] : page_headers) response.headers.emplace_back(name, value);
    const Conditions conditions(request);
    const std::vector<std::string> etags =
        current_etags(request, document.etag, document.content_type);
    if (conditions.match_fails(etags)) return precondition_failed(request, "If-Match", etags);
    if (const std::string* etag = conditions.unchanged(etags))
        return not_modified(request, std::move(response), *etag);
    if (conditions.none_match_any())
        return not_modified(request, std::move(response), etags.front());
    response.body = {document.body};
    response.cacheable = true;
    represent(request, response, &document);
    select_range(request, response);
    return response;
}

Response ResponseBuilder::options(const Request& request, const std::string& allow) const {
    Response response;
    response.status = 204;
    response.has_body = false;
    response.headers = {{"Allow", allow}, {"Cache-Control", "no-store"}};
    if (!allow_origin_.empty()) {
        set_header(response, "Access-Control-Allow-Methods", allow);
        set_header(
            response, "Access-Control-Allow-Headers",
            "Authorization, Cache-Control, Content-Type, If-Match, If-None-Match, If-Range, Range, "
            "X-Request-Id");
        set_header(response, "Access-Control-Max-Age", "86400");
    }
    add_common_headers(request, response);
    return response;
}

}  // namespace sporeprint::api
