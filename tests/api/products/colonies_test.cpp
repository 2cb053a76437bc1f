// Colonies over HTTP: files, descriptions, bodies, linked images, and what is refused.

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/api/support.h"

namespace sporeprint::api::products_colonies_test {
namespace {

using test::expect_problem;
using test::get;
using test::header;
using test::json_of;
using test::linked_images;
using test::names;
using test::post;
using test::text_of;

const std::string tuft = "/v1/colonies/armillaria_mellea.glb";

std::string small(const std::string& more = "") {
    return tuft + "?count=5&distinct=2&lod=2&texture_size=128" + more;
}

class ColoniesTest : public test::RequestedService {};

TEST_F(ColoniesTest, AreFilesWithOneCanonicalAddress) {
    const Response response = ask(small("&habit=rooted&depth=8&cap_scale=1.50"));
    ASSERT_EQ(response.status, 200) << text_of(response);
    EXPECT_EQ(text_of(response).substr(0, 4), "glTF");
    EXPECT_EQ(header(response, "Content-Type"), "model/gltf-binary");
    const std::string location = header(response, "Content-Location");
    EXPECT_TRUE(location.starts_with(
        "/v1/colonies/armillaria_mellea.glb?count=5&distinct=2&habit=rooted&cap_scale=1.5&depth=8&"
        "lod=2&texture_size=128&v="))
        << location;
    const Response again = ask(location);
    EXPECT_EQ(again.status, 200);
    EXPECT_EQ(header(again, "Cache-Status"), "sporeprint; hit");
    EXPECT_EQ(header(again, "ETag"), header(response, "ETag"));
    EXPECT_NE(header(again, "Cache-Control").find("immutable"), std::string::npos);
}

TEST_F(ColoniesTest, ThatAreKnownAreNotMadeAgain) {
    const std::string tag = header(ask(small()), "ETag");
    const std::uint64_t before = generated();
    EXPECT_EQ(ask(small("&seed=1&cap_scale=1.0"), {{"If-None-Match", tag}}).status, 304);
    EXPECT_EQ(generated(), before);
    expect_problem(ask(small("&v=1-00000000")), 410);
}

TEST_F(ColoniesTest, TellHowManyWereMadeAndEveryControl) {
    const Value description =
        json_of(ask("/v1/colonies/hypholoma_fasciculare.json?habit=rooted&count=200"));
    EXPECT_GT(description.find("made")->as_number(), 3.0);
    EXPECT_LT(description.find("made")->as_number(), 200.0);
    EXPECT_EQ(description.at_pointer("/effective/habit")->as_string(), "rooted");
    EXPECT_EQ(description.at_pointer("/effective/roots")->as_string(), "shown");
    for (const char* control :
         {"field", "field_scale", "heading_deg", "arms", "segment_length", "decay", "depth",
          "branch_distance", "branch_jitter_deg", "root_radius", "area_decay", "stem_height",
          "stem_decay", "stem_probability", "stem_displacement", "stem_segments"})
        EXPECT_TRUE(description.find("effective")->find(control)) << control;
    EXPECT_EQ(description.find("canonical")->as_string(),
              "/v1/colonies/hypholoma_fasciculare.glb?count=200&habit=rooted");
    EXPECT_GT(description.at_pointer("/estimate/vertices")->as_number(), 1000.0);
    const Value tuft_description = json_of(ask("/v1/colonies/armillaria_mellea.json"));
    EXPECT_EQ(tuft_description.at_pointer("/effective/habit")->as_string(), "tuft");
}

TEST_F(ColoniesTest, OfABodyAreThoseOfTheAddress) {
    const Response by_address =
        ask("/v1/colonies/armillaria_mellea:0.6,hypholoma_fasciculare:0.4.glb?count=4&distinct=2&"
            "lod=3&textures=none");
    ASSERT_EQ(by_address.status, 200) << text_of(by_address);
    const Response by_body = ask(post(
        R"({"mix":{"hypholoma_fasciculare":2,"armillaria_mellea":3},"count":4,"distinct":2,"lod":3,"textures":"none"})",
        "/v1/colonies.glb"));
    ASSERT_EQ(by_body.status, 200) << text_of(by_body);
    EXPECT_EQ(text_of(by_body), text_of(by_address));
    EXPECT_EQ(header(by_body, "Content-Location"), header(by_address, "Content-Location"));
}

TEST_F(ColoniesTest, LinkImagesThatAreThoseTheyWouldEmbed) {
    // Variants link to images of their own, and frosted to those of the requested material.
    const std::vector<std::string> of_variants =
        linked_images(ask(small("&textures=linked&variants=weather")), small());
    ASSERT_EQ(of_variants.size(), 12U);
    std::set<std::string> different;
    for (const std::string& one : of_variants) {
        EXPECT_EQ(ask(one).status, 200) << one;
        different.insert(text_of(ask(one)));
    }
    EXPECT_GE(different.size(), 8U) << "colours and roughness of each of four materials";
    const std::vector<std::string> linked = linked_images(ask(small("&textures=linked")), small());
    ASSERT_EQ(linked.size(), 3U);
    const std::string& address = linked[0];
    EXPECT_TRUE(address.starts_with("/v1/colonies/armillaria_mellea/base_color.jpg?"));
    const Response image = ask(address);
    ASSERT_EQ(image.status, 200) << address;
    EXPECT_NE(text_of(ask(small())).find(text_of(image)), std::string::npos)
        << "the very bytes of the image inside the file";
}

TEST_F(ColoniesTest, LinkTheImagesOfTheWoodThatTheyStandOn) {
    const std::string tier = "/v1/colonies/fomes_fomentarius.glb?count=3&texture_size=128&lod=2";
    const Response embedded = ask(tier);
    std::vector<std::string> linked;
    for (const std::string& address : linked_images(ask(tier + "&textures=linked"), tier))
        if (address.find("/wood/") != std::string::npos) linked.push_back(address);
    ASSERT_EQ(linked.size(), 3U);
    for (const std::string& address : linked) {
        EXPECT_TRUE(address.starts_with("/v1/colonies/wood/birch/")) << address;
        const Response image = ask(address);
        ASSERT_EQ(image.status, 200) << address << text_of(image);
        EXPECT_EQ(header(image, "Content-Location"), address);
        EXPECT_EQ(header(image, "Cache-Control"), "public, max-age=31536000, immutable");
        EXPECT_NE(text_of(embedded).find(text_of(image)), std::string::npos) << address;
    }
    // Loaders may append the query of the model.
    EXPECT_EQ(ask("/v1/colonies/wood/birch/orm.webp?side=32&count=3&lod=2").status, 200);
    EXPECT_EQ(ask("/v1/colonies/wood/birch/orm.jpg?v=old").status, 410);
}

TEST_F(ColoniesTest, AreChargedForTheImagesOfTheirWood) {
    const auto cost = [&](const std::string& query) {
        const auto planned =
            test::plan(service_, get("/v1/colonies/fomes_fomentarius.glb?count=3" + query));
        const Job* const job = std::get_if<Job>(&planned);
        EXPECT_TRUE(job != nullptr) << query;
        return job ? job->cost : Cost{};
    };
    const Cost last = cost("&lod=3");
    EXPECT_EQ(last.texels, 3u * 128 * 128);
    EXPECT_EQ(last.bark_texels, 4u * 3 * 64 * 64)
        << "half the side, and four times the work of bark";
    EXPECT_EQ(cost("&lod=3&substrate=none").bark_texels, 0u);
    EXPECT_EQ(cost("&lod=3&textures=linked").bark_texels, 0u);
    // Of a number of triangles the level is not known yet: the first one is charged.
    const Cost chosen = cost("&triangles=1"), first = cost("&lod=0");
    EXPECT_EQ(chosen.texels, first.texels);
    EXPECT_EQ(chosen.bark_texels, first.bark_texels);
}

TEST_F(ColoniesTest, RepeatMeshesByExtensionOnRequest) {
    const std::string nodes = text_of(ask(small("&textures=none")));
    const std::string gpu = text_of(ask(small("&textures=none&instancing=gpu")));
    EXPECT_EQ(nodes.find("EXT_mesh_gpu_instancing"), std::string::npos);
    EXPECT_NE(gpu.find("EXT_mesh_gpu_instancing"), std::string::npos);
}

TEST_F(ColoniesTest, ThatCannotBeAreRefusedByNameBeforeAnyWork) {
    const std::uint64_t before = generated();
    const auto refused = [&](int status, const std::string& address, const char* parameter) {
        const Response response = ask(address);
        expect_problem(response, status);
        EXPECT_TRUE(names(response, parameter)) << text_of(response);
    };
    refused(400, tuft + "?count=0", "count");
    refused(400, tuft + "?count=257", "count");
    refused(400, tuft + "?distinct=17", "distinct");
    refused(400, tuft + "?habit=herd", "habit");
    refused(400, tuft + "?instancing=cpu", "instancing");
    refused(400, tuft + "?cuont=3", "cuont");
    refused(404, "/v1/colonies/armilaria_mellea.glb", "mix");
    refused(422, tuft + "?depth=9", "depth");
    refused(422, tuft + "?roots=shown", "roots");
    refused(422, "/v1/colonies/trametes_versicolor.glb?habit=ring", "habit");
    refused(422, tuft + "?substrate=oak", "substrate");
    refused(400, "/v1/colonies/trametes_versicolor.glb?substrate=steel", "substrate");
    refused(404, "/v1/colonies/wood/brich/normal.jpg", "wood");
    refused(400, "/v1/colonies/wood/birch/normal.jpg?side=100", "side");
    refused(422, "/v1/colonies/lycoperdon_perlatum.glb?cap_scale=2", "cap_scale");
    refused(422, tuft + "?habit=rooted&depth=60&branch_distance=0.005", "branch_distance");
    expect_problem(ask(post(R"({"count":3})", "/v1/colonies.glb")), 400);
    expect_problem(ask(post(R"({"mix":{"armillaria_mellea":1},"model":{}})", "/v1/colonies.glb")),
                   400);
    EXPECT_EQ(generated(), before);
}

TEST_F(ColoniesTest, AreDescribedByASchema) {
    const Value schema = json_of(ask("/v1/colonies/schema"));
    EXPECT_EQ(schema.at_pointer("/properties/count/maximum")->as_number(), 256.0);
    EXPECT_EQ(schema.at_pointer("/properties/count/default")->as_number(), 24.0);
    EXPECT_EQ(schema.at_pointer("/properties/habit/x-default-from")->as_string(), "species");
    EXPECT_EQ(schema.at_pointer("/properties/stem_height/x-default-from")->as_string(), "species");
    const auto group = [&](const std::string& control) {
        const Value* found = schema.at_pointer("/properties/" + control + "/x-group");
        return found ? found->as_string() : std::string();
    };
    EXPECT_EQ(group("seed"), "");
    EXPECT_EQ(group("habit"), "placement");
    EXPECT_EQ(group("size"), "individuals");
    EXPECT_EQ(group("field_scale"), "field");
    EXPECT_EQ(group("roots"), "roots");
    EXPECT_EQ(group("stem_decay"), "stems");
    EXPECT_EQ(json_of(ask("/v1")).at_pointer("/links/colony_schema")->as_string(),
              "/v1/colonies/schema");
}

}  // namespace
}  // namespace sporeprint::api::products_colonies_test
