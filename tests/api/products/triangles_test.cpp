// A number of triangles instead of a level of detail, for all products.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/api/support.h"

namespace sporeprint::api::products_triangles_test {
namespace {

using test::expect_linked_images;
using test::expect_problem;
using test::header;
using test::json_of;
using test::names;
using test::post;
using test::text_of;

class TrianglesTest : public test::RequestedService {
  protected:
    double number(const std::string& target, const std::string& pointer) {
        const Response response = ask(target);
        EXPECT_EQ(response.status, 200) << target << text_of(response);
        const Value document = json_of(response);
        const Value* found = document.at_pointer(pointer);
        EXPECT_NE(found, nullptr) << target << ' ' << pointer;
        return found ? found->as_number() : -1.0;
    }
};

const std::string agaric = "/v1/mushrooms/amanita_muscaria";

TEST_F(TrianglesTest, OfAMushroomAreMetBetweenTheWholeLevels) {
    const Value described = json_of(ask(agaric + ".json?triangles=12000"));
    const double real = described.at_pointer("/levels/0/triangles")->as_number(),
                 level = described.at_pointer("/levels/0/lod")->as_number();
    EXPECT_GT(real, 12'000 / 1.3);
    EXPECT_LT(real, 12'000 * 1.3);
    EXPECT_GT(level, 0.0);
    EXPECT_LT(level, 1.0);
    EXPECT_EQ(described.at_pointer("/effective/triangles")->as_number(), 12'000);
    EXPECT_EQ(described.at_pointer("/estimate/triangles")->as_number(), real);
    EXPECT_NE(described.find("canonical")->as_string().find("?triangles=12000"), std::string::npos);
    double before = 1e9;
    for (const Value& one : described.find("levels")->items()) {
        EXPECT_LT(one.find("triangles")->as_number(), before / 1.8);
        before = one.find("triangles")->as_number();
    }
    const Response file = ask(agaric + ".glb?triangles=12000&texture_size=128");
    ASSERT_EQ(file.status, 200) << text_of(file);
    EXPECT_NE(header(file, "Content-Disposition").find("_t12000_LOD0.glb"), std::string::npos);
    EXPECT_NE(text_of(file).find("_t12000_LOD0\""), std::string::npos);
}

TEST_F(TrianglesTest, OutOfReachAreTheNearestThereIs) {
    EXPECT_EQ(number(agaric + ".json?triangles=10000000", "/levels/0/lod"), 0.0);
    EXPECT_EQ(number(agaric + ".json?triangles=3", "/levels/0/lod"), 3.0);
    expect_problem(ask(agaric + ".json?triangles=0"), 400);
    expect_problem(ask(agaric + ".json?triangles=10000001"), 400);
    expect_problem(ask(agaric + ".json?triangles=many"), 400);
}

TEST_F(TrianglesTest, AreRefusedBesideALevel) {
    for (const std::string& product :
         {agaric, std::string("/v1/colonies/hypholoma_fasciculare"), std::string("/v1/leaves/oak"),
          std::string("/v1/trees/birch")})
        for (const char* more : {"&lod=2", "&profile=mobile&lod=3", "&profile=mobile&lod=0"}) {
            const Response refused = ask(product + ".json?triangles=4000" + more);
            expect_problem(refused, 422);
            EXPECT_TRUE(names(refused, "triangles", "lod=")) << text_of(refused);
        }
    EXPECT_EQ(ask(agaric + ".json?triangles=4000&profile=mobile").status, 200);
    EXPECT_EQ(ask(post(R"({"mix":{"amanita_muscaria":1},"triangles":4000,"lod":1})")).status, 422);
    const Response set =
        ask(post(R"({"species":["amanita_muscaria"],"triangles":4000})", "/v1/sets.json"));
    EXPECT_EQ(set.status, 400) << text_of(set);
    EXPECT_TRUE(names(set, "/triangles", "levels")) << text_of(set);
}

TEST_F(TrianglesTest, LinkTheImagesOfTheNearestWholeLevel) {
    const std::string query = ".glb?texture_size=256&triangles=";
    const Response embedded = ask(agaric + query + "9000"),
                   linked = ask(agaric + query + "9000&textures=linked");
    EXPECT_EQ(expect_linked_images(service_, linked, embedded).size(), 3U);
}

TEST_F(TrianglesTest, OfTreesAndLeavesHaveTheUrlOfTheirLevel) {
    for (const std::string product : {"/v1/leaves/oak", "/v1/trees/birch"})
        for (const int wanted : {1, 500, 5'000, 10'000'000}) {
            const std::string query = "?triangles=" + std::to_string(wanted) + "&textures=none";
            const Value described = json_of(ask(product + ".json" + query));
            const double level = described.at_pointer("/levels/0/lod")->as_number();
            EXPECT_EQ(described.at_pointer("/effective/lod")->as_number(), level);
            EXPECT_EQ(described.find("canonical")->as_string().find("triangles"),
                      std::string::npos);
            const Response chosen = ask(product + ".glb" + query),
                           named = ask(product + ".glb?textures=none&lod=" +
                                       std::to_string(static_cast<int>(level)));
            EXPECT_EQ(text_of(chosen), text_of(named)) << product << query;
            EXPECT_EQ(header(named, "Cache-Status"), "sporeprint; hit");
        }
    const Response huge = ask("/v1/trees/birch.json?triangles=5000&leaves.per_tip=8&order=7");
    EXPECT_TRUE(huge.status == 200 || huge.status == 422) << text_of(huge);
}

TEST_F(TrianglesTest, OfAColonyCountEveryInstance) {
    const std::string colony = "/v1/colonies/hypholoma_fasciculare";
    const Value near = json_of(ask(colony + ".json?triangles=60000&count=12")),
                far = json_of(ask(colony + ".json?triangles=2000&count=12"));
    EXPECT_LT(near.at_pointer("/effective/lod")->as_number(),
              far.at_pointer("/effective/lod")->as_number());
    EXPECT_NE(near.find("canonical")->as_string().find("triangles=60000"), std::string::npos);
    const Response embedded = ask(colony + ".glb?triangles=2000&count=3&texture_size=128"),
                   linked =
                       ask(colony + ".glb?triangles=2000&count=3&texture_size=128&textures=linked");
    EXPECT_EQ(expect_linked_images(service_, linked, embedded).size(), 3U);
    EXPECT_NE(header(embedded, "Content-Disposition").find("_t2000_LOD0.glb"), std::string::npos);
}

TEST_F(TrianglesTest, ChooseTheLevelOfAPictureAndOfAClip) {
    EXPECT_EQ(ask(agaric + ".png?triangles=2000&width=32&height=32").status, 200);
    const Response clip =
        ask(agaric + ".glb?triangles=1000&animation=growth&frames=2&textures=none");
    ASSERT_EQ(clip.status, 200) << text_of(clip);
    EXPECT_NE(text_of(clip).find("\"targets\""), std::string::npos);
}

}  // namespace
}  // namespace sporeprint::api::products_triangles_test
