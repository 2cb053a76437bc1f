#include "api/products/sets.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>

#include "tests/api/support.h"

namespace sporeprint::api::products_sets_test {
namespace {

using test::header;
using test::json_of;
using test::post;
using test::text_of;

class Sets : public ::testing::Test {
  protected:
    Service service_{built_in_atlas(), ServiceOptions{}};

    Response planned(const std::string& body) {
        return handle(service_, post(body, "/v1/sets.json"));
    }
    /// Returns the text of a problem response, after its status.
    std::string refused(const std::string& body, const char* ending = "json") {
        const Response response = handle(service_, post(body, std::string("/v1/sets.") + ending));
        return std::to_string(response.status) + ' ' + text_of(response);
    }
};

constexpr const char* two_species =
    R"({"species":["amanita_muscaria","amanita_muscaria:0.7,boletus_edulis:0.3"],"ages":[0.3,0.6],
        "seeds":2,"levels":[2,3],"texture_size":128,"profile":"web"})";

TEST_F(Sets, ManifestsListFilesThatAreServed) {
    const Response response = planned(two_species);
    ASSERT_EQ(response.status, 200) << text_of(response);
    const Value manifest = json_of(response);
    const auto& files = manifest.find("files")->items();
    ASSERT_EQ(files.size(), 16U);
    EXPECT_EQ(manifest.find("individuals")->items().size(), 8U);
    std::set<std::string> names, urls;
    double bytes = 0.0;
    for (const Value& file : files) {
        names.insert(file.find("name")->as_string());
        const std::string url = file.find("url")->as_string();
        urls.insert(url);
        const Response glb = handle(service_, test::get(url));
        ASSERT_EQ(glb.status, 200) << url << text_of(glb);
        EXPECT_EQ(header(glb, "Cache-Control"), "public, max-age=31536000, immutable");
        EXPECT_EQ(header(glb, "Content-Location"), url) << "URLs are canonical";
        const auto size = static_cast<double>(size_of(glb.body));
        EXPECT_NEAR(file.find("bytes")->as_number() / size, 1.0, 0.5) << url;
        bytes += file.find("bytes")->as_number();
    }
    EXPECT_EQ(names.size(), 16U);
    EXPECT_EQ(urls.size(), 16U);
    EXPECT_EQ(manifest.at_pointer("/totals/files")->as_number(), 16.0);
    EXPECT_EQ(manifest.at_pointer("/totals/bytes")->as_number(), bytes);
    EXPECT_EQ(header(planned(two_species), "Cache-Status"), "sporeprint; hit");
}

TEST_F(Sets, ArchivesContainTheFilesThatTheManifestNames) {
    const Response response = handle(service_, post(two_species, "/v1/sets.zip"));
    ASSERT_EQ(response.status, 200) << text_of(response);
    EXPECT_EQ(header(response, "Content-Type"), "application/zip");
    EXPECT_EQ(header(response, "Content-Disposition"), "inline; filename=\"mushrooms.zip\"");
    const std::string archive = text_of(response);
    const Value manifest = json_of(planned(two_species));
    for (const Value& file : manifest.find("files")->items()) {
        EXPECT_NE(archive.find(file.find("name")->as_string()), std::string::npos);
        const std::string url = file.find("url")->as_string();
        EXPECT_NE(archive.find(text_of(handle(service_, test::get(url)))), std::string::npos)
            << "the same bytes as " << url;
    }
    EXPECT_NE(archive.find("manifest.json"), std::string::npos);
}

TEST_F(Sets, BudgetsChooseSeedsAndImages) {
    const Value manifest = json_of(planned(
        R"({"species":["amanita_muscaria","boletus_edulis"],"seeds":16,"levels":[1,2,3],
            "individuals":300,"draw_calls":40,"megabytes":1.5,"profile":"web"})"));
    EXPECT_LE(manifest.at_pointer("/totals/draw_calls")->as_number(), 40.0);
    EXPECT_LE(manifest.at_pointer("/totals/bytes")->as_number(), 1.5e6);
    EXPECT_EQ(manifest.at_pointer("/totals/shown")->as_number(), 300.0);
    EXPECT_GE(manifest.find("seeds")->as_number(), 1.0);
}

TEST_F(Sets, LinkedImagesAreListed) {
    const Value manifest = json_of(planned(
        R"({"species":["amanita_muscaria"],"levels":[3],"textures":"linked","texture_size":128})"));
    const auto& images = manifest.at_pointer("/files/0/images")->items();
    ASSERT_EQ(images.size(), 3U);
    EXPECT_EQ(handle(service_, test::get(images[0].as_string())).status, 200);
}

