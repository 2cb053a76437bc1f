#include "api/http/routes.h"

#include <gtest/gtest.h>

#include <set>

#include "api/http/query.h"

namespace sporeprint::api {
namespace {

std::vector<std::string> segments(std::string_view path) {
    std::vector<Problem> problems;
    return split_target(path, problems).segments;
}

TEST(Routes, EachPatternIsFoundByAnAddressMadeFromIt) {
    for (const Route& route : routes()) {
        if (route.endpoint == Endpoint::livez || route.endpoint == Endpoint::readyz ||
            route.endpoint == Endpoint::metrics)
            continue;
        std::string path = route.pattern;
        for (std::size_t open; (open = path.find('{')) != std::string::npos;)
            path.replace(open, path.find('}') - open + 1, "x");
        const Match match = match_route(route.method, segments(path));
        ASSERT_NE(match.route, nullptr) << path;
        EXPECT_EQ(match.route->endpoint, route.endpoint) << path;
        for (const std::string& captured : match.captured) EXPECT_EQ(captured, "x");
    }
}

TEST(Routes, OperationIdsAreUnique) {
    std::set<std::string> ids;
    for (const Route& route : routes()) EXPECT_TRUE(ids.insert(route.id).second) << route.id;
}

TEST(Routes, HeadCountsAsGetAndOtherMethodsTellWhatIsAllowed) {
    EXPECT_NE(match_route("HEAD", segments("/v1/species")).route, nullptr);
    const Match refused = match_route("DELETE", segments("/v1/species"));
    EXPECT_EQ(refused.route, nullptr);
    EXPECT_EQ(refused.allow, "GET, HEAD, OPTIONS");
    EXPECT_EQ(match_route("HEAD", segments("/v1/mushrooms.glb")).route, nullptr);
    EXPECT_EQ(match_route("GET", segments("/v1/mushrooms.glb")).allow, "POST, OPTIONS");
}

TEST(Routes, TheSchemaIsNoMushroom) {
    EXPECT_EQ(match_route("GET", segments("/v1/mushrooms/schema")).route->endpoint,
              Endpoint::mushroom_schema);
    EXPECT_EQ(match_route("GET", segments("/v1/mushrooms/schema.glb")).route->endpoint,
              Endpoint::mushroom_glb);
}

TEST(Routes, AnUnknownPathIsToldTheOneProbablyMeant) {
    const std::pair<const char*, const char*> cases[] = {
        {"/v1/specis", "/v1/species"},
        {"/v1/species/", "/v1/species"},
        {"/V1/species", "/v1/species"},
        {"/v1/mushrooms/boletus_edulis", "/v1/mushrooms/boletus_edulis.glb"},
        {"/v1/mushrooms/boletus_edulis.gltf", "/v1/mushrooms/boletus_edulis.glb"},
        {"/v1/mushroom/boletus_edulis.glb", "/v1/mushrooms/boletus_edulis.glb"},
        {"/openapi.jsn", "/openapi.json"},
        {"/metric", "/metrics"},
        {"/something/quite/different", ""},
    };
    for (const auto& [path, meant] : cases) {
        EXPECT_TRUE(match_route("GET", segments(path)).allow.empty()) << path;
        EXPECT_EQ(closest_route(segments(path)), meant) << path;
    }
}

TEST(Routes, BodiesAreBoundedByRoute) {
    EXPECT_EQ(longest_body(*match_route("POST", segments("/v1/inspect")).route), 64u << 20);
    EXPECT_EQ(longest_body(*match_route("POST", segments("/v1/mushrooms.glb")).route), 4u << 20);
    EXPECT_EQ(longest_body(*match_route("GET", segments("/v1")).route), 256u << 10);
}

}  // namespace
}  // namespace sporeprint::api
