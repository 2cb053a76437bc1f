// Branched species over HTTP: files, descriptions, mixes, bodies with a model of one's own, linked images, clips, and what is refused.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/params/reader.h"
#include "tests/api/support.h"

namespace sporeprint::api::products_corals_test {
namespace {

using test::expect_linked_images;
using test::expect_problem;
using test::get;
using test::header;
using test::json_of;
using test::names;
using test::post;
using test::text_of;

constexpr const char* mixed = "ramaria_formosa:0.5,xylaria_hypoxylon:0.5";

std::string glb(const std::string& mix, const std::string& more = "") {
    return "/v1/mushrooms/" + mix + ".glb?lod=3&texture_size=128" + more;
}

class CoralsTest : public test::RequestedService {};

TEST_F(CoralsTest, EachAndTheirMixesAreGrownCachedAndDescribed) {
    for (const std::string mix :
         {"ramaria_formosa", "xylaria_hypoxylon", "artomyces_pyxidatus", mixed}) {
        const Response generated = ask(glb(mix));
        ASSERT_EQ(generated.status, 200) << text_of(generated);
        EXPECT_EQ(text_of(generated).substr(0, 4), "glTF");
        EXPECT_EQ(header(ask(glb(mix)), "Cache-Status"), "sporeprint; hit");
        EXPECT_EQ(ask(glb(mix), {{"If-None-Match", header(generated, "ETag")}}).status, 304);
        const Response description = ask("/v1/mushrooms/" + mix + ".json?lod=3");
        ASSERT_EQ(description.status, 200) << text_of(description);
        const Value body = json_of(description);
        EXPECT_GT(body.at_pointer("/estimate/triangles")->as_number(), 0.0);
        EXPECT_LE(body.at_pointer("/estimate/triangles")->as_number(), 256.0);
        // What it cannot have has no value of its own.
        EXPECT_EQ(body.at_pointer("/effective/hymenium/blades"), nullptr);
        EXPECT_EQ(body.at_pointer("/effective/weathering/waves"), nullptr);
        EXPECT_NE(body.at_pointer("/effective/weathering/bites"), nullptr);
    }
}

TEST_F(CoralsTest, FamiliesDoNotMixAndAreNamed) {
    const Response response = ask(glb("boletus_edulis:0.5,ramaria_formosa:0.5"));
    expect_problem(response, 422);
    EXPECT_TRUE(names(response, "mix",
                      "Ramaria formosa branches; Boletus edulis does not: a mix needs one family"))
        << text_of(response);
    expect_problem(ask("/v1/colonies/boletus_edulis:0.5,ramaria_formosa:0.5.glb"), 422);
    expect_problem(ask("/v1/mushrooms/boletus_edulis:0.5,ramaria_formosa:0.5/normal.jpg"), 422);
}

TEST_F(CoralsTest, WhatACoralCannotHaveIs422InWords) {
    const Response response =
        ask(glb("ramaria_formosa", "&hymenium.blades=30&weathering.splits=0.4"));
    expect_problem(response, 422);
    EXPECT_TRUE(names(response, "hymenium.blades", "smooth all over"));
    EXPECT_TRUE(names(response, "weathering.splits", "no margin"));
}

TEST_F(CoralsTest, LinkedImagesAreThoseEmbedded) {
    const Response embedded = ask(glb(mixed, "&age=0.85"));
    const Response linked = ask(glb(mixed, "&age=0.85&textures=linked"));
    EXPECT_EQ(expect_linked_images(service_, linked, embedded).size(), 3U);
}

TEST_F(CoralsTest, ALifeIsAClipOfOneTopology) {
    const Response clip = ask(glb(mixed, "&animation=growth&frames=5"));
    ASSERT_EQ(clip.status, 200) << text_of(clip);
    EXPECT_NE(text_of(clip).find("\"targets\""), std::string::npos);
}

TEST_F(CoralsTest, AModelOfOnesOwnMayBranch) {
    const auto atlas = built_in_atlas();
    Value model = write(atlas->find("xylaria_hypoxylon")->species.stages[2].model);
    const auto requested = [&] {
        return ask(post("{\"lod\":3,\"texture_size\":128,\"model\":" + dump(model) + "}"));
    };
    EXPECT_EQ(requested().status, 200) << text_of(requested());
    model.find("ramification")->set("order", 12);
    const Response many = requested();
    expect_problem(many, 422);
    EXPECT_TRUE(names(many, "/model/ramification/order", "tips; at most 600"));
    model.find("ramification")->set("order", 1);
    EXPECT_TRUE(names(requested(), "/model/ramification/order", "no fork"));
    model.set("silhouette", Value::object());
    EXPECT_TRUE(names(requested(), "/model/silhouette")) << "a branched form has no outline";
}

TEST_F(CoralsTest, ColoniesStandThemWhole) {
    const Response generated =
        ask("/v1/colonies/xylaria_hypoxylon.glb?count=5&lod=3&texture_size=128");
    ASSERT_EQ(generated.status, 200) << text_of(generated);
    expect_problem(ask("/v1/colonies/xylaria_hypoxylon.glb?count=5&cap_scale=2"), 422);
}

TEST_F(CoralsTest, TheSchemaOffersBothForms) {
    const std::string document = text_of(ask("/openapi.json"));
    for (const char* words : {"\"swept\"", "\"branched\"", "\"ramification\"", "\"unfolding\""})
        EXPECT_NE(document.find(words), std::string::npos) << words;
}

}  // namespace
}  // namespace sporeprint::api::products_corals_test
