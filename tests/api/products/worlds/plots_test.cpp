// Plots of worlds over HTTP: files, what stands on them, and requests that name no plot.

#include "api/products/worlds/plots.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <set>
#include <span>
#include <string>

#include "core/surface/codecs.h"
#include "tests/api/support.h"

namespace sporeprint::api::products_world_plots_test {
namespace {

using test::header;
using test::json_of;
using test::names;
using test::text_of;

const std::string world = "/v1/worlds/beech,seed=7,extent=256";

class WorldPlotsTest : public test::RequestedService {};

TEST_F(WorldPlotsTest, AreFilesWithWhatTheirJsonLists) {
    const Response response = ask(world + "/y80d270/plot.json?size=20");
    ASSERT_EQ(response.status, 200) << text_of(response);
    const Value plot = json_of(response);
    EXPECT_FALSE(plot.find("trees")->items().empty());
    EXPECT_FALSE(plot.find("fruit_bodies")->items().empty());
    for (const Value& tree : plot.find("trees")->items()) {
        EXPECT_EQ(tree.find("id")->as_string().size(), 16U);
        const Value::Array& place = tree.find("place_m")->items();
        EXPECT_LE(std::abs(place[0].as_number()), 10.0);
        EXPECT_LE(std::abs(place[1].as_number()), 10.0);
    }
    const Value& first = plot.find("fruit_bodies")->items().front();
    EXPECT_EQ(ask(first.find("model")->as_string() + "&lod=3").status, 200);

    const Response model = ask(world + "/y80d270/plot.glb?size=2&texture_size=256");
    ASSERT_EQ(model.status, 200) << text_of(model);
    EXPECT_EQ(header(model, "Content-Type"), "model/gltf-binary");
    EXPECT_TRUE(text_of(model).starts_with("glTF"));
    EXPECT_NE(header(model, "Content-Disposition").find("beech_plot_y80d270.glb"),
              std::string::npos);
    const std::string canonical = header(model, "Content-Location");
    EXPECT_EQ(header(ask(canonical), "ETag"), header(model, "ETag"));
    EXPECT_EQ(header(ask(canonical), "Cache-Status"), "sporeprint; hit");
}

TEST_F(WorldPlotsTest, HavePicturesFromTheirEdgeAndFromAbove) {
    const std::string place =
        world + "/y80d270/plot.png?size=4&texture_size=256&width=96&height=64";
    std::set<std::string> tags;
    for (const char* view : {"standing", "kneeling", "aslant", "top"}) {
        const Response response = ask(place + "&view=" + view);
        ASSERT_EQ(response.status, 200) << text_of(response);
        EXPECT_EQ(header(response, "Content-Type"), "image/png");
        const std::string bytes = text_of(response);
        const Picture image = decoded_picture(
            std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), "");
        EXPECT_EQ(image.width, 96);
        EXPECT_EQ(image.height, 64);
        tags.insert(header(response, "ETag"));
    }
    EXPECT_EQ(tags.size(), 4U);
    EXPECT_TRUE(names(ask(place + "&compress=meshopt"), "compress", ""));
    EXPECT_TRUE(names(ask(place + "&view=below"), "view", "standing"));
}

TEST_F(WorldPlotsTest, ConsistOfLayersInOneOrder) {
    const std::string place = world + "/y80d270/plot.glb?size=3&textures=none";
    const Response trees = ask(place + "&layers=trees+ground");
    ASSERT_EQ(trees.status, 200) << text_of(trees);
    EXPECT_NE(header(trees, "Content-Location").find("layers=ground%2Btrees"), std::string::npos)
        << header(trees, "Content-Location");
    EXPECT_EQ(header(ask(place + "&layers=fungi+floor+trees+ground"), "ETag"),
              header(ask(place), "ETag"));
    EXPECT_TRUE(names(ask(place + "&layers=moss"), "layers", "ground, trees, floor and fungi"));
    EXPECT_TRUE(names(ask(place + "&layers=fungi+fungi"), "layers", "twice"));
}

TEST_F(WorldPlotsTest, ChangeWithTheYearAndTheDay) {
    const std::string autumn = text_of(ask(world + "/y80d270/plot.json")),
                      next_day = text_of(ask(world + "/y80d271/plot.json")),
                      later = text_of(ask(world + "/y130d270/plot.json"));
    EXPECT_NE(autumn, next_day);
    EXPECT_NE(autumn, later);
}

TEST_F(WorldPlotsTest, RefuseOtherPlacesTimesAndImages) {
    EXPECT_TRUE(names(ask(world + "/y80/plot.glb"), "time", "y80d270"));
    EXPECT_TRUE(names(ask(world + "/y80d366/plot.glb"), "time", "y200d365"));
    const Response outside = ask(world + "/y80d1/plot.glb?x=124");
    EXPECT_EQ(outside.status, 422);
    EXPECT_TRUE(names(outside, "x", "between -123 and 123"));
    EXPECT_TRUE(names(ask(world + "/y80d1/plot.glb?y=-130&size=2"), "y", "outside the world"));
    EXPECT_TRUE(names(ask(world + "/y80d1/plot.glb?size=33"), "size", "32"));
    EXPECT_TRUE(names(ask(world + "/y80d1/plot.glb?hight=3"), "hight", "unknown"));
    const Response linked = ask(world + "/y80d1/plot.glb?textures=linked&size=2");
    EXPECT_EQ(linked.status, 400);
    EXPECT_TRUE(names(linked, "textures", "embedded"));
}

TEST_F(WorldPlotsTest, HaveTheKindsAndTheSpeciesThatTheirWorldNames) {
    const Response unknown = ask(world + ",stand.kinds=brich/y80d270/plot.json");
    EXPECT_EQ(unknown.status, 400);
    EXPECT_TRUE(names(unknown, "stand.kinds", "did you mean 'birch'"));
    EXPECT_TRUE(
        names(ask(world + ",fungi.species=boletus/y80d270/plot.json"), "fungi.species", "boletus"));
    EXPECT_TRUE(names(ask(world + ",stand.kinds=birch:0/y80d270/plot.json"), "stand.kinds",
                      "greater than 0"));
    const Response one = ask("/v1/worlds/beech,stand.kinds=spruce:3+birch.json"),
                   other = ask("/v1/worlds/beech,stand.kinds=birch:0.25+spruce:0.75.json");
    ASSERT_EQ(one.status, 200) << text_of(one);
    EXPECT_EQ(header(one, "ETag"), header(other, "ETag"));
    EXPECT_NE(header(one, "Content-Location").find("stand.kinds=birch:0.25+spruce:0.75"),
              std::string::npos)
        << header(one, "Content-Location");
}

}  // namespace
}  // namespace sporeprint::api::products_world_plots_test
