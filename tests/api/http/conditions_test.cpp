#include "api/http/conditions.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "api/http/encoding.h"
#include "tests/api/support.h"

namespace sporeprint::api::http_conditions_test {
namespace {

using test::expect_problem;
using test::first_species;
using test::get;
using test::header;
using test::post;
using test::request;
using test::small;
using test::text_of;

TEST(Conditions, HeaderLinesOfOneNameAreOneList) {
    const Request lines =
        get("/", {{"If-None-Match", "\"a\""}, {"x", "y"}, {"if-none-match", "\"b\""}});
    EXPECT_EQ(header_list(lines, "IF-NONE-MATCH"), "\"a\", \"b\"");
    EXPECT_FALSE(header_list(lines, "If-Match"));
    EXPECT_TRUE(accepts_gzip(get("/", {{"Accept-Encoding", "br"}, {"accept-encoding", "gzip"}})));
    EXPECT_FALSE(accepts_gzip(get("/", {{"Accept-Encoding", "br"}})));
    EXPECT_FALSE(accepts_gzip(get("/")));
}

TEST(Conditions, IfMatchComparesStronglyAndIfNoneMatchWeakly) {
    const std::vector<std::string> current = {"\"t-gz\"", "\"t\""};
    for (const char* list : {"\"t\"", "\"x\", \"t\"", "\"t-gz\"", "*", " * ", "W/\"t\", \"t\""})
        EXPECT_FALSE(Conditions(get("/", {{"If-Match", list}})).match_fails(current)) << list;
    for (const char* list : {"\"x\"", "W/\"t\"", "t", "", "\"T\"", "\"t"})
        EXPECT_TRUE(Conditions(get("/", {{"If-Match", list}})).match_fails(current)) << list;
    EXPECT_FALSE(Conditions(get("/")).match_fails(current));
    const Conditions weak(get("/", {{"If-None-Match", "\"x\""}, {"If-None-Match", "W/\"t\""}}));
    ASSERT_TRUE(weak.unchanged(current));
    EXPECT_EQ(*weak.unchanged(current), "\"t\"");
    EXPECT_FALSE(weak.none_match_any());
    EXPECT_TRUE(Conditions(get("/", {{"If-None-Match", "*"}})).none_match_any());
    EXPECT_FALSE(Conditions(get("/", {{"If-None-Match", "*"}})).unchanged(current));
    EXPECT_FALSE(Conditions(get("/")).unchanged(current));
}

TEST(Conditions, IfRangeIsTheStrongTagAndNothingElse) {
    EXPECT_TRUE(if_range_matches(get("/"), "\"t\""));
    EXPECT_TRUE(if_range_matches(get("/", {{"If-Range", " \"t\" "}}), "\"t\""));
    for (const char* other :
         {"W/\"t\"", "\"x\"", "*", "\"t\", \"t\"", "", "Sun, 06 Nov 1994 08:49:37 GMT"})
        EXPECT_FALSE(if_range_matches(get("/", {{"If-Range", other}}), "\"t\"")) << other;
}

class ConditionalRequest : public test::RequestedService {};

TEST_F(ConditionalRequest, EveryLineOfIfNoneMatchCounts) {
    for (const std::string& target : {small(), std::string("/v1/species"),
                                      "/v1/mushrooms/" + first_species() + "/normal.jpg"}) {
        const std::string tag = header(ask(request("HEAD", target)), "ETag");
        EXPECT_EQ(ask(target, {{"If-None-Match", "\"x\""}, {"If-None-Match", tag}}).status, 304)
            << target;
    }
    EXPECT_EQ(generated(), 0u);
}

TEST_F(ConditionalRequest, AFailingIfMatchIs412AndMakesNothing) {
    for (const std::string& target :
         {small(), std::string("/v1/species"), std::string("/v1/mushrooms/schema"),
          "/v1/mushrooms/" + first_species() + ".json", std::string("/"),
          "/v1/mushrooms/" + first_species() + "/orm.jpg?side=64"}) {
        const std::string etag = header(ask(request("HEAD", target)), "ETag");
        for (const char* method : {"GET", "HEAD"}) {
            expect_problem(ask(request(method, target, {{"If-Match", "\"x\""}})), 412);
            expect_problem(ask(request(method, target, {{"If-Match", "W/" + etag}})), 412);
            expect_problem(
                ask(request(method, target, {{"If-Match", "\"x\""}, {"If-None-Match", etag}})),
                412);
            EXPECT_EQ(
                ask(request(method, target, {{"If-Match", etag}, {"If-None-Match", etag}})).status,
                304);
        }
        EXPECT_EQ(generated(), 0u);
        EXPECT_EQ(ask(request("HEAD", target, {{"If-Match", "\"x\", " + etag}})).status, 200);
        EXPECT_EQ(ask(request("HEAD", target, {{"If-Match", "*"}})).status, 200)
            << "it can be made";
    }
    EXPECT_EQ(ask(small(), {{"If-Match", "*"}}).status, 200);
    expect_problem(ask(small(), {{"If-Match", "\"x\""}}), 412);
    // What is wrong without the condition is so with it.
    expect_problem(ask(small("&age=7"), {{"If-Match", "\"x\""}}), 400);
    expect_problem(ask(small("&v=old"), {{"If-Match", "\"x\""}}), 410);
    expect_problem(
        ask(small("&hymenium.pores_per_mm=2&hymenium.blades=20"), {{"If-Match", "\"x\""}}), 422);
}

TEST_F(ConditionalRequest, APostWhoseResponseTheClientHasIs412) {
    const auto posted = [&](std::vector<Header> conditions) {
        Request one =
            post("{\"lod\":3,\"texture_size\":128,\"mix\":{\"" + first_species() + "\":1}}");
        one.headers.insert(one.headers.end(), conditions.begin(), conditions.end());
        return ask(one);
    };
    const std::string etag = header(ask(request("HEAD", small())), "ETag");
    expect_problem(posted({{"If-None-Match", etag}}), 412);
    expect_problem(posted({{"If-None-Match", "*"}}), 412);
    expect_problem(posted({{"If-Match", "\"x\""}}), 412);
    EXPECT_EQ(generated(), 0u);
    EXPECT_EQ(service_.counters().glb_not_modified, 0u);
    const Response generated = posted({{"If-None-Match", "\"x\""}, {"If-Match", etag}});
    EXPECT_EQ(generated.status, 200);
    EXPECT_EQ(header(generated, "ETag"), etag);
    expect_problem(posted({{"If-None-Match", etag}}), 412);
    expect_problem(posted({{"If-None-Match", "*"}}), 412);
    EXPECT_EQ(posted({{"If-Match", "*"}}).status, 200);
}

TEST_F(ConditionalRequest, ConditionsAreAllowedAndTheirResponsesExposedToOtherOrigins) {
    const std::string allowed =
        header(ask(request("OPTIONS", small())), "Access-Control-Allow-Headers");
    for (const char* name : {"If-Match", "If-None-Match", "If-Range", "Range", "Content-Type"})
        EXPECT_NE((", " + allowed + ',').find(std::string(", ") + name + ','), std::string::npos)
            << name;
    const std::string exposed = header(ask("/v1"), "Access-Control-Expose-Headers");
    for (const char* name : {"Accept-Ranges", "Content-Range", "RateLimit", "RateLimit-Policy",
                             "Content-Encoding", "ETag", "Retry-After"})
        EXPECT_NE((", " + exposed + ',').find(std::string(", ") + name + ','), std::string::npos)
            << name;
}

}  // namespace
}  // namespace sporeprint::api::http_conditions_test
