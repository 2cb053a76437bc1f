// Leaves over HTTP: lists, files, descriptions, images, and what is refused.

#include "api/products/leaves.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <functional>
#include <set>
#include <string>

#include "api/http/query.h"
#include "api/openapi.h"
#include "api/products/trees.h"
#include "tests/api/support.h"
#include "tests/support/atlas.h"
#include "tests/support/draws.h"

namespace sporeprint::api::products_leaves_test {
namespace {

using test::errors_of;
using test::expect_linked_images;
using test::expect_problem;
using test::get;
using test::header;
using test::json_of;
using test::names;
using test::post;
using test::request;
using test::text_of;

const std::string maple = "/v1/leaves/maple.glb";

std::string small(const std::string& more = "") { return maple + "?lod=3&texture_size=128" + more; }

Request body(std::string json) { return post(std::move(json), "/v1/leaves.glb"); }

class LeavesTest : public test::RequestedService {};

TEST_F(LeavesTest, AreListedWithLinksThatWork) {
    const Value list = json_of(ask("/v1/leaves"));
    const auto& leaves = list.find("leaves")->items();
    ASSERT_EQ(leaves.size(), leaf_presets().size());
    for (const Value& leaf : leaves) {
        EXPECT_FALSE(leaf.find("name")->as_string().empty());
        for (const char* link : {"self", "model"}) {
            const std::string address = leaf.find("links")->find(link)->as_string();
            EXPECT_EQ(ask(address + "?lod=3&texture_size=128").status, 200) << address;
        }
    }
    const Value about = json_of(ask("/v1"));
    EXPECT_EQ(about.at_pointer("/links/leaves")->as_string(), "/v1/leaves");
    EXPECT_EQ(ask(about.at_pointer("/links/leaf_schema")->as_string()).status, 200);
    expect_problem(ask("/v1/leaves?lod=1"), 400);
}

TEST_F(LeavesTest, ComeWithAllTheirHeaders) {
    const Response response = ask(small("&seed=7"));
    ASSERT_EQ(response.status, 200) << text_of(response);
    EXPECT_EQ(text_of(response).substr(0, 4), "glTF");
    EXPECT_EQ(header(response, "Content-Type"), "model/gltf-binary");
    EXPECT_TRUE(
        header(response, "Content-Disposition").starts_with("inline; filename=\"maple_leaf_s7_"));
    EXPECT_TRUE(header(response, "Content-Disposition").ends_with("_LOD3.glb\""));
    EXPECT_EQ(header(response, "Cache-Status"),
              "sporeprint-images; fwd=miss; stored, sporeprint; fwd=miss; stored");
    const std::string timing = header(response, "Server-Timing");
    for (const char* step : {"build;dur=", "paint;dur=", "pack;dur="})
        EXPECT_NE(timing.find(step), std::string::npos) << timing;
    const std::string where = header(response, "Content-Location");
    EXPECT_TRUE(where.starts_with(maple + "?seed=7&lod=3&texture_size=128&v=")) << where;
    const Response again = ask(where);
    EXPECT_EQ(header(again, "Cache-Control"), "public, max-age=31536000, immutable");
    EXPECT_EQ(header(again, "Cache-Status"), "sporeprint; hit");
    EXPECT_EQ(header(again, "ETag"), header(response, "ETag"));
    const Response unchanged = ask(where, {{"If-None-Match", header(response, "ETag")}});
    EXPECT_EQ(unchanged.status, 304);
    EXPECT_EQ(header(unchanged, "Cache-Status"), "sporeprint; hit; detail=not-modified");
    EXPECT_EQ(generated(), 1u);
}

TEST_F(LeavesTest, HeadAgreesWithGetAndGeneratesNothing) {
    const Response head = ask(request("HEAD", small("&seed=11")));
    EXPECT_EQ(head.status, 200);
    EXPECT_FALSE(head.has_body);
    EXPECT_EQ(generated(), 0u);
    const Response whole = ask(small("&seed=11"));
    for (const char* name : {"ETag", "Content-Type", "Content-Location", "Cache-Control"})
        EXPECT_EQ(header(head, name), header(whole, name)) << name;
}

TEST_F(LeavesTest, AreOneResourceHoweverTheyAreRequested) {
    const std::string tag = header(ask(request("HEAD", small("&autumn=0.5"))), "ETag");
    const LeafShape own = leaf_preset("maple")->shape;
    // What a preset has anyway says nothing.
    for (const char* same : {"&autumn=5e-1&size=1.0", "&venation.lobes=5&autumn=0.50",
                             "&autumn=0.5&petiole=0.8&summer.inner=%233E6826&wave=2e-1"})
        EXPECT_EQ(header(ask(request("HEAD", small(same))), "ETag"), tag) << same;
    EXPECT_EQ(own.petiole, 0.8);
    EXPECT_EQ(own.wave, 0.2);
    const Response posted = ask(body(
        R"({"preset":"maple","texture_size":128,"lod":3,"autumn":0.5,"venation":{"lobes":5}})"));
    EXPECT_EQ(header(posted, "ETag"), tag);
    EXPECT_EQ(text_of(posted), text_of(ask(small("&autumn=0.5"))));
    EXPECT_TRUE(header(posted, "Content-Location")
                    .starts_with(maple + "?autumn=0.5&lod=3&texture_size=128&v="));
    const std::string other = header(ask(request("HEAD", small("&venation.lobes=7"))), "ETag");
    EXPECT_NE(other, tag);
    EXPECT_EQ(header(ask(request("HEAD", small("&curl_deg=-0"))), "ETag"),
              header(ask(request("HEAD", small("&curl_deg=0"))), "ETag"));
}

TEST_F(LeavesTest, TellWhatWouldBeMade) {
    const Value description = json_of(ask("/v1/leaves/oak.json?seed=3&venation.nodes=9&lod=1"));
    EXPECT_EQ(description.find("canonical")->as_string(),
              "/v1/leaves/oak.glb?seed=3&lod=1&venation.nodes=9");
    EXPECT_EQ(description.find("preset")->as_string(), "oak");
    EXPECT_EQ(description.at_pointer("/effective/venation/nodes")->as_number(), 9.0);
    EXPECT_EQ(description.at_pointer("/effective/petiole")->as_number(),
              leaf_preset("oak")->shape.petiole);
    const Response file = ask(description.find("canonical")->as_string());
    const Value inspected = json_of(ask(post(text_of(file), "/v1/inspect", "model/gltf-binary")));
    EXPECT_EQ(inspected.find("canonical")->as_string(), description.find("canonical")->as_string());
    EXPECT_EQ(*inspected.find("effective"), *description.find("effective"));
    for (const char* count : {"vertices", "triangles"})
        EXPECT_EQ(inspected.find("counts")->find(count)->as_number(),
                  description.find("estimate")->find(count)->as_number());
    EXPECT_GT(description.at_pointer("/bounds_m/max/2")->as_number(), 0.05);
    EXPECT_EQ(description.at_pointer("/bounds_m/min/2")->as_number(), 0.0) << "the petiole's end";
}

TEST_F(LeavesTest, LinkedImagesAreThoseEmbedded) {
    const Response embedded = ask(small("&autumn=0.4&variation=1"));
    const Response linked = ask(small("&autumn=0.4&variation=1&textures=linked"));
    EXPECT_EQ(header(linked, "Cache-Status"), "sporeprint; fwd=miss; stored");
    for (const std::string& address : expect_linked_images(service_, linked, embedded)) {
        EXPECT_TRUE(address.starts_with("/v1/leaves/maple/")) << address;
        EXPECT_NE(header(ask(address), "Content-Disposition").find("maple-1-"), std::string::npos);
    }
}

TEST_F(LeavesTest, AllErrorsAreNamed) {
    const Response two = ask(maple + "?venation.lobs=3&autumn=2");
    expect_problem(two, 400);
    EXPECT_TRUE(names(two, "venation.lobs", "did you mean 'venation.lobes'"));
    EXPECT_TRUE(names(two, "autumn", "outside"));
    EXPECT_EQ(errors_of(two).size(), 2u);
    for (const char* query :
         {"venation.lobes=4", "venation.lobes=1e9", "seed=-1", "summer.inner=green", "lod=4",
          "texture_size=1000", "venation.law=quadratic", "length=1e999", "length=0", "age=0.5",
          "seed=1&seed=2", "venation=3", "summer.vein_width=NaN"})
        expect_problem(ask(maple + '?' + query), 400);
    const Response unknown = ask("/v1/leaves/mapel.glb?autumn=2");
    expect_problem(unknown, 404);
    EXPECT_TRUE(names(unknown, "preset", "did you mean 'maple'"));
    EXPECT_TRUE(names(unknown, "autumn"));
    expect_problem(ask(request("POST", maple, {}, "{}")), 405);
}

TEST_F(LeavesTest, WhatIsImpossibleTogetherIs422) {
    const Response meeting = ask(maple + "?venation.lobes=13");
    expect_problem(meeting, 422);
    EXPECT_TRUE(names(meeting, "venation.vein_deg", "petiole"));
    const Response posted = ask(body(R"({"preset":"maple","venation":{"lobes":13}})"));
    expect_problem(posted, 422);
    EXPECT_TRUE(names(posted, "/venation/vein_deg", "petiole"));
    const Response flat = ask("/v1/leaves/ivy/normal.jpg?venation.side_deg=15");
    expect_problem(flat, 422);
    EXPECT_TRUE(names(flat, "venation.side_deg", "too flat"));
    EXPECT_EQ(ask(maple + "?venation.lobes=13&venation.vein_deg=20&lod=3&texture_size=128").status,
              200);
    EXPECT_EQ(generated(), 1u);
}

TEST_F(LeavesTest, ErrorsOfABodyArePointersIntoIt) {
    const auto refused = [&](std::string json, int status, const char* parameter,
                             const char* words) {
        const Response response = ask(body(std::move(json)));
        expect_problem(response, status);
        EXPECT_TRUE(names(response, parameter, words)) << text_of(response);
    };
    refused("{}", 400, "/preset", "is missing");
    refused(R"({"preset":7})", 400, "/preset", "expected text");
    refused(R"({"preset":"elm"})", 404, "/preset", "unknown leaf 'elm'");
    refused(R"({"preset":"oak","venation":{"nodes":2.5}})", 400, "/venation/nodes", "whole");
    refused(R"({"preset":"oak","venation":[]})", 400, "/venation", "object");
    refused(R"({"preset":"oak","summer":{"inner":"#12345"}})", 400, "/summer/inner", "");
    refused(R"({"preset":"oak","length":1e999})", 400, "", "");
    refused(R"({"preset":"oak","length":0.1,"length":0.2})", 400, "", "");
    refused(R"({"preset":"oak","__proto__":1})", 400, "/__proto__", "unknown");
    refused("[]", 400, "", "expected an object");
    refused(R"({"preset":"oak","v":"0-00000000"})", 410, "/v", "no longer made");
    expect_problem(ask(post("{}", "/v1/leaves.glb?seed=1")), 400);
    expect_problem(ask(post("{}", "/v1/leaves.glb", "text/plain")), 415);
    expect_problem(ask(body(std::string(300'000, ' '))), 413);
}

TEST_F(LeavesTest, VersionsOfYesterdayAre410WithTheAddressOfToday) {
    const std::string canonical = header(ask(request("HEAD", small())), "Content-Location");
    const Response old = ask(small("&v=0-00000000"));
    expect_problem(old, 410);
    EXPECT_EQ(json_of(old).find("canonical")->as_string(), canonical);
    EXPECT_EQ(ask(canonical).status, 200);
    const std::string image = "/v1/leaves/maple/normal.jpg";
    const Response painted = ask(image + "?v=x");
    expect_problem(painted, 410);
    EXPECT_TRUE(json_of(painted).find("canonical")->as_string().starts_with(image + "?v="));
    expect_problem(ask("/v1/leaves/maple/colour.jpg"), 404);
    expect_problem(ask("/v1/leaves/elm/normal.jpg"), 404);
    EXPECT_EQ(ask(image + "?curl_deg=3").status, 200) << "of the leaf that links to it";
    expect_problem(ask(image + "?colour=3"), 400);
}

TEST(LeavesBudget, WhatCostsTooMuchIs422BeforeAnyWork) {
    ServiceOptions options;
    options.most_vertices = 100;
    options.most_texels = 3 * 256 * 256;
    Service service(built_in_atlas(), options);
    const Response response = handle(service, get(maple));
    expect_problem(response, 422);
    EXPECT_TRUE(names(response, "lod", "at most 100"));
    EXPECT_TRUE(names(response, "texture_size"));
    EXPECT_TRUE(names(handle(service, body(R"({"preset":"maple"})")), "/lod"));
    const Response image = handle(service, get("/v1/leaves/maple/normal.jpg"));
    expect_problem(image, 422);
    EXPECT_TRUE(names(image, "side"));
    EXPECT_EQ(handle(service, get(small())).status, 200);
    EXPECT_EQ(service.counters().generated, 1u);
}

TEST(LeafSchema, SaysWhoseDefaultsAreThePresets) {
    const Value schema = test::document_at("/v1/leaves/schema");
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
    EXPECT_EQ(own, (std::set<std::string>{"seed", "size", "variation", "spring", "autumn", "snow",
                                          "texture_size", "textures"}));
    for (const char* name : {"venation.lobes", "length", "paler_below", "fallen.tip"})
        EXPECT_TRUE(preset.contains(name)) << name;
}

RC_GTEST_PROP(LeafAddressProperty, AnAddressMeansWhatItsOrderMeans, ()) {
    Random random(*rc::gen::arbitrary<std::uint32_t>(), 1);
    const auto& preset = leaf_presets()[random.bits() % leaf_presets().size()];
    PresetRequest<Leaves> requested{{preset.id.string(), params_of(preset)}, Product::glb, {}};
    draw(requested.spec.params, Info{.name = ""}, random);
    std::vector<Problem> problems;
    check(requested.spec.params, Info{.name = ""}, "", problems);
    RC_PRE(problems.empty());

    const std::string text = canonical_address<Leaves>(atlas(), requested.spec, Product::glb);
    const Target target = split_target(text, problems);
    RC_ASSERT(problems.empty());
    ValidationErrors errors;
    const auto read = read_preset<Leaves>(atlas(), preset.id.string(), target.query, errors);
    RC_ASSERT(errors.empty());
    RC_ASSERT(read.spec.params == requested.spec.params);
    RC_ASSERT(canonical_address<Leaves>(atlas(), read.spec, Product::glb) == text);
    Value json = write(requested.spec.params);
    json.set("preset", preset.id.string());
    const auto posted = read_preset<Leaves>(atlas(), dump(json), errors);
    RC_ASSERT(errors.empty());
    RC_ASSERT(key_of<Leaves>(posted.spec, Product::glb, "v") ==
              key_of<Leaves>(requested.spec, Product::glb, "v"));

    // Its images are painted from their address alone.
    const LeafPaint paint = paint_of(requested.spec.params);
    const std::string image =
        canonical_image_address<Leaves>(atlas(), folder_of(Leaves::all), preset.id.string(),
                                        ImageKind::orm, ImageFormat::jpg, paint);
    RC_ASSERT(image.size() <= longest_target);
    const Target there = split_target(image, problems);
    RC_ASSERT(problems.empty());
    const auto surface =
        read_preset_surface<Leaves>(atlas(), preset.id.string(), "orm", there.query, errors);
    RC_ASSERT(errors.empty());
    RC_ASSERT(surface.paint == paint);
    RC_ASSERT(surface.kind == ImageKind::orm);
}

}  // namespace
}  // namespace sporeprint::api::products_leaves_test
