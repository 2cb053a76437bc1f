// The wood behind lone brackets over HTTP: images, charges, sets, and what is refused.
#include "api/products/wood.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/api/support.h"

namespace sporeprint::api::products_wood_test {
namespace {

using test::expect_problem;
using test::get;
using test::header;
using test::json_of;
using test::linked_images;
using test::names;
using test::post;
using test::text_of;

const std::string bracket = "/v1/mushrooms/fomes_fomentarius.glb";

class WoodTest : public test::RequestedService {
  protected:
    Cost cost(const std::string& query) {
        const auto planned = test::plan(service_, get(bracket + query));
        const Job* const job = std::get_if<Job>(&planned);
        EXPECT_TRUE(job != nullptr) << query;
        return job ? job->cost : Cost{};
    }
};

TEST_F(WoodTest, ImagesOfABracketsWoodAreLinkedBesideItsOwn) {
    const std::string file = bracket + "?texture_size=128&lod=2";
    const Response embedded = ask(file);
    std::vector<std::string> linked;
    for (const std::string& address : linked_images(ask(file + "&textures=linked"), file))
        if (address.find("/wood/") != std::string::npos) linked.push_back(address);
    ASSERT_EQ(linked.size(), 3U);
    for (const std::string& address : linked) {
        EXPECT_TRUE(address.starts_with("/v1/mushrooms/wood/birch/")) << address;
        const Response image = ask(address);
        ASSERT_EQ(image.status, 200) << address << text_of(image);
        EXPECT_EQ(header(image, "Content-Location"), address);
        EXPECT_NE(text_of(embedded).find(text_of(image)), std::string::npos) << address;
    }
    // Those of tiers are the same bytes.
    EXPECT_EQ(text_of(ask("/v1/mushrooms/wood/birch/orm.jpg?side=32")),
              text_of(ask("/v1/colonies/wood/birch/orm.jpg?side=32")));
    EXPECT_EQ(ask("/v1/mushrooms/wood/birch/orm.webp?side=32&seed=4&age=0.3").status, 200)
        << "loaders may append the query of the model";
    EXPECT_EQ(ask("/v1/mushrooms/wood/birch/orm.jpg?v=old").status, 410);
    expect_problem(ask("/v1/mushrooms/wood/brich/orm.jpg"), 404);
}

TEST_F(WoodTest, IsChargedOnceForItsImages) {
    const Cost last = cost("?lod=3");
    EXPECT_EQ(last.texels, 3U * 128 * 128);
    EXPECT_EQ(last.bark_texels, 4U * 3 * 64 * 64);
    EXPECT_EQ(cost("?lod=3&substrate=none").bark_texels, 0U);
    EXPECT_EQ(cost("?lod=3&textures=linked").bark_texels, 0U);
    EXPECT_EQ(cost("?lod=3&variants=weather").bark_texels, last.bark_texels)
        << "weather changes the fungus alone";
    EXPECT_EQ(4 * cost("?lod=4").bark_texels, cost("?lod=1").bark_texels)
        << "that of LOD 1 with images of half the side";
}

TEST_F(WoodTest, DescriptionsStateTheWoodInEffect) {
    const auto effective = [&](const std::string& address) {
        const Value body = json_of(ask(address));
        const Value* const substrate = body.at_pointer("/effective/substrate");
        return substrate && substrate->is_string() ? substrate->as_string() : std::string();
    };
    EXPECT_EQ(effective("/v1/mushrooms/fomes_fomentarius.json"), "birch");
    EXPECT_EQ(effective("/v1/mushrooms/fomes_fomentarius.json?substrate=oak"), "oak");
    EXPECT_EQ(effective("/v1/mushrooms/fomes_fomentarius.json?substrate=none"), "none");
    EXPECT_EQ(effective("/v1/mushrooms/amanita_muscaria.json"), "");
    const auto height = [&](const std::string& query) {
        const Value body = json_of(ask("/v1/mushrooms/fomes_fomentarius.json" + query));
        return body.at_pointer("/bounds_m/max/1")->as_number() -
               body.at_pointer("/bounds_m/min/1")->as_number();
    };
    EXPECT_GT(height(""), 1.2 * height("?substrate=none")) << "bounds include the wood";
}

TEST_F(WoodTest, BehindWhatHasNoWallIsRefusedByName) {
    const auto refused = [&](const std::string& address, int status) {
        const Response response = ask(address);
        expect_problem(response, status);
        EXPECT_TRUE(names(response, "substrate")) << text_of(response);
    };
    refused("/v1/mushrooms/amanita_muscaria.glb?substrate=oak", 422);
    refused("/v1/mushrooms/ramaria_formosa.json?substrate=spruce", 422);
    refused(bracket + "?substrate=steel", 400);
    EXPECT_EQ(ask("/v1/mushrooms/amanita_muscaria.json?substrate=none").status, 200)
        << "it stands on none anyway";
}

TEST_F(WoodTest, SetsInOneFileHaveNoneAndTheirFilesHave) {
    const auto set = [&](const char* ending, const std::string& more) {
        return ask(
            post(R"({"species":["fomes_fomentarius"],"levels":[2],"texture_size":128)" + more + "}",
                 std::string("/v1/sets.") + ending));
    };
    EXPECT_EQ(text_of(set("glb", "")).find("_wood"), std::string::npos);
    EXPECT_EQ(set("glb", R"(,"substrate":"none")").status, 200);
    const Response refused = set("glb", R"(,"substrate":"oak")");
    expect_problem(refused, 422);
    EXPECT_TRUE(names(refused, "/substrate")) << text_of(refused);
    const Value manifest = json_of(set("json", R"(,"textures":"linked")"));
    const Value& file = manifest.find("files")->items().front();
    std::size_t of_wood = 0;
    for (const Value& image : file.find("images")->items())
        of_wood += image.as_string().find("/wood/birch/") != std::string::npos ? 1 : 0;
    EXPECT_EQ(of_wood, 3U) << "a client that stores a set needs these too";
    EXPECT_NE(text_of(ask(file.find("url")->as_string())).find("_wood"), std::string::npos);
}

}  // namespace
}  // namespace sporeprint::api::products_wood_test
