// A service whose atlas comes from a folder with its own species, leaf and tree.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "api/products/trees.h"
#include "core/params/reader.h"
#include "tests/api/support.h"
#include "tests/support/atlas.h"

namespace sporeprint::api::products_own_presets_test {
namespace {

using test::expect_problem;
using test::get;
using test::json_of;
using test::names;
using test::post;
using test::text_of;

/// Returns an atlas, read from a folder, of one species, the leaf elm and the tree wych_elm.
std::shared_ptr<const Atlas> own_atlas() {
    namespace fs = std::filesystem;
    const fs::path folder =
        fs::path(testing::TempDir()) / ("own_presets_" + std::to_string(::getpid()));
    for (const char* kind : {"species", "leaves", "trees"}) fs::create_directories(folder / kind);
    std::ofstream(folder / "species" / "a.json") << atlas().find("boletus_edulis")->json;
    Value leaf = write(*leaf_preset("birch")), tree = write(*tree_preset("shrub"));
    leaf.set("id", "elm").set("name", "Elm-like");
    leaf.find("shape")->set("length", 0.1);
    tree.set("id", "wych_elm").set("name", "Wych elm").set("leaf", "elm");
    std::ofstream(folder / "leaves" / "elm.json") << dump(leaf);
    std::ofstream(folder / "trees" / "wych_elm.json") << dump(tree);
    auto read = atlas_from(folder);
    fs::remove_all(folder);
    return read;
}

class OwnPresetsTest : public testing::Test {
  protected:
    Response ask(std::string target) { return handle(service_, get(std::move(target))); }

    Service service_{own_atlas(), ServiceOptions{}};
};

std::vector<std::string> ids_in(const Value& list) {
    std::vector<std::string> ids;
    for (const Value& item : list.items()) ids.push_back(item.find("id")->as_string());
    return ids;
}

using Ids = std::vector<std::string>;

TEST_F(OwnPresetsTest, AreListedAlone) {
    EXPECT_EQ(ids_in(*json_of(ask("/v1/leaves")).find("leaves")), Ids{"elm"});
    EXPECT_EQ(ids_in(*json_of(ask("/v1/trees")).find("trees")), Ids{"wych_elm"});
    EXPECT_EQ(ids_in(*json_of(ask("/v1/species")).find("species")), Ids{"boletus_edulis"});
}

TEST_F(OwnPresetsTest, AreTheOnlyOnesInSchemasAndExamples) {
    const Value ids = Value::Array{Value("elm")};
    const Value schema = json_of(ask("/v1/trees/schema"));
    EXPECT_EQ(*schema.at_pointer("/properties/leaf/enum"), ids);
    const Value document = json_of(ask("/openapi.json"));
    EXPECT_EQ(*document.at_pointer("/components/schemas/tree_params/properties/leaf/enum"), ids);
    const Value& order = *document.at_pointer(
        "/components/requestBodies/tree_order/content/application~1json/schema/properties");
    EXPECT_EQ(*order.at_pointer("/leaf/enum"), ids);
    EXPECT_EQ(*order.at_pointer("/preset/enum"), Value(Value::Array{Value("wych_elm")}));
    EXPECT_EQ(document.at_pointer("/paths/~1v1~1leaves~1{preset}.glb/get/parameters/0/example")
                  ->as_string(),
              "elm");
}

TEST_F(OwnPresetsTest, GrowLikeOthers) {
    const Response leaf = ask("/v1/leaves/elm.glb?lod=3&texture_size=128");
    EXPECT_EQ(text_of(leaf).substr(0, 4), "glTF");
    const Response tree = ask("/v1/trees/wych_elm.glb?lod=3&texture_size=128");
    EXPECT_EQ(text_of(tree).substr(0, 4), "glTF");
    const Value described = json_of(ask("/v1/trees/wych_elm.json?lod=3"));
    EXPECT_EQ(described.at_pointer("/effective/leaf")->as_string(), "elm");
    const Response posted = handle(
        service_,
        post(R"({"preset":"wych_elm","leaf":"elm","lod":3,"textures":"linked"})", "/v1/trees.glb"));
    ASSERT_EQ(posted.status, 200) << text_of(posted);
    EXPECT_NE(text_of(posted).find("trees/leaves/elm/"), std::string::npos);
}

TEST_F(OwnPresetsTest, OthersAreUnknown) {
    expect_problem(ask("/v1/leaves/oak.glb"), 404);
    expect_problem(ask("/v1/trees/birch.json"), 404);
    const Response query = ask("/v1/trees/wych_elm.glb?leaf=oak");
    expect_problem(query, 400);
    EXPECT_TRUE(names(query, "leaf", "'oak' is not one of elm"));
    const Response body =
        handle(service_, post(R"({"preset":"wych_elm","leaf":"oak"})", "/v1/trees.glb"));
    expect_problem(body, 400);
    EXPECT_TRUE(names(body, "/leaf", "'oak' is not one of elm"));
}

TEST(PresetVersions, DependOnTheLeavesOfTheAtlas) {
    AtlasTexts texts = built_in_texts();
    const Atlas same(texts);
    EXPECT_EQ(preset_token<Trees>(same, "birch"), preset_token<Trees>(atlas(), "birch"));
    Value oak = write(*leaf_preset("oak"));
    oak.find("shape")->set("length", 0.2);
    texts.leaves.clear();
    for (const LeafPreset& leaf : leaf_presets())
        texts.leaves.push_back(dump(leaf.id.view() == "oak" ? oak : write(leaf)));
    const Atlas changed(texts);
    EXPECT_NE(preset_token<Trees>(changed, "birch"), preset_token<Trees>(atlas(), "birch"))
        << "its query can name any leaf";
}

}  // namespace
}  // namespace sporeprint::api::products_own_presets_test
