// Trees over HTTP: lists, files, descriptions, matrices of one's own, images, and what is refused.

#include "api/products/trees.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "api/http/query.h"
#include "api/openapi.h"
#include "api/products/leaves.h"
#include "tests/api/support.h"
#include "tests/support/atlas.h"
#include "tests/support/draws.h"

namespace sporeprint::api::products_trees_test {
namespace {

using test::errors_of;
using test::expect_problem;
using test::get;
using test::header;
using test::json_of;
using test::linked_images;
using test::names;
using test::post;
using test::request;
using test::text_of;

const std::string oak = "/v1/trees/broadleaf.glb";

std::string small(const std::string& more = "") { return oak + "?lod=3&texture_size=128" + more; }

Request body(std::string json) { return post(std::move(json), "/v1/trees.glb"); }

class TreesTest : public test::RequestedService {};

TEST_F(TreesTest, NeedlesHaveABaseColourWithAlpha) {
    const std::string root = "/v1/trees/leaves/shoot/base_color";
    for (const auto& [ending, type] :
         {std::pair("png", "image/png"), std::pair("webp", "image/webp")}) {
        const Response image = ask(root + "." + ending + "?side=128");
        ASSERT_EQ(image.status, 200) << text_of(image);
        EXPECT_EQ(header(image, "Content-Type"), type);
    }
    EXPECT_TRUE(text_of(ask(root + ".png?side=128")).starts_with("\x89PNG"));
    EXPECT_EQ(ask("/v1/trees/leaves/shoot/normal.jpg?side=128").status, 200);
    // JPEG files have no alpha, and a PNG file shows others as they are.
    EXPECT_EQ(header(ask(root + ".jpg?side=128"), "Content-Type"), "image/jpeg");
    EXPECT_EQ(ask("/v1/trees/leaves/oak/base_color.png?side=128").status, 200);
    // What does not exist says what does.
    const std::vector<std::string> missing = {"/v1/trees/leaves/shoot/normal.png",
                                              "/v1/trees/leaves/oak/orm.png"};
    for (const std::string& address : missing) {
        const Response refused = ask(address);
        EXPECT_EQ(refused.status, 404) << address;
        EXPECT_TRUE(names(refused, "image", "does not exist")) << text_of(refused);
    }
    // Linked files name it, and its material leaves out what is clear.
    for (const char* const look : {"linked", "embedded"}) {
        const std::string address =
            std::string("/v1/trees/spruce.glb?lod=3&texture_size=128&textures=") + look;
        const Response file = ask(address);
        ASSERT_EQ(file.status, 200) << text_of(file);
        EXPECT_NE(text_of(file).find("\"alphaMode\":\"MASK\",\"alphaCutoff\":0.4"),
                  std::string::npos);
        if (std::string_view(look) == "embedded") continue;
        int pngs = 0;
        for (const std::string& image : linked_images(file, address)) {
            EXPECT_EQ(ask(image).status, 200) << image;
            pngs += image.find(".png?") != std::string::npos ? 1 : 0;
        }
        EXPECT_EQ(pngs, 1);
    }
}

TEST_F(TreesTest, AreListedWithLinksThatWork) {
    const Value list = json_of(ask("/v1/trees"));
    const auto& trees = list.find("trees")->items();
    ASSERT_EQ(trees.size(), tree_presets().size());
    for (const Value& tree : trees) {
        EXPECT_FALSE(tree.find("name")->as_string().empty());
        EXPECT_EQ(tree.find("order")->as_number(),
                  tree_preset(tree.find("id")->as_string())->shape.topology.order);
        for (const char* link : {"self", "model"}) {
            const std::string address = tree.find("links")->find(link)->as_string();
            EXPECT_EQ(ask(address + "?lod=3&texture_size=128").status, 200) << address;
        }
    }
    const Value about = json_of(ask("/v1"));
    EXPECT_EQ(about.at_pointer("/links/trees")->as_string(), "/v1/trees");
    EXPECT_EQ(ask(about.at_pointer("/links/tree_schema")->as_string()).status, 200);
    expect_problem(ask("/v1/trees?lod=1"), 400);
}

TEST_F(TreesTest, ComeWithAllTheirHeaders) {
    const Response response = ask(small("&seed=7"));
    ASSERT_EQ(response.status, 200) << text_of(response);
    EXPECT_EQ(text_of(response).substr(0, 4), "glTF");
    EXPECT_EQ(header(response, "Content-Type"), "model/gltf-binary");
    EXPECT_TRUE(header(response, "Content-Disposition")
                    .starts_with("inline; filename=\"broadleaf_tree_s7_"));
    EXPECT_TRUE(header(response, "Content-Disposition").ends_with("_LOD3.glb\""));
    EXPECT_EQ(header(response, "Cache-Status"),
              "sporeprint-images; fwd=miss; stored, sporeprint; fwd=miss; stored");
    const std::string timing = header(response, "Server-Timing");
    for (const char* step : {"build;dur=", "paint;dur=", "pack;dur="})
        EXPECT_NE(timing.find(step), std::string::npos) << timing;
    const std::string where = header(response, "Content-Location");
    EXPECT_TRUE(where.starts_with(oak + "?seed=7&lod=3&texture_size=128&v=")) << where;
    const Response again = ask(where);
    EXPECT_EQ(header(again, "Cache-Control"), "public, max-age=31536000, immutable");
    EXPECT_EQ(header(again, "Cache-Status"), "sporeprint; hit");
    EXPECT_EQ(header(again, "ETag"), header(response, "ETag"));
    const Response unchanged = ask(where, {{"If-None-Match", header(response, "ETag")}});
    EXPECT_EQ(unchanged.status, 304);
    EXPECT_EQ(header(unchanged, "Cache-Status"), "sporeprint; hit; detail=not-modified");
    EXPECT_EQ(generated(), 1u);
    const Response head = ask(request("HEAD", small("&seed=11")));
    EXPECT_EQ(head.status, 200);
    EXPECT_FALSE(head.has_body);
    EXPECT_EQ(generated(), 1u);
    const Response whole = ask(small("&seed=11"));
    for (const char* name : {"ETag", "Content-Type", "Content-Location", "Cache-Control"})
        EXPECT_EQ(header(head, name), header(whole, name)) << name;
    EXPECT_EQ(header(whole, "Cache-Status"), "sporeprint-images; hit, sporeprint; fwd=miss; stored")
        << "another individual wears the same images";
}

TEST_F(TreesTest, AreOneResourceHoweverTheyAreRequested) {
    const auto tag_of = [&](const std::string& address) {
        return header(ask(request("HEAD", address)), "ETag");
    };
    const std::string tag = tag_of(small("&autumn=0.5"));
    // What a preset has anyway says nothing.
    EXPECT_EQ(tree_preset("broadleaf")->shape.topology.blend, 0.6);
    for (const char* same : {"&autumn=5e-1&size=1.0", "&blend=0.60&autumn=0.50",
                             "&autumn=0.5&leaf=oak&bark.furrows=9e-1"})
        EXPECT_EQ(tag_of(small(same)), tag) << same;
    const Response posted =
        ask(body(R"({"preset":"broadleaf","texture_size":128,"lod":3,"autumn":0.5,"leaf":"oak"})"));
    EXPECT_EQ(header(posted, "ETag"), tag);
    EXPECT_EQ(text_of(posted), text_of(ask(small("&autumn=0.5"))));
    EXPECT_TRUE(header(posted, "Content-Location")
                    .starts_with(oak + "?autumn=0.5&lod=3&texture_size=128&v="));
    EXPECT_NE(tag_of(small("&autumn=0.5&leaf=maple")), tag);
    // Rows that nothing asks for say nothing.
    const std::string birch = "/v1/trees/birch.glb?lod=3&texture_size=128&matrix=perfect";
    const Response forks =
        ask(body(R"({"preset":"birch","texture_size":128,"lod":3,"matrix":"perfect"})"));
    EXPECT_EQ(header(forks, "ETag"), tag_of(birch));
    EXPECT_TRUE(header(forks, "Content-Location")
                    .starts_with("/v1/trees/birch.glb?lod=3&texture_size=128&matrix=perfect&v="));
    EXPECT_EQ(ask(header(forks, "Content-Location")).status, 200);
}

TEST_F(TreesTest, TellWhatWouldBeMade) {
    const Value description = json_of(ask("/v1/trees/birch.json?seed=3&fork_deg=30&lod=1"));
    EXPECT_EQ(description.find("canonical")->as_string(),
              "/v1/trees/birch.glb?seed=3&lod=1&fork_deg=30");
    EXPECT_EQ(description.find("preset")->as_string(), "birch");
    EXPECT_EQ(description.at_pointer("/effective/fork_deg")->as_number(), 30.0);
    EXPECT_EQ(description.at_pointer("/effective/matrix")->as_string(), "own");
    EXPECT_EQ(dump(*description.find("matrix")), dump(*description.at_pointer("/effective/rows")));
    EXPECT_EQ(description.find("expected_twigs")->as_number(),
              expected_tips(tree_preset("birch")->shape.topology));
    const Response file = ask(description.find("canonical")->as_string());
    const Value inspected = json_of(ask(post(text_of(file), "/v1/inspect", "model/gltf-binary")));
    EXPECT_EQ(inspected.find("canonical")->as_string(), description.find("canonical")->as_string());
    EXPECT_EQ(*inspected.find("effective"), *description.find("effective"));
    for (const char* count : {"vertices", "triangles"})
        EXPECT_EQ(inspected.find("counts")->find(count)->as_number(),
                  description.find("estimate")->find(count)->as_number());
    EXPECT_EQ(inspected.at_pointer("/counts/materials")->as_number(), 2.0);
    EXPECT_GT(description.at_pointer("/bounds_m/max/1")->as_number(), 3.0);
    const Value named = json_of(ask("/v1/trees/broadleaf.json?order=3"));
    EXPECT_EQ(named.find("matrix")->items().size(), 2u) << "of a named matrix too";
}

TEST_F(TreesTest, LinkedImagesAreThoseEmbedded) {
    const Response embedded = ask(small("&autumn=0.4"));
    const Response linked = ask(small("&autumn=0.4&textures=linked"));
    ASSERT_EQ(linked.status, 200) << text_of(linked);
    EXPECT_EQ(header(linked, "Cache-Status"), "sporeprint; fwd=miss; stored");
    int bark = 0, leaves = 0;
    for (const std::string& address : linked_images(linked, small())) {
        const bool of_bark = address.starts_with("/v1/trees/broadleaf/");
        EXPECT_TRUE(of_bark || address.starts_with("/v1/trees/leaves/oak/")) << address;
        ++(of_bark ? bark : leaves);
        const Response image = ask(address);
        ASSERT_EQ(image.status, 200) << address << text_of(image);
        const bool has_alpha = !of_bark && address.find("/base_color.") != std::string::npos;
        EXPECT_EQ(header(image, "Content-Type"), has_alpha ? "image/png" : "image/jpeg");
        EXPECT_EQ(header(image, "Cache-Control"), "public, max-age=31536000, immutable");
        EXPECT_EQ(header(image, "Content-Location"), address);
        EXPECT_EQ(header(image, "Cache-Status"), "sporeprint-images; hit");
        EXPECT_NE(text_of(embedded).find(text_of(image)), std::string::npos) << address;
        EXPECT_EQ(ask(address, {{"If-None-Match", header(image, "ETag")}}).status, 304);
        Service other(built_in_atlas(), ServiceOptions{});
        const Response elsewhere = handle(other, get(address));
        EXPECT_EQ(header(elsewhere, "Cache-Status"), "sporeprint-images; fwd=miss; stored");
        EXPECT_EQ(text_of(elsewhere), text_of(image));
        EXPECT_EQ(header(elsewhere, "ETag"), header(image, "ETag"));
    }
    EXPECT_EQ(bark, 3);
    EXPECT_EQ(leaves, 3);
    EXPECT_EQ(service_.counters().painted, 2u);
    // The images that a tree painted are those of its leaf with sprays, without holes and marks.
    const Response leaf =
        ask("/v1/leaves/oak/base_color.png?side=16&autumn=0.4&eaten=0&marks=0&sprays=true");
    EXPECT_EQ(header(leaf, "Cache-Status"), "sporeprint-images; hit");
    EXPECT_NE(header(ask("/v1/trees/birch/orm.jpg"), "Content-Disposition").find("-orm.jpg"),
              std::string::npos);
}

TEST_F(TreesTest, GrowFromAMatrixOfOnesOwn) {
    const std::string json =
        R"({"preset":"broadleaf","lod":3,"texture_size":128,"rows":[[0.5,0.5],[0.25,0.5,0.25]]})";
    const Response own = ask(body(json));
    ASSERT_EQ(own.status, 200) << text_of(own);
    EXPECT_EQ(header(own, "Content-Location"), "") << "no address says it";
    const Value inspected = json_of(ask(post(text_of(own), "/v1/inspect", "model/gltf-binary")));
    EXPECT_EQ(inspected.at_pointer("/effective/matrix")->as_string(), "own");
    EXPECT_EQ(inspected.at_pointer("/effective/order")->as_number(), 3.0)
        << "the highest that it has";
    EXPECT_EQ(inspected.at_pointer("/effective/blend")->as_number(), 0.0) << "and nothing else";
    EXPECT_TRUE(inspected.find("canonical")->is_null());
    // The same, written at length; and with the images of its bark elsewhere.
    const Response same =
        ask(body(R"({"preset":"broadleaf","lod":3,"texture_size":128,"matrix":"own","order":3,)"
                 R"("rows":[[0.5,0.5],[0.25,0.50,0.25]]})"));
    EXPECT_EQ(header(same, "ETag"), header(own, "ETag"));
    EXPECT_EQ(header(same, "Cache-Status"), "sporeprint; hit");
    const Response linked =
        ask(body(R"({"preset":"broadleaf","lod":3,"rows":[[0.5,0.5]],"textures":"linked"})"));
    EXPECT_EQ(linked.status, 200) << text_of(linked);
    // Rows that a preset has are its own.
    const Response birch = ask(
        body(R"({"preset":"herb","lod":3,"texture_size":128,"rows":[[0.6,0.4],[0.25,0.6,0.15]]})"));
    EXPECT_TRUE(header(birch, "Content-Location")
                    .starts_with("/v1/trees/herb.glb?lod=3&texture_size=128&v="));
    // Half way from a named matrix to one's own.
    EXPECT_EQ(ask(body(R"({"preset":"broadleaf","lod":3,"texture_size":128,"order":2,)"
                       R"("toward":"own","blend":0.5,"rows":[[0.5,0.5]]})"))
                  .status,
              200);
}

TEST_F(TreesTest, BranchesBeyondAllBoundsAre422AndNamed) {
    const Response far = ask(body(R"({"preset":"broadleaf","lod":3,"texture_size":128,"order":7,)"
                                  R"("length_rise":4,"twig_length":1,"leaves":{"per_tip":0}})"));
    expect_problem(far, 422);
    EXPECT_TRUE(names(far, "/twig_length", "outside -10000..10000 m")) << text_of(far);
    EXPECT_EQ(errors_of(far).size(), 1u);
}

TEST_F(TreesTest, ErrorsOfAMatrixAreNamedByRow) {
    const auto refused = [&](const std::string& more, int status, const char* parameter,
                             const char* words) {
        const Response response = ask(body(R"({"preset":"broadleaf",)" + more + "}"));
        expect_problem(response, status);
        EXPECT_TRUE(names(response, parameter, words)) << text_of(response);
        return response;
    };
    refused(R"("rows":[[0.5,0.5],[0.5,0.25,0.2]])", 422, "/rows/1", "sum to 0.95");
    refused(R"("rows":[[1.25,-0.25]])", 422, "/rows/0/1", "-0.25 is outside 0..1");
    refused(R"("rows":[[0.5,0.5],[0.5,0.5,0]])", 422, "/rows/1/2", "order 3 would hardly ever end");
    refused(R"("rows":[[0.5,0.5],[0.5,0.5]])", 422, "/rows/1", "the row of order 3 has 3");
    refused(R"("rows":[])", 422, "/rows", "0 rows");
    refused(R"("rows":[[0.5,0.5]],"order":4)", 422, "/order", "4 needs 3 rows");
    refused(R"("rows":[[0.5,0.5]],"matrix":"perfect")", 422, "/rows", "none of them is");
    refused(R"("matrix":"own")", 422, "/rows", "no rows are given");
    refused(R"("rows":[["x",0.5]])", 400, "/rows/0/0", "expected a number");
    refused(R"("rows":7)", 400, "/rows", "expected a list");
    // About a million twigs are refused with their number, before any is grown.
    refused(R"("rows":[[0.99,0.01],[0,0.99,0.01],[0,0,0.99,0.01]])", 422, "/order",
            "about 1030301 twigs; at most 40000");
    const Response both =
        refused(R"("rows":[[0.5,0.4],[0.5,0.25,0.2]],"autumn":2)", 400, "/autumn", "outside");
    EXPECT_TRUE(names(both, "/rows/0", "sum to 0.9"));
    EXPECT_TRUE(names(both, "/rows/1", "sum to 0.95"));
    EXPECT_EQ(errors_of(both).size(), 3u) << text_of(both);
    const Response requested = ask(oak + "?matrix=own");
    expect_problem(requested, 422);
    EXPECT_TRUE(names(requested, "rows", "no rows are given"));
    EXPECT_EQ(generated(), 0u);
}

TEST_F(TreesTest, WhatIsTooMuchIs422WithItsSizeBeforeAnyWork) {
    const Response spec = ask(oak + "?order=12&matrix=random_binary&blend=0");
    expect_problem(spec, 422);
    EXPECT_TRUE(names(spec, "order", "about 2796203 twigs; at most 40000")) << text_of(spec);
    const Response leaves = ask(oak + "?leaves.per_tip=40&matrix=random_binary&blend=0");
    expect_problem(leaves, 422);
    EXPECT_TRUE(names(leaves, "leaves.per_tip", "109240 leaves"));
    EXPECT_TRUE(names(ask(body(R"({"preset":"broadleaf","matrix":"random_binary","blend":0,)"
                               R"("leaves":{"per_tip":40}})")),
                      "/leaves/per_tip", "109240 leaves"));
    const Response thin =
        ask(oak + "?twig_length=1&twig_radius=0.0001&length_rise=4&width_law=constant");
    expect_problem(thin, 422);
    EXPECT_TRUE(names(thin, "twig_radius", "so thin"));
    const Response pipes = ask(oak + "?width_rise=0.5");
    expect_problem(pipes, 422);
    EXPECT_TRUE(names(pipes, "width_rise", "less than 1"));
    EXPECT_EQ(generated(), 0u);

    ServiceOptions options;
    options.most_vertices = 6000;
    options.most_texels = 6 * 256 * 256;
    Service poor(built_in_atlas(), options);
    const Response response = handle(poor, get(oak));
    expect_problem(response, 422);
    EXPECT_TRUE(names(response, "lod", "at most 6000"));
    EXPECT_TRUE(names(response, "texture_size"));
    EXPECT_TRUE(names(handle(poor, body(R"({"preset":"broadleaf"})")), "/lod"));
    const Response image = handle(poor, get("/v1/trees/birch/normal.jpg"));
    expect_problem(image, 422);
    EXPECT_TRUE(names(image, "side"));
    EXPECT_EQ(handle(poor, get("/v1/trees/herb.glb?lod=3&texture_size=256")).status, 200);
}

TEST_F(TreesTest, AllErrorsAreNamed) {
    const Response two = ask(oak + "?fork_dg=3&autumn=2");
    expect_problem(two, 400);
    EXPECT_TRUE(names(two, "fork_dg", "did you mean 'fork_deg'"));
    EXPECT_TRUE(names(two, "autumn", "outside"));
    EXPECT_EQ(errors_of(two).size(), 2u);
    for (const char* query : {"order=13", "order=0", "leaf=elm", "seed=-1", "bark.ridge=brown",
                              "lod=8", "texture_size=1000", "matrix=mine", "trunk=1e999", "age=0.5",
                              "seed=1&seed=2", "leaves=3", "rows=1", "twig_length=NaN"})
        expect_problem(ask(oak + '?' + query), 400);
    const Response unknown = ask("/v1/trees/brodleaf.glb?autumn=2");
    expect_problem(unknown, 404);
    EXPECT_TRUE(names(unknown, "preset", "did you mean 'broadleaf'"));
    EXPECT_TRUE(names(unknown, "autumn"));
    expect_problem(ask(request("POST", oak, {}, "{}")), 405);
}

TEST_F(TreesTest, ErrorsOfABodyArePointersIntoIt) {
    const auto refused = [&](std::string json, int status, const char* parameter,
                             const char* words) {
        const Response response = ask(body(std::move(json)));
        expect_problem(response, status);
        EXPECT_TRUE(names(response, parameter, words)) << text_of(response);
    };
    refused("{}", 400, "/preset", "is missing");
    refused(R"({"preset":7})", 400, "/preset", "expected text");
    refused(R"({"preset":"palm"})", 404, "/preset", "unknown tree 'palm'");
    refused(R"({"preset":"herb","order":2.5})", 400, "/order", "whole");
    refused(R"({"preset":"herb","leaves":[]})", 400, "/leaves", "object");
    refused(R"({"preset":"herb","bark":{"ridge":"#12345"}})", 400, "/bark/ridge", "");
    refused(R"({"preset":"herb","__proto__":1})", 400, "/__proto__", "unknown");
    refused("[]", 400, "", "expected an object");
    refused(R"({"preset":"herb","v":"0-00000000"})", 410, "/v", "no longer made");
    expect_problem(ask(post("{}", "/v1/trees.glb?seed=1")), 400);
    expect_problem(ask(post("{}", "/v1/trees.glb", "text/plain")), 415);
    expect_problem(ask(body(std::string(300'000, ' '))), 413);
}

TEST_F(TreesTest, VersionsOfYesterdayAre410WithTheAddressOfToday) {
    const std::string canonical = header(ask(request("HEAD", small())), "Content-Location");
    const Response old = ask(small("&v=0-00000000"));
    expect_problem(old, 410);
    EXPECT_EQ(json_of(old).find("canonical")->as_string(), canonical);
    EXPECT_EQ(ask(canonical).status, 200);
    const std::string image = "/v1/trees/birch/normal.jpg";
    const Response painted = ask(image + "?v=x");
    expect_problem(painted, 410);
    EXPECT_TRUE(json_of(painted).find("canonical")->as_string().starts_with(image + "?v="));
    expect_problem(ask("/v1/trees/birch/colour.jpg"), 404);
    expect_problem(ask("/v1/trees/palm/normal.jpg"), 404);
    EXPECT_EQ(ask(image + "?fork_deg=3").status, 200) << "of the tree that links to it";
    expect_problem(ask(image + "?colour=3"), 400);
}

TEST(TreeSchema, SaysWhoseDefaultsAreThePresets) {
    const Value schema = test::document_at("/v1/trees/schema");
    std::set<std::string> own, preset;
    const std::function<void(const Value&, const std::string&)> walk =
        [&](const Value& object, const std::string& prefix) {
            for (const auto& [key, property] : object.find("properties")->members()) {
                if (property.find("properties")) {
                    walk(property, prefix + key + '.');
                    continue;
                }
                const Value* from = property.find("x-default-from");
                EXPECT_NE(from != nullptr, property.find("default") != nullptr) << prefix << key;
                (from ? preset : own).insert(prefix + key);
            }
        };
    walk(schema, "");
    // Options of files belong to no preset; others are added as engines need them.
    FileOptions::fields([&](auto, const Info& option) {
        EXPECT_EQ(own.erase(option.name) + preset.erase(option.name), 1U);
    });
    EXPECT_EQ(preset.erase("lod"), 1U) << "which the profile sets";
    EXPECT_EQ(own, (std::set<std::string>{"seed", "size", "spring", "autumn", "snow", "foot_soil",
                                          "texture_size", "textures", "instancing"}));
    for (const char* name :
         {"order", "matrix", "rows", "trunk", "leaf", "leaves.per_tip", "bark.furrows"})
        EXPECT_TRUE(preset.contains(name)) << name;
}

RC_GTEST_PROP(TreeAddressProperty, AnAddressMeansWhatItsOrderMeans, ()) {
    Random random(*rc::gen::arbitrary<std::uint32_t>(), 1);
    const auto& preset = tree_presets()[random.bits() % tree_presets().size()];
    PresetRequest<Trees> requested{{preset.id.string(), params_of(preset)}, Product::glb, {}};
    draw(requested.spec.params, Info{.name = ""}, random);
    without_unused_rows(requested.spec.params);
    std::vector<Problem> problems;
    check(requested.spec.params, Info{.name = ""}, "", problems);
    RC_PRE(problems.empty());

    const std::string text = canonical_address<Trees>(atlas(), requested.spec, Product::glb);
    const Target target = split_target(text, problems);
    RC_ASSERT(problems.empty());
    ValidationErrors errors;
    const auto read = read_preset<Trees>(atlas(), preset.id.string(), target.query, errors);
    RC_ASSERT(errors.empty());
    RC_ASSERT(read.spec.params == requested.spec.params);
    RC_ASSERT(canonical_address<Trees>(atlas(), read.spec, Product::glb) == text);
    Value json = write(requested.spec.params);
    if (requested.spec.params.look.shape.topology.rows.empty()) json.erase("rows");
    json.set("preset", preset.id.string());
    const auto posted = read_preset<Trees>(atlas(), dump(json), errors);
    RC_ASSERT(errors.empty());
    RC_ASSERT(key_of<Trees>(posted.spec, Product::glb, "v") ==
              key_of<Trees>(requested.spec, Product::glb, "v"));

    // Its images are painted from their address alone.
    const TreePaint paint = paint_of(requested.spec.params);
    const std::string image =
        canonical_image_address<Trees>(atlas(), folder_of(Trees::all), preset.id.string(),
                                       ImageKind::orm, ImageFormat::jpg, paint);
    RC_ASSERT(image.size() <= longest_target);
    const Target there = split_target(image, problems);
    RC_ASSERT(problems.empty());
    const auto surface =
        read_preset_surface<Trees>(atlas(), preset.id.string(), "orm", there.query, errors);
    RC_ASSERT(errors.empty());
    RC_ASSERT(surface.paint == paint);
    RC_ASSERT(surface.kind == ImageKind::orm);
}

}  // namespace
}  // namespace sporeprint::api::products_trees_test
