// Profiles of engines in requests for every product.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tests/api/support.h"

namespace sporeprint::api::products_profiles_test {
namespace {

using test::get;
using test::header;

/// One small request of each product, without profile.
constexpr std::array<const char*, 4> small = {"/v1/mushrooms/amanita_muscaria",
                                              "/v1/colonies/hypholoma_fasciculare",
                                              "/v1/leaves/maple", "/v1/trees/birch"};

std::string canonical_of(Service& service, const std::string& target) {
    const Response response = handle(service, get(target));
    EXPECT_EQ(response.status, 200) << target << test::text_of(response);
    std::vector<Problem> problems;
    const Value body = parse(test::text_of(response), problems);
    const Value* const canonical = body.find("canonical");
    return canonical ? canonical->as_string() : "";
}

TEST(Profiles, SetTheDefaultsOfOtherOptions) {
    Service service(built_in_atlas(), ServiceOptions{});
    for (const std::string base : small) {
        const std::string file = base + ".glb?lod=3&texture_size=128&profile=web";
        const Response web = handle(service, get(file));
        ASSERT_EQ(web.status, 200) << test::text_of(web);
        const std::string text = test::text_of(web);
        EXPECT_NE(text.find("\"extensionsRequired\":[\"KHR_mesh_quantization\","
                            "\"EXT_meshopt_compression\",\"EXT_texture_webp\"]"),
                  std::string::npos)
            << base;
        EXPECT_NE(
            text.find("\"profile\":\"web\",\"compress\":\"meshopt\",\"image_format\":\"webp\""),
            std::string::npos)
            << "effective values are those of the profile";
        // A value that the profile has anyway is not part of the canonical URL.
        const Response same = handle(service, get(file + "&compress=meshopt&image_format=webp"));
        EXPECT_EQ(header(same, "ETag"), header(web, "ETag"));
        EXPECT_EQ(header(same, "Cache-Status"), "sporeprint; hit");
        const Response plain = handle(service, get(file + "&compress=none&image_format=jpg"));
        EXPECT_EQ(test::text_of(plain).find("extensionsRequired"), std::string::npos);
    }
}

TEST(Profiles, StandInCanonicalUrlsWithWhatDiffersFromThem) {
    Service service(built_in_atlas(), ServiceOptions{});
    for (const std::string base : small) {
        const auto canonical = [&](const std::string& query) {
            return canonical_of(service, base + ".json?" + query);
        };
        EXPECT_EQ(canonical("profile=core"), base + ".glb");
        EXPECT_EQ(canonical("compress=meshopt&profile=web&lod=0"), base + ".glb?profile=web");
        EXPECT_EQ(canonical("profile=web&compress=none"), base + ".glb?profile=web&compress=none");
        EXPECT_EQ(canonical("profile=mobile"), base + ".glb?profile=mobile");
        EXPECT_EQ(canonical("profile=mobile&lod=1"), base + ".glb?profile=mobile");
        EXPECT_EQ(canonical("profile=mobile&lod=0"), base + ".glb?lod=0&profile=mobile");
        for (const char* query : {"profile=mobile&lod=0", "profile=godot&materials=core&lod=2"})
            EXPECT_EQ(canonical(canonical(query).substr(base.size() + 5)), canonical(query))
                << "canonical URLs are canonical";
    }
}

TEST(Profiles, OfABodyAreThoseOfAQuery) {
    Service service(built_in_atlas(), ServiceOptions{});
    const auto posted = [&](const std::string& path, const std::string& body) {
        return std::string(header(handle(service, test::post(body, path)), "ETag"));
    };
    const auto got = [&](const std::string& target) {
        return std::string(header(handle(service, get(target)), "ETag"));
    };
    const std::string rest = R"("profile":"mobile","compress":"none","texture_size":128})",
                      query = ".glb?profile=mobile&compress=none&texture_size=128";
    EXPECT_EQ(posted("/v1/mushrooms.glb", R"({"mix":{"amanita_muscaria":1},)" + rest),
              got("/v1/mushrooms/amanita_muscaria" + query));
    EXPECT_EQ(posted("/v1/colonies.glb", R"({"mix":{"hypholoma_fasciculare":1},)" + rest),
              got("/v1/colonies/hypholoma_fasciculare" + query));
    EXPECT_EQ(posted("/v1/leaves.glb", R"({"preset":"maple",)" + rest),
              got("/v1/leaves/maple" + query));
    EXPECT_EQ(posted("/v1/trees.glb", R"({"preset":"birch",)" + rest),
              got("/v1/trees/birch" + query));
}

TEST(Profiles, RefuseNothingForAnOptionThatIsNotNamed) {
    Service service(built_in_atlas(), ServiceOptions{});
    for (const std::string base : small)
        for (int i = 0; name(static_cast<Profile>(i)); ++i) {
            const std::string profile = name(static_cast<Profile>(i));
            for (const std::string rest :
                 {"", "&compress=quantize", "&compress=meshopt", "&textures=none",
                  "&compress=meshopt&textures=none", "&lods=nodes", "&collision=none&wind=none"})
                canonical_of(service, base + ".json?lod=3&profile=" + profile + rest);
            if (base.find("leaves") == std::string::npos &&
                base.find("mushrooms") == std::string::npos)
                canonical_of(service, base + ".json?lod=3&instancing=gpu&profile=" + profile);
        }
    EXPECT_EQ(canonical_of(service, "/v1/trees/birch.json?profile=godot&textures=none"),
              "/v1/trees/birch.glb?textures=none&profile=godot");
    EXPECT_EQ(canonical_of(service, "/v1/trees/birch.json?profile=godot&compress=quantize"),
              "/v1/trees/birch.glb?profile=godot&compress=quantize");
    EXPECT_EQ(canonical_of(service, "/v1/trees/birch.json?profile=godot&wind=uv&collision=omi"),
              "/v1/trees/birch.glb?profile=godot");
    const Response named =
        handle(service, get("/v1/trees/birch.json?profile=godot&textures=none&wind=uv"));
    EXPECT_EQ(named.status, 422);
    const std::string posted = R"({"species":["boletus_edulis"],"seeds":2,"levels":[3],)";
    for (const char* rest :
         {R"("profile":"godot"})", R"("profile":"godot","compress":"meshopt"})"}) {
        const Response set = handle(service, test::post(posted + rest, "/v1/sets.json"));
        EXPECT_EQ(set.status, 200) << test::text_of(set);
    }
}

TEST(Profiles, ThatAreUnknownAreRefusedByName) {
    Service service(built_in_atlas(), ServiceOptions{});
    for (const std::string base : small) {
        const Response refused = handle(service, get(base + ".glb?profile=webb"));
        EXPECT_EQ(refused.status, 400);
        EXPECT_NE(test::text_of(refused).find("\"parameter\":\"profile\""), std::string::npos);
    }
}

TEST(Profiles, OfPhonesHaveNoOptionalMaterialExtensions) {
    Service service(built_in_atlas(), ServiceOptions{});
    // Water is a clear coat; a glow is emission, whose strength alone is an extension.
    for (const char* id : {"mycena_sanguinolenta", "russula_vinosa", "boletus_edulis"}) {
        const std::string file =
            std::string("/v1/mushrooms/") + id +
            ".glb?lod=3&texture_size=128&weathering.wetness=1&ornaments.glow=0.5";
        const std::string full = test::text_of(handle(service, get(file))),
                          phone = test::text_of(handle(service, get(file + "&profile=mobile")));
        EXPECT_NE(full.find("KHR_materials_clearcoat"), std::string::npos) << id;
        EXPECT_EQ(phone.find("KHR_materials_"), std::string::npos) << id;
        EXPECT_EQ(full.find("emissiveFactor") == std::string::npos,
                  phone.find("emissiveFactor") == std::string::npos)
            << id;
    }
}

}  // namespace
}  // namespace sporeprint::api::products_profiles_test
