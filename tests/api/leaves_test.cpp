// Leaves over HTTP: lists, files, descriptions, images, and what is refused.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <functional>
#include <set>
#include <string>

#include "api/openapi.h"
#include "api/presets.h"
#include "api/query.h"
#include "tests/api/support.h"
#include "tests/support/draws.h"

namespace sporeprint::api {
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

class LeavesTest : public test::AskedService {};

TEST_F(LeavesTest, are_listed_with_links_that_work) {
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

TEST_F(LeavesTest, come_with_all_their_headers) {
    const Answer answer = ask(small("&seed=7"));
    ASSERT_EQ(answer.status, 200) << text_of(answer);
    EXPECT_EQ(text_of(answer).substr(0, 4), "glTF");
    EXPECT_EQ(header(answer, "Content-Type"), "model/gltf-binary");
    EXPECT_EQ(header(answer, "Content-Disposition"), "inline; filename=\"maple-7.glb\"");
    EXPECT_EQ(header(answer, "Cache-Status"),
              "sporeprint-images; fwd=miss; stored, sporeprint; fwd=miss; stored");
    const std::string timing = header(answer, "Server-Timing");
    for (const char* step : {"build;dur=", "paint;dur=", "pack;dur="})
        EXPECT_NE(timing.find(step), std::string::npos) << timing;
    const std::string where = header(answer, "Content-Location");
    EXPECT_TRUE(where.starts_with(maple + "?seed=7&lod=3&texture_size=128&v=")) << where;
    const Answer again = ask(where);
    EXPECT_EQ(header(again, "Cache-Control"), "public, max-age=31536000, immutable");
    EXPECT_EQ(header(again, "Cache-Status"), "sporeprint; hit");
    EXPECT_EQ(header(again, "ETag"), header(answer, "ETag"));
    const Answer unchanged = ask(where, {{"If-None-Match", header(answer, "ETag")}});
    EXPECT_EQ(unchanged.status, 304);
    EXPECT_EQ(header(unchanged, "Cache-Status"), "sporeprint; hit; detail=not-modified");
    EXPECT_EQ(generated(), 1u);
}

TEST_F(LeavesTest, head_agrees_with_get_and_generates_nothing) {
    const Answer head = ask(request("HEAD", small("&seed=11")));
    EXPECT_EQ(head.status, 200);
    EXPECT_FALSE(head.has_body);
    EXPECT_EQ(generated(), 0u);
    const Answer whole = ask(small("&seed=11"));
    for (const char* name : {"ETag", "Content-Type", "Content-Location", "Cache-Control"})
        EXPECT_EQ(header(head, name), header(whole, name)) << name;
}

TEST_F(LeavesTest, are_one_resource_however_they_are_asked_for) {
    const std::string tag = header(ask(request("HEAD", small("&autumn=0.5"))), "ETag");
    const LeafShape own = leaf_preset("maple")->shape;
    // What a preset has anyway says nothing.
    for (const char* same : {"&autumn=5e-1&size=1.0", "&venation.lobes=5&autumn=0.50",
                             "&autumn=0.5&petiole=0.8&summer.inner=%233E6826&wave=2e-1"})
        EXPECT_EQ(header(ask(request("HEAD", small(same))), "ETag"), tag) << same;
    EXPECT_EQ(own.petiole, 0.8);
    EXPECT_EQ(own.wave, 0.2);
    const Answer posted = ask(body(
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

TEST_F(LeavesTest, tell_what_would_be_made) {
    const Value told = json_of(ask("/v1/leaves/oak.json?seed=3&venation.nodes=9&lod=1"));
    EXPECT_EQ(told.find("canonical")->as_string(),
              "/v1/leaves/oak.glb?seed=3&lod=1&venation.nodes=9");
    EXPECT_EQ(told.find("preset")->as_string(), "oak");
    EXPECT_EQ(told.at_pointer("/effective/venation/nodes")->as_number(), 9.0);
    EXPECT_EQ(told.at_pointer("/effective/petiole")->as_number(),
              leaf_preset("oak")->shape.petiole);
    const Answer file = ask(told.find("canonical")->as_string());
    const Value inspected = json_of(ask(post(text_of(file), "/v1/inspect", "model/gltf-binary")));
    EXPECT_EQ(inspected.find("canonical")->as_string(), told.find("canonical")->as_string());
    EXPECT_EQ(*inspected.find("effective"), *told.find("effective"));
    for (const char* count : {"vertices", "triangles"})
        EXPECT_EQ(inspected.find("counts")->find(count)->as_number(),
                  told.find("estimate")->find(count)->as_number());
    EXPECT_GT(told.at_pointer("/bounds_m/max/2")->as_number(), 0.05);
    EXPECT_EQ(told.at_pointer("/bounds_m/min/2")->as_number(), 0.0) << "the petiole's end";
}

TEST_F(LeavesTest, linked_images_are_those_embedded) {
    const Answer embedded = ask(small("&autumn=0.4&variation=1"));
    const Answer linked = ask(small("&autumn=0.4&variation=1&textures=linked"));
    EXPECT_EQ(header(linked, "Cache-Status"), "sporeprint; fwd=miss; stored");
    for (const std::string& address : expect_linked_images(service_, linked, embedded)) {
        EXPECT_TRUE(address.starts_with("/v1/surfaces/leaves/maple/")) << address;
        EXPECT_NE(header(ask(address), "Content-Disposition").find("maple-1-"), std::string::npos);
    }
}

TEST_F(LeavesTest, faults_are_all_named) {
    const Answer two = ask(maple + "?venation.lobs=3&autumn=2");
    expect_problem(two, 400);
    EXPECT_TRUE(names(two, "venation.lobs", "did you mean 'venation.lobes'"));
    EXPECT_TRUE(names(two, "autumn", "outside"));
    EXPECT_EQ(errors_of(two).size(), 2u);
    for (const char* query :
         {"venation.lobes=4", "venation.lobes=1e9", "seed=-1", "summer.inner=green", "lod=4",
          "texture_size=1000", "venation.law=quadratic", "length=1e999", "length=0", "age=0.5",
          "seed=1&seed=2", "venation=3", "summer.vein_width=NaN"})
        expect_problem(ask(maple + '?' + query), 400);
    const Answer unknown = ask("/v1/leaves/mapel.glb?autumn=2");
    expect_problem(unknown, 404);
    EXPECT_TRUE(names(unknown, "preset", "did you mean 'maple'"));
    EXPECT_TRUE(names(unknown, "autumn"));
    expect_problem(ask(request("POST", maple, {}, "{}")), 405);
}

TEST_F(LeavesTest, what_is_impossible_together_is_422) {
    const Answer meeting = ask(maple + "?venation.lobes=13");
    expect_problem(meeting, 422);
    EXPECT_TRUE(names(meeting, "venation.vein_deg", "petiole"));
    const Answer posted = ask(body(R"({"preset":"maple","venation":{"lobes":13}})"));
    expect_problem(posted, 422);
    EXPECT_TRUE(names(posted, "/venation/vein_deg", "petiole"));
    const Answer flat = ask("/v1/surfaces/leaves/ivy/normal.jpg?venation.side_deg=15");
    expect_problem(flat, 422);
    EXPECT_TRUE(names(flat, "venation.side_deg", "too flat"));
    EXPECT_EQ(ask(maple + "?venation.lobes=13&venation.vein_deg=20&lod=3&texture_size=128").status,
              200);
    EXPECT_EQ(generated(), 1u);
}

TEST_F(LeavesTest, faults_of_a_body_are_pointers_into_it) {
    const auto refused = [&](std::string json, int status, const char* parameter,
                             const char* words) {
        const Answer answer = ask(body(std::move(json)));
        expect_problem(answer, status);
        EXPECT_TRUE(names(answer, parameter, words)) << text_of(answer);
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

TEST_F(LeavesTest, versions_of_yesterday_are_410_with_the_address_of_today) {
    const std::string canonical = header(ask(request("HEAD", small())), "Content-Location");
    const Answer old = ask(small("&v=0-00000000"));
    expect_problem(old, 410);
    EXPECT_EQ(json_of(old).find("canonical")->as_string(), canonical);
    EXPECT_EQ(ask(canonical).status, 200);
    const std::string image = "/v1/surfaces/leaves/maple/normal.jpg";
    const Answer painted = ask(image + "?v=x");
    expect_problem(painted, 410);
    EXPECT_TRUE(json_of(painted).find("canonical")->as_string().starts_with(image + "?v="));
    expect_problem(ask("/v1/surfaces/leaves/maple/colour.jpg"), 404);
    expect_problem(ask("/v1/surfaces/leaves/elm/normal.jpg"), 404);
    expect_problem(ask(image + "?curl_deg=3"), 400);
}

TEST(LeavesBudget, what_costs_too_much_is_422_before_any_work) {
    ServiceOptions options;
    options.most_vertices = 100;
    options.most_texels = 3 * 256 * 256;
    Service service(built_in_atlas(), options);
    const Answer answer = handle(service, get(maple));
    expect_problem(answer, 422);
    EXPECT_TRUE(names(answer, "lod", "at most 100"));
    EXPECT_TRUE(names(answer, "texture_size"));
    EXPECT_TRUE(names(handle(service, body(R"({"preset":"maple"})")), "/lod"));
    const Answer image = handle(service, get("/v1/surfaces/leaves/maple/normal.jpg"));
    expect_problem(image, 422);
    EXPECT_TRUE(names(image, "texture_size"));
    EXPECT_EQ(handle(service, get(small())).status, 200);
    EXPECT_EQ(service.counters().generated, 1u);
}

TEST(LeafSchema, says_whose_defaults_are_the_presets) {
    const Value schema = leaf_schema();
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
    EXPECT_EQ(own, (std::set<std::string>{"seed", "size", "variation", "autumn", "lod",
                                          "texture_size", "textures"}));
    for (const char* name : {"venation.lobes", "length", "paler_below", "fallen.tip"})
        EXPECT_TRUE(preset.contains(name)) << name;
}

RC_GTEST_PROP(LeafAddressProperty, an_address_means_what_its_order_means, ()) {
    Random random(*rc::gen::arbitrary<std::uint32_t>(), 1);
    const auto& preset = leaf_presets()[random.bits() % leaf_presets().size()];
    PresetRequest<Leaves> asked{{preset.id, params_of(preset)}, Product::glb, {}};
    draw(asked.order.params, Info{.name = ""}, random);
    std::vector<Problem> problems;
    check(asked.order.params, Info{.name = ""}, "", problems);
    RC_PRE(problems.empty());

    const std::string text = canonical_address<Leaves>(asked.order, Product::glb);
    const Target target = split_target(text, problems);
    RC_ASSERT(problems.empty());
    Faults faults;
    const auto read = read_preset<Leaves>(preset.id, target.query, faults);
    RC_ASSERT(faults.empty());
    RC_ASSERT(read.order.params == asked.order.params);
    RC_ASSERT(canonical_address<Leaves>(read.order, Product::glb) == text);
    Value json = write(asked.order.params);
    json.set("preset", preset.id);
    const auto posted = read_preset<Leaves>(dump(json), faults);
    RC_ASSERT(faults.empty());
    RC_ASSERT(key_of<Leaves>(posted.order, Product::glb, "v") ==
              key_of<Leaves>(asked.order, Product::glb, "v"));

    // Its images are painted from their address alone.
    const LeafPaint paint = paint_of(asked.order.params);
    const std::string image = canonical_image_address<Leaves>(preset.id, ImageKind::orm, paint);
    RC_ASSERT(image.size() <= longest_target);
    const Target there = split_target(image, problems);
    RC_ASSERT(problems.empty());
    const auto surface = read_preset_surface<Leaves>(preset.id, "orm", there.query, faults);
    RC_ASSERT(faults.empty());
    RC_ASSERT(surface.paint == paint);
    RC_ASSERT(surface.kind == ImageKind::orm);
}

}  // namespace
}  // namespace sporeprint::api
