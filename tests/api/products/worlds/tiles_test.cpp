// Worlds as 3D Tiles over HTTP: every address that a tileset, a subtree or a tile has leads to a file.

#include "api/products/worlds/tiles.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/api/support.h"
#include "tests/support/glb_reader.h"

namespace sporeprint::api::products_worlds_tiles_test {
namespace {

using test::header;
using test::json_of;
using test::names;
using test::text_of;

const std::string world = "/v1/worlds/mixed,seed=7,extent=256";

class WorldTilesTest : public test::RequestedService {
  protected:
    /// Returns an address of a template.
    static std::string filled(std::string text, int level, int x, int y) {
        for (const auto& [name, number] :
             {std::pair{"{level}", level}, std::pair{"{x}", x}, std::pair{"{y}", y}}) {
            const std::size_t at = text.find(name);
            text.replace(at, std::string_view(name).size(), std::to_string(number));
        }
        return text;
    }
};

TEST_F(WorldTilesTest, ATilesetLeadsToAllItsTiles) {
    const Response response = ask(world + "/web/y80d270/tileset.json");
    ASSERT_EQ(response.status, 200) << text_of(response);
    const Value tileset = json_of(response);
    EXPECT_EQ(tileset.find("asset")->find("version")->as_string(), "1.1");
    const Value::Array& layers = tileset.find("root")->find("children")->items();
    ASSERT_EQ(layers.size(), 4U);
    EXPECT_EQ(layers[2].find("refine")->as_string(), "ADD");
    std::set<std::string> times;
    for (const Value& layer : layers) {
        const Value& tiling = *layer.find("implicitTiling");
        EXPECT_EQ(tiling.find("availableLevels")->as_number(), 6.0);
        const std::string subtrees = tiling.find("subtrees")->find("uri")->as_string(),
                          contents = layer.find("content")->find("uri")->as_string();
        for (const int level : {0, 3}) {
            const Response subtree = ask(filled(subtrees, level, 0, 0));
            ASSERT_EQ(subtree.status, 200) << text_of(subtree);
            EXPECT_TRUE(text_of(subtree).starts_with("subt"));
            EXPECT_NE(header(subtree, "Cache-Control").find("immutable"), std::string::npos);
        }
        const Response tile = ask(filled(contents, 5, 16, 16));
        ASSERT_EQ(tile.status, 200) << text_of(tile);
        EXPECT_EQ(header(tile, "Content-Type"), "model/gltf-binary");
        EXPECT_NE(header(tile, "Cache-Control").find("immutable"), std::string::npos);
        times.insert(contents.substr(contents.find("/y80"), 8));
    }
    EXPECT_EQ(times, (std::set<std::string>{"/y80m9/g", "/y80m9/t", "/y80m9/f", "/y80d270"}));
}

TEST_F(WorldTilesTest, ATileLeadsToTheGeometryAndTheImagesOfItsShapes) {
    for (const char* path : {"/web/y80m7/trees/5/16/17.glb", "/web/y80m7/trees/2/2/2.glb",
                             "/web/y80d270/fungi/3/4/4.glb", "/web/y80m7/floor/5/16/16.glb"}) {
        const Response tile = ask(world + path);
        ASSERT_EQ(tile.status, 200) << text_of(tile);
        const std::string base = world + path;
        const std::string text = text_of(tile);
        const Value json = json_chunk(Bytes(text.begin(), text.end()));
        std::size_t linked = 0;
        const Value* const buffers = json.find("buffers");
        ASSERT_NE(buffers, nullptr) << path;
        for (const Value& buffer : buffers->items())
            if (const Value* const uri = buffer.find("uri")) {
                const Response geometry = ask(test::resolved(uri->as_string(), base));
                ASSERT_EQ(geometry.status, 200) << text_of(geometry);
                EXPECT_EQ(text_of(geometry).size(), buffer.find("byteLength")->as_number());
                EXPECT_NE(header(geometry, "Cache-Control").find("immutable"), std::string::npos);
                ++linked;
            }
        if (std::string_view(path).find("floor") == std::string_view::npos) {
            EXPECT_GT(linked, 0U) << path;
        }
        for (const Value& image : json.find("images")->items()) {
            const Response response = ask(test::resolved(image.find("uri")->as_string(), base));
            EXPECT_EQ(response.status, 200) << image.find("uri")->as_string();
        }
    }
}

TEST_F(WorldTilesTest, GeometryAloneIsThatOfTheFileWithTheSameQuery) {
    const std::string query = "?seed=3&lod=2";
    const Response geometry = ask("/v1/mushrooms/amanita_muscaria.bin" + query);
    ASSERT_EQ(geometry.status, 200) << text_of(geometry);
    EXPECT_EQ(header(geometry, "Content-Type"), "application/octet-stream");
    const std::string file =
        text_of(ask("/v1/mushrooms/amanita_muscaria.glb" + query + "&textures=linked"));
    EXPECT_TRUE(file.ends_with(text_of(geometry)));
    const Response compressed = ask("/v1/trees/broadleaf.bin?compress=meshopt");
    EXPECT_EQ(compressed.status, 422);
    EXPECT_TRUE(names(compressed, "compress"));
}

TEST_F(WorldTilesTest, OneLayerHasATilesetOfItsOwn) {
    const Response response = ask(world + "/core/y80m10/trees/tileset.json");
    ASSERT_EQ(response.status, 200) << text_of(response);
    const Value layer = json_of(response).find("root")->find("children")->items().front();
    EXPECT_NE(layer.find("content")->find("uri")->as_string().find("/core/y80m10/trees/"),
              std::string::npos);
}

TEST_F(WorldTilesTest, RequestsThatNameNoTileAreRefused) {
    for (const auto& [path, status, parameter] :
         {std::tuple{"/web/y80m10/ground/6/0/0.glb", 404, "level"},
          {"/web/y80m10/ground/1/2/0.glb", 404, "level"},
          {"/web/y80m10/ground/1/01/0.glb", 404, "level"},
          {"/web/y80m10/ground/1/-1/0.glb", 404, "level"},
          {"/web/y80m10/ground/1/0/0.subtree", 404, "level"},
          {"/web/y80m10/sky/1/0/0.glb", 404, "layer"},
          {"/unity/y80m10/ground/1/0/0.glb", 404, "profile"},
          {"/web/y80d270/ground/1/0/0.glb", 400, "layertime"},
          {"/web/y80m13/ground/1/0/0.glb", 400, "layertime"},
          {"/web/y80m10/fungi/1/0/0.glb", 400, "time"},
          {"/web/y201m1/ground/1/0/0.glb", 400, "time"},
          {"/web/y80/tileset.json", 400, "time"},
          {"/web/y80d270/tileset.json?lod=1", 400, "lod"}}) {
        const Response response = ask(world + path);
        EXPECT_EQ(response.status, status) << path << text_of(response);
        EXPECT_TRUE(names(response, parameter)) << path << text_of(response);
    }
}

}  // namespace
}  // namespace sporeprint::api::products_worlds_tiles_test