TEST_F(Sets, ErrorsNameWhatIsWrong) {
    EXPECT_NE(refused("{}").find("\"/species\",\"detail\":\"is missing"), std::string::npos);
    EXPECT_NE(refused(R"({"species":["amanita_muscara"]})").find("404"), std::string::npos);
    EXPECT_NE(refused(R"({"species":["amanita_muscara"]})").find("\"/species/0\""),
              std::string::npos);
    EXPECT_NE(refused(R"({"species":[7]})").find("400"), std::string::npos);
    const std::string own = R"({"species":["amanita_muscaria"],)";
    EXPECT_NE(refused(own + R"("seed":3})").find("first_seed and seeds"), std::string::npos);
    EXPECT_NE(refused(own + R"("age":0.3})").find("give ages"), std::string::npos);
    EXPECT_NE(refused(own + R"("ages":[0.3,0.3]})").find("\"/ages/1\""), std::string::npos);
    EXPECT_NE(refused(own + R"("ages":[1.3]})").find("\"/ages/0\""), std::string::npos);
    EXPECT_NE(refused(own + R"("sizes":2})").find("\"/sizes\""), std::string::npos);
    EXPECT_NE(refused(own + R"("draw_calls":3})").find("422"), std::string::npos);
    EXPECT_NE(refused(own + R"("megabytes":0.0001})").find("422"), std::string::npos);
    EXPECT_NE(refused(own + R"("weathering":{"cracks":2}})").find("\"/weathering/cracks\""),
              std::string::npos);
    EXPECT_NE(refused(R"({"species":["amanita_muscaria","amanita_muscaria:3"]})")
                  .find("given more than once"),
              std::string::npos);
    EXPECT_NE(refused(own + R"("textures":"linked"})", "zip").find("422"), std::string::npos);
}

TEST_F(Sets, OneFileHasAllIndividuals) {
    const std::string body =
        R"({"species":["amanita_muscaria","boletus_edulis"],"seeds":2,"levels":[3,2],"lods":"msft",
            "texture_size":128,"share":"species","profile":"web","wind":"uv")";
    const Response response = handle(service_, post(body + "}", "/v1/sets.glb"));
    ASSERT_EQ(response.status, 200) << text_of(response);
    EXPECT_EQ(header(response, "Content-Type"), "model/gltf-binary");
    EXPECT_EQ(header(response, "Content-Disposition"), "inline; filename=\"mushrooms.glb\"");
    const std::string file = text_of(response);
    for (const char* part : {"amanita_muscaria_s1_a60", "boletus_edulis_s2_a60", "_LOD2", "_LOD3",
                             R"("individuals":[)", R"("shown":1)", R"("wind":{)"})
        EXPECT_NE(file.find(part), std::string::npos) << part;
    EXPECT_EQ(text_of(handle(service_, post(body + "}", "/v1/sets.glb"))), file);
    const std::string linked =
        text_of(handle(service_, post(body + R"(,"textures":"linked"})", "/v1/sets.glb")));
    EXPECT_NE(linked.find(R"("uri":"mushrooms/amanita_muscaria/base_color.webp?)"),
              std::string::npos);
    const std::size_t at = linked.find("mushrooms/amanita_muscaria/base_color");
    EXPECT_EQ(
        handle(service_, test::get("/v1/" + linked.substr(at, linked.find('"', at) - at))).status,
        200);

    const std::string own = R"({"species":["amanita_muscaria"],)";
    EXPECT_NE(refused(own + R"("levels":[2,3]})", "glb").find("\"/lods\""), std::string::npos);
    EXPECT_NE(refused(own + R"("levels":[3],"animation":"growth"})", "glb").find("\"/animation\""),
              std::string::npos);
    EXPECT_NE(refused(own + R"("levels":[0],"seeds":64})", "glb").find("422"), std::string::npos);
}

TEST_F(Sets, AnAtlasIsOneMaterialOfOneFile) {
    const std::string body =
        R"({"species":["amanita_muscaria","boletus_edulis"],"ages":[0.3,0.6],"levels":[3],
            "texture_size":128,"share":"species")";
    const auto materials = [&](const char* atlas) {
        const Response response =
            handle(service_, post(body + R"(,"atlas":")" + atlas + "\"}", "/v1/sets.glb"));
        EXPECT_EQ(response.status, 200) << text_of(response);
        const std::string file = text_of(response);
        std::size_t count = 0;
        for (std::size_t at = 0; (at = file.find("\"normalTexture\"", at)) != std::string::npos;
             ++at)
            ++count;
        return count;
    };
    EXPECT_EQ(materials("none"), 4U);
    EXPECT_EQ(materials("species"), 2U);
    EXPECT_EQ(materials("set"), 1U);
    for (const char* ending : {"json", "zip"}) {
        const std::string problem = refused(body + R"(,"atlas":"set"})", ending);
        EXPECT_NE(problem.find("422"), std::string::npos);
        EXPECT_NE(problem.find("\"/atlas\""), std::string::npos);
    }
    const std::string linked = refused(body + R"(,"atlas":"set","textures":"linked"})", "glb");
    EXPECT_NE(linked.find("\"/atlas\""), std::string::npos);
    const std::string many = refused(
        R"({"species":["amanita_muscaria"],"levels":[3],"seeds":17,"atlas":"species"})", "glb");
    EXPECT_NE(many.find("422"), std::string::npos);
    EXPECT_NE(many.find("17 different images"), std::string::npos);
    EXPECT_NE(refused(body + R"(,"atlas":"sett"})", "glb").find("400"), std::string::npos);
}

TEST_F(Sets, LargeOnesAreRefusedBeforeAnyWork) {
    std::string species;
    const std::shared_ptr<const Atlas> atlas = built_in_atlas();
    for (const AtlasEntry& entry : atlas->entries())
        (species += species.empty() ? "\"" : ",\"") += entry.species.id.string() + '"';
    const std::string body = R"({"species":[)" + species + R"(],"seeds":64})";
    EXPECT_NE(refused(body).find("422"), std::string::npos);
    EXPECT_NE(refused(R"({"species":[)" + species + R"(],"levels":[0],"seeds":4})", "zip")
                  .find("\"/megabytes\""),
              std::string::npos);
    EXPECT_EQ(service_.counters().generated, 0U);
}

}  // namespace
}  // namespace sporeprint::api::products_sets_test
