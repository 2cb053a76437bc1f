// Weights of wind and shared images that a request asks for, in files of all products.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/api/support.h"

namespace sporeprint::api::products_wind_test {
namespace {

using test::get;
using test::text_of;

TEST(WindRoutes, EveryProductHasWind) {
    Service service(built_in_atlas(), ServiceOptions{});
    for (const std::string file :
         {"/v1/mushrooms/mycena_sanguinolenta",
          "/v1/mushrooms/boletus_edulis:0.5,russula_emetica:0.5",
          "/v1/colonies/hypholoma_fasciculare", "/v1/trees/birch", "/v1/leaves/oak"}) {
        const std::string query = "?lod=2&texture_size=128&wind=";
        for (const char* format : {"uv", "attribute", "color"}) {
            const Value described =
                test::json_of(handle(service, get(file + ".json" + query + format)));
            EXPECT_EQ(described.find("effective")->find("wind")->as_string(), format);
            const Response model = handle(service, get(file + ".glb" + query + format));
            ASSERT_EQ(model.status, 200) << text_of(model);
            EXPECT_NE(
                test::header(model, "Content-Disposition").find(std::string("_wind_") + format),
                std::string::npos);
            EXPECT_NE(text_of(model).find(R"("wind":{"channels":{"bend":)"), std::string::npos);
        }
        const Response refused = handle(service, get(file + ".glb?lod=2&textures=none&wind=uv"));
        EXPECT_EQ(refused.status, 422) << file;
        EXPECT_NE(text_of(refused).find(R"("parameter":"wind")"), std::string::npos) << file;
    }
    EXPECT_EQ(handle(service, get("/v1/trees/birch.glb?wind=strong")).status, 400);
}

/// Returns the URLs of the images to which a file links.
std::vector<std::string> images_of(Service& service, const std::string& target) {
    const std::string text = text_of(handle(service, get(target)));
    std::vector<std::string> urls;
    for (std::size_t at = text.find("\"uri\":\""); at != std::string::npos;
         at = text.find("\"uri\":\"", at + 1))
        urls.push_back(text.substr(at + 7, text.find('"', at + 7) - at - 7));
    return urls;
}

TEST(ShareRoutes, IndividualsOfASpeciesLinkToTheSameImages) {
    Service service(built_in_atlas(), ServiceOptions{});
    for (const std::string file :
         {"/v1/mushrooms/amanita_muscaria.glb", "/v1/colonies/hypholoma_fasciculare.glb"}) {
        const std::string query = file + "?lod=2&textures=linked&seed=";
        const std::vector<std::string> first = images_of(service, query + "1"),
                                       fifth = images_of(service, query + "5"),
                                       shared = images_of(service, query + "5&share=species");
        ASSERT_EQ(first.size(), 3U);
        EXPECT_NE(first, fifth);
        EXPECT_EQ(first, shared);
        EXPECT_NE(text_of(handle(service, get(query + "5&share=species"))),
                  text_of(handle(service, get(query + "1&share=species"))));
    }
}

}  // namespace
}  // namespace sporeprint::api::products_wind_test
