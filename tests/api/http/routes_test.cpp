#include "api/http/routes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "api/http/query.h"
#include "api/routes.h"
#include "tests/support/paths.h"

namespace sporeprint::api::http_routes_test {
namespace {

std::vector<std::string> segments(std::string_view path) {
    std::vector<Problem> problems;
    return split_target(path, problems).segments;
}

TEST(Routes, EachPatternIsFoundByAnAddressMadeFromIt) {
    for (const Route* const each : route_table().routes()) {
        const Route& route = *each;
        if (route.kind == RouteKind::health) continue;
        std::string path = route.pattern;
        for (std::size_t open; (open = path.find('{')) != std::string::npos;)
            path.replace(open, path.find('}') - open + 1, "x");
        const Match match = route_table().match(route.method, segments(path));
        ASSERT_NE(match.route, nullptr) << path;
        EXPECT_EQ(match.route, &route) << path;
        for (const std::string& captured : match.captured) EXPECT_EQ(captured, "x");
    }
}

TEST(Routes, OperationIdsAreUnique) {
    std::set<std::string> ids;
    for (const Route* const route : route_table().routes())
        EXPECT_TRUE(ids.insert(route->id).second) << route->id;
}

TEST(Routes, HeadCountsAsGetAndOtherMethodsTellWhatIsAllowed) {
    EXPECT_NE(route_table().match("HEAD", segments("/v1/species")).route, nullptr);
    const Match refused = route_table().match("DELETE", segments("/v1/species"));
    EXPECT_EQ(refused.route, nullptr);
    EXPECT_EQ(refused.allow, "GET, HEAD, OPTIONS");
    EXPECT_EQ(route_table().match("HEAD", segments("/v1/mushrooms.glb")).route, nullptr);
    EXPECT_EQ(route_table().match("GET", segments("/v1/mushrooms.glb")).allow, "POST, OPTIONS");
}

TEST(Routes, OfOnePathHaveAMethodEach) {
    const auto path = segments("/v1/photos/abc.jpg");
    EXPECT_EQ(route_table().match("GET", path).route->id, std::string("get_photo"));
    EXPECT_EQ(route_table().match("HEAD", path).route->id, std::string("get_photo"));
    const Match removal = route_table().match("DELETE", path);
    EXPECT_EQ(removal.route->id, std::string("delete_photo"));
    EXPECT_EQ(removal.captured, std::vector<std::string>{"abc"});
    EXPECT_EQ(removal.allow, "GET, HEAD, DELETE, OPTIONS");
    EXPECT_EQ(route_table().match("POST", path).route, nullptr);
}

TEST(Routes, AcceptTheTypesOfTheirBodies) {
    const auto types = [](const char* method, const char* path) {
        return body_types(*route_table().match(method, segments(path)).route);
    };
    EXPECT_EQ(types("POST", "/v1/photos"),
              (std::vector<std::string_view>{"image/jpeg", "image/png", "image/webp"}));
    EXPECT_EQ(types("POST", "/v1/traces"), std::vector<std::string_view>{"application/json"});
    EXPECT_TRUE(types("GET", "/v1/species").empty());
}

TEST(Routes, TheSchemaIsNoMushroom) {
    EXPECT_EQ(route_table().match("GET", segments("/v1/mushrooms/schema")).route->id,
              std::string("mushroom_schema"));
    EXPECT_EQ(route_table().match("GET", segments("/v1/mushrooms/schema.glb")).route->id,
              std::string("get_mushroom"));
}

TEST(Routes, AnUnknownPathSuggestsTheClosestOne) {
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
        EXPECT_TRUE(route_table().match("GET", segments(path)).allow.empty()) << path;
        EXPECT_EQ(route_table().closest(segments(path)), meant) << path;
    }
}

TEST(Routes, BodiesAreBoundedByRoute) {
    EXPECT_EQ(route_table().match("POST", segments("/v1/inspect")).route->most_body, 64u << 20);
    EXPECT_EQ(route_table().match("POST", segments("/v1/mushrooms.glb")).route->most_body,
              4u << 20);
    EXPECT_EQ(route_table().match("GET", segments("/v1")).route->most_body, 256u << 10);
}

TEST(Routes, EachHasAHandlerADocumentOrTheServer) {
    for (const Route* const route : route_table().routes())
        EXPECT_EQ((route->plan != nullptr) + (route->document != nullptr) +
                      (route->kind == RouteKind::health),
                  1)
            << route->pattern;
}

// Adding a product touches its own files and one row of routes.cpp.
TEST(Routes, NoOtherFileNamesAProduct) {
    namespace fs = std::filesystem;
    const fs::path api = fs::path(source_folder()) / "api";
    std::size_t products = 0;
    for (const RouteGroup& group : route_table().groups()) {
        if (std::none_of(group.routes.begin(), group.routes.end(), is_cached)) continue;
        ++products;
        const std::string product = std::string("\"api/products/") + group.tag;
        std::set<std::string> users;
        for (const auto& entry : fs::recursive_directory_iterator(api)) {
            if (!entry.is_regular_file()) continue;
            const std::string name = fs::relative(entry.path(), api).generic_string();
            if (name.starts_with("products/") || !(name.ends_with(".cpp") || name.ends_with(".h")))
                continue;
            std::ifstream file(entry.path());
            const std::string text((std::istreambuf_iterator<char>(file)), {});
            if (text.find(product + ".h\"") != std::string::npos ||
                text.find(product + '/') != std::string::npos ||
                text.find("/v1/" + std::string(group.tag)) != std::string::npos)
                users.insert(name);
        }
        // static_documents.cpp shows two addresses to who opens a service without its page.
        users.erase("static_documents.cpp");
        EXPECT_EQ(users, std::set<std::string>{"routes.cpp"}) << group.tag;
    }
    EXPECT_GE(products, 5u);
}

}  // namespace
}  // namespace sporeprint::api::http_routes_test
