// Helpers for tests of the api module: requests, responses, JSON.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "api/http/errors.h"
#include "api/products/catalogue.h"
#include "api/routes.h"
#include "api/service.h"
#include "core/atlas/atlas.h"
#include "core/params/value.h"

namespace sporeprint::api::test {

inline Request request(std::string method, std::string target, std::vector<Header> headers = {},
                       std::string body = {}) {
    return {std::move(method), std::move(target), std::move(headers), std::move(body), "test-1"};
}

inline Request get(std::string target, std::vector<Header> headers = {}) {
    return request("GET", std::move(target), std::move(headers));
}

inline Request post(std::string body, std::string target = "/v1/mushrooms.glb",
                    std::string type = "application/json") {
    return request("POST", std::move(target), {{"Content-Type", std::move(type)}}, std::move(body));
}

inline std::string header(const Response& response, std::string_view name) {
    std::string found;
    int count = 0;
    for (const auto& [key, value] : response.headers)
        if (key == name) {
            found = value;
            ++count;
        }
    EXPECT_LE(count, 1) << name << " is sent more than once";
    return found;
}

inline std::string text_of(const Response& response) {
    std::string out;
    for (const Slice& slice : response.body)
        out.append(reinterpret_cast<const char*>(slice.data()), slice.size);
    return out;
}

inline Value json_of(const Response& response) {
    std::vector<Problem> problems;
    Value value = parse(text_of(response), problems);
    EXPECT_TRUE(problems.empty()) << text_of(response);
    return value;
}

/// Returns the plan of a request, as the server asks for it.
inline Plan plan(Service& service, const Request& request, bool correspondence_ready = false) {
    return service.plan(request, service.route(request), correspondence_ready);
}

/// Returns the largest body that the route of a request accepts, bytes.
inline std::size_t most_body(const Service& service, std::string method, std::string target) {
    return service.route(request(std::move(method), std::move(target))).most_body;
}

/// A service with the built-in atlas, for one test.
class RequestedService : public testing::Test {
  protected:
    Response ask(const Request& one) { return handle(service_, one); }
    Response ask(std::string target, std::vector<Header> headers = {}) {
        return handle(service_, get(std::move(target), std::move(headers)));
    }
    [[nodiscard]] std::uint64_t generated() const { return service_.counters().generated; }

    Service service_{built_in_atlas(), ServiceOptions{}};
};

/// Returns the document at a path of its own route.
inline Value document_at(std::string_view path) {
    for (const Route* const route : route_table().routes())
        if (route->document && path == route->pattern)
            return route->document({*built_in_atlas(), route_table(), false, {}});
    ADD_FAILURE() << "no document at " << path;
    return Value::object();
}

/// "parameter: detail" of each of a problem's errors.
inline std::vector<std::string> errors_of(const Response& response) {
    std::vector<std::string> out;
    const Value body = json_of(response);
    if (const Value* errors = body.find("errors"))
        for (const Value& error : errors->items())
            out.push_back(error.find("parameter")->as_string() + ": " +
                          error.find("detail")->as_string());
    return out;
}

/// Whether any of the errors is about `parameter` (or what is below it) and holds `words`.
inline bool names(const Response& response, std::string_view parameter,
                  std::string_view words = "") {
    for (const std::string& error : errors_of(response))
        if ((error.starts_with(std::string(parameter) + ": ") ||
             error.starts_with(std::string(parameter) + "/")) &&
            error.find(words) != std::string::npos)
            return true;
    return false;
}

/// Expects problem+json as the contract has it.
inline void expect_problem(const Response& response, int status) {
    EXPECT_EQ(response.status, status) << text_of(response);
    EXPECT_EQ(header(response, "Content-Type"), "application/problem+json");
    EXPECT_EQ(header(response, "Cache-Control"), "no-store");
    for (const char* absent : {"ETag", "Cache-Status", "Content-Location"})
        EXPECT_EQ(header(response, absent), "") << absent;
    const Value body = json_of(response);
    EXPECT_EQ(body.find("status")->as_number(), status);
    EXPECT_EQ(body.find("type")->as_string(),
              std::string("/problems/") + problem_type(status).slug);
    EXPECT_EQ(body.find("title")->as_string(), problem_type(status).title);
    EXPECT_FALSE(body.find("detail")->as_string().empty());
    EXPECT_EQ(body.find("instance")->as_string(), "test-1");
    EXPECT_EQ(header(response, "X-Request-Id"), "test-1");
    EXPECT_EQ(header(response, "Access-Control-Allow-Origin"), "*");
    EXPECT_EQ(header(response, "X-Content-Type-Options"), "nosniff");
}

/// What a reference without scheme and host means in a document at `base`: RFC 3986, 5.2.
inline std::string resolved(const std::string& reference, const std::string& base) {
    if (reference.starts_with('/')) return reference;
    const std::string path = base.substr(0, base.find('?'));
    const std::size_t spot = std::min(reference.find('?'), reference.size());
    std::string rest = path.substr(0, path.rfind('/') + 1) + reference.substr(0, spot), out;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find('/', 1), rest.size());
        const std::string segment = rest.substr(0, end);
        rest.erase(0, end);
        if (segment == "/..")
            out.erase(std::min(out.rfind('/'), out.size()));
        else if (segment != "/.")
            out += segment;
    }
    return out + reference.substr(spot);
}

