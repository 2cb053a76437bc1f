// Impostors over HTTP: files, descriptions, canonical URLs, costs and what is refused.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tests/api/support.h"

namespace sporeprint::api::products_impostors_test {
namespace {

using test::expect_problem;
using test::get;
using test::header;
using test::json_of;
using test::names;
using test::text_of;

/// Products with an impostor.
const std::array<std::string, 3> products = {
    "/v1/mushrooms/amanita_muscaria", "/v1/colonies/hypholoma_fasciculare", "/v1/trees/shrub"};

void expect_refused(const Response& response, int status, const std::string& parameter) {
    expect_problem(response, status);
    EXPECT_TRUE(names(response, parameter)) << text_of(response);
}

class ImpostorsTest : public test::RequestedService {};

TEST_F(ImpostorsTest, AreLevelFourOfEveryProductButLeaves) {
    for (const std::string& base : products) {
        const Response file = ask(base + ".glb?lod=4&texture_size=128");
        ASSERT_EQ(file.status, 200) << base << text_of(file);
        EXPECT_NE(header(file, "Content-Disposition").find("_LOD4.glb\""), std::string::npos);
        const Value described = json_of(ask(base + ".json?lod=4&texture_size=128"));
        EXPECT_EQ(described.at_pointer("/canonical")->as_string(),
                  base + ".glb?lod=4&texture_size=128");
        EXPECT_EQ(described.at_pointer("/estimate/triangles")->as_number(), 12.0);
        ASSERT_EQ(described.find("levels")->items().size(), 1u);
        EXPECT_EQ(described.at_pointer("/levels/0/lod")->as_number(), 4.0);
        EXPECT_EQ(described.at_pointer("/levels/0/triangles")->as_number(), 12.0);
        EXPECT_GT(described.at_pointer("/bounds_m/max/1")->as_number(), 0.0);
    }
    expect_refused(ask("/v1/leaves/maple.glb?lod=4"), 400, "lod");
}

TEST_F(ImpostorsTest, EndTheLevelsThatADescriptionLists) {
    for (const std::string& base : products) {
        const std::string query = "?lod=2&texture_size=128&lods=msft";
        const Value without = json_of(ask(base + ".json" + query)),
                    with = json_of(ask(base + ".json" + query + "&impostor=true"));
        ASSERT_EQ(without.find("levels")->items().size(), 2u);
        const auto& levels = with.find("levels")->items();
        ASSERT_EQ(levels.size(), 3u);
        EXPECT_EQ(levels[2].find("lod")->as_number(), 4.0);
        EXPECT_GE(levels[1].find("screen_coverage")->as_number(),
                  levels[2].find("screen_coverage")->as_number());
        const std::string text = text_of(ask(base + ".glb" + query + "&impostor=true"));
        EXPECT_NE(text.find("_impostor"), std::string::npos);
        EXPECT_EQ(text_of(ask(base + ".glb" + query)).find("_impostor"), std::string::npos);
    }
}

TEST_F(ImpostorsTest, RefuseWhatTheyCannotHaveByName) {
    for (const std::string& base : products) {
        const std::string glb = base + ".glb?texture_size=128&";
        for (const std::string one : {"linked", "external", "none"}) {
            expect_refused(ask(glb + "lod=4&textures=" + one), 422, "textures");
            expect_refused(ask(glb + "lods=msft&impostor=true&textures=" + one), 422, "textures");
        }
        expect_refused(ask(glb + "impostor=true"), 422, "impostor");
        expect_refused(ask(glb + "impostor=perhaps&lods=msft"), 400, "impostor");
        expect_refused(ask(base + ".png?lod=4"), 400, "lod");
    }
    const std::string agaric = "/v1/mushrooms/amanita_muscaria.glb?texture_size=128&";
    expect_refused(ask(agaric + "lod=4&animation=growth"), 422, "animation");
    expect_refused(ask(agaric + "lod=4&variants=weather"), 422, "variants");
    expect_refused(ask(agaric + "lods=msft&impostor=true&variants=weather"), 422, "variants");
    expect_refused(ask("/v1/leaves/maple.glb?lods=msft&impostor=true"), 422, "impostor");
}

TEST_F(ImpostorsTest, SchemasOfPicturesAndLeavesEndBeforeThem) {
    const auto most = [&](const std::string& path) {
        const Value schema = test::document_at(path);
        return schema.at_pointer("/properties/lod/maximum")->as_number();
    };
    EXPECT_EQ(most("/v1/mushrooms/schema"), 4.0);
    EXPECT_EQ(most("/v1/colonies/schema"), 4.0);
    EXPECT_EQ(most("/v1/trees/schema"), 7.0) << "far levels follow";
    EXPECT_EQ(most("/v1/leaves/schema"), 3.0);
}

}  // namespace
}  // namespace sporeprint::api::products_impostors_test
