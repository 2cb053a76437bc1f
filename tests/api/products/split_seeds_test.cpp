// The seeds of shape, surface and damage in URLs, bodies and addresses of images.

#include <gtest/gtest.h>

#include <string>

#include "tests/api/support.h"

namespace sporeprint::api::products_split_seeds_test {
namespace {

using test::header;
using test::json_of;
using test::post;
using test::text_of;

const std::string fly = "/v1/mushrooms/amanita_muscaria";

class SplitSeedsTest : public test::RequestedService {};

TEST_F(SplitSeedsTest, AreInTheUrlIfTheyDiffer) {
    const std::string rest = "lod=3&texture_size=128";
    EXPECT_TRUE(header(ask(fly + ".glb?seeds.surface=9&seed=4&" + rest), "Content-Location")
                    .starts_with(fly + ".glb?seed=4&lod=3&texture_size=128&seeds.surface=9&v="));
    const Response plain = ask(fly + ".glb?seed=4&" + rest),
                   same = ask(fly + ".glb?seed=4&seeds.surface=4&seeds.shape=4&" + rest);
    EXPECT_EQ(header(plain, "ETag"), header(same, "ETag"));
    EXPECT_EQ(header(plain, "Content-Location"), header(same, "Content-Location"));
    const Response posted = ask(post(
        R"({"mix":{"amanita_muscaria":1},"seed":4,"seeds":{"shape":4},"lod":3,"texture_size":128})"));
    EXPECT_EQ(header(posted, "ETag"), header(plain, "ETag"));
}

TEST_F(SplitSeedsTest, AreRefusedByName) {
    const Response response = ask(fly + ".glb?seeds.surfce=9&seeds.damage=-1");
    EXPECT_EQ(response.status, 400);
    EXPECT_NE(text_of(response).find("did you mean 'seeds.surface'?"), std::string::npos);
    EXPECT_NE(text_of(response).find("\"seeds.damage\""), std::string::npos);
}

TEST_F(SplitSeedsTest, AreInTheAddressesOfLinkedImages) {
    const Response linked = ask(fly + ".glb?seed=4&seeds.surface=9&textures=linked&lod=3");
    ASSERT_EQ(linked.status, 200);
    const std::string text = text_of(linked);
    EXPECT_NE(text.find("seed=4&"), std::string::npos);
    EXPECT_NE(text.find("seeds.surface=9"), std::string::npos);
    // The image of the address is the embedded one.
    const std::string query = "?seed=4&seeds.surface=9&side=16&lod=3&age=0.59375";
    const Response image = ask(fly + "/base_color.jpg" + query);
    ASSERT_EQ(image.status, 200) << text_of(image);
    EXPECT_NE(text_of(image), text_of(ask(fly + "/base_color.jpg?seed=4&side=16&lod=3")));
    const std::string embedded =
        text_of(ask(fly + ".glb?seed=4&seeds.surface=9&texture_size=128&lod=3"));
    EXPECT_NE(embedded.find(text_of(image)), std::string::npos);
}

TEST_F(SplitSeedsTest, AreEffective) {
    const Value body = json_of(ask(fly + ".json?seed=4&seeds.damage=9"));
    EXPECT_EQ(body.at_pointer("/effective/seeds/damage")->as_number(), 9.0);
    EXPECT_EQ(body.at_pointer("/effective/seeds/shape"), nullptr);
    EXPECT_EQ(json_of(ask(fly + ".json?seed=4")).at_pointer("/effective/seeds"), nullptr);
}

}  // namespace
}  // namespace sporeprint::api::products_split_seeds_test