/// The addresses of the images that a file links, as a client resolves them that has fetched it from `from`.
inline std::vector<std::string> linked_images(const Response& file, const std::string& from) {
    const std::string text = text_of(file);
    std::vector<std::string> found;
    constexpr std::string_view begin = "\"uri\":\"";
    for (std::size_t at = 0; (at = text.find(begin, at)) != std::string::npos;) {
        at += begin.size();
        found.push_back(resolved(text.substr(at, text.find('"', at) - at), from));
    }
    return found;
}

/// Expects that the three images which a file points to are those of the same file with embedded ones, cached once, immutable, and
/// painted alike by a service that has never seen the file.
///
/// returns  their addresses
inline std::vector<std::string> expect_linked_images(Service& service, const Response& linked,
                                                     const Response& embedded) {
    EXPECT_EQ(linked.status, 200) << text_of(linked);
    std::vector<std::string> found;
    for (const std::string& address : linked_images(linked, header(linked, "Content-Location"))) {
        const Response image = handle(service, get(address));
        EXPECT_EQ(image.status, 200) << address << text_of(image);
        EXPECT_EQ(header(image, "Content-Type"), "image/jpeg");
        EXPECT_EQ(header(image, "Cache-Control"), "public, max-age=31536000, immutable");
        EXPECT_EQ(header(image, "Content-Location"), address);
        EXPECT_EQ(header(image, "Cache-Status"), "sporeprint-images; hit")
            << "the embedded file painted it";
        EXPECT_EQ(text_of(image).substr(0, 2), "\xff\xd8");
        EXPECT_NE(text_of(embedded).find(text_of(image)), std::string::npos)
            << address << ": the same bytes as embedded";
        const Response again =
            handle(service, get(address, {{"If-None-Match", header(image, "ETag")}}));
        EXPECT_EQ(again.status, 304);
        Service other(built_in_atlas(), ServiceOptions{});
        const Response elsewhere = handle(other, get(address));
        EXPECT_EQ(header(elsewhere, "Cache-Status"), "sporeprint-images; fwd=miss; stored");
        EXPECT_EQ(text_of(elsewhere), text_of(image));
        EXPECT_EQ(header(elsewhere, "ETag"), header(image, "ETag"));
        EXPECT_NE(header(elsewhere, "Server-Timing").find("paint;dur="), std::string::npos);
        found.push_back(address);
    }
    EXPECT_EQ(found.size(), 3u);
    EXPECT_EQ(service.counters().painted, 1u);
    return found;
}

/// A species of the built-in atlas, and its address at the smallest cost.
inline std::string first_species() {
    return built_in_atlas()->entries().front().species.id.string();
}

/// The species of an atlas that are turned round an axis, by id.
inline std::vector<std::string> swept_species(const Atlas& atlas) {
    std::vector<std::string> ids;
    for (const AtlasEntry& entry : atlas.entries())
        if (family_of(entry.species) == Family::swept) ids.push_back(entry.species.id.string());
    return ids;
}

inline std::string second_species() { return built_in_atlas()->entries()[1].species.id.string(); }

inline std::string small(std::string_view more = "") {
    return "/v1/mushrooms/" + first_species() + ".glb?lod=3&texture_size=128" + std::string(more);
}

}  // namespace sporeprint::api::test
