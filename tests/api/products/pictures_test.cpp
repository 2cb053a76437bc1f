// Pictures over HTTP: files, canonical URLs, links, costs and what is refused.

#include "api/products/pictures.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/surface/codecs.h"
#include "tests/api/support.h"

namespace sporeprint::api::products_pictures_test {
namespace {

using test::expect_problem;
using test::get;
using test::header;
using test::json_of;
using test::names;
using test::text_of;

const std::string agaric = "/v1/mushrooms/amanita_muscaria.png";

/// Returns a target whose picture is drawn fast.
std::string small(const std::string& address, const std::string& more = "") {
    return address + "?lod=3&texture_size=128&width=48&height=32" + more;
}

class PicturesTest : public test::RequestedService {};

Picture decoded(const Response& response) {
    const std::string text = text_of(response);
    return decoded_picture({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "/");
}

TEST_F(PicturesTest, EveryProductHasOneOfTheRequestedSize) {
    for (const std::string& address :
         {agaric, std::string("/v1/mushrooms/amanita_muscaria:0.7,boletus_edulis:0.3.png"),
          std::string("/v1/colonies/hypholoma_fasciculare.png"), std::string("/v1/leaves/oak.png"),
          std::string("/v1/trees/herb.png")}) {
        const Response response = ask(small(address));
        ASSERT_EQ(response.status, 200) << address << text_of(response);
        EXPECT_EQ(header(response, "Content-Type"), "image/png");
        EXPECT_NE(header(response, "Content-Disposition").find("_LOD3.png\""), std::string::npos);
        const Picture picture = decoded(response);
        EXPECT_EQ(picture.width, 48);
        EXPECT_EQ(picture.height, 32);
        EXPECT_EQ(text_of(ask(small(address))), text_of(response));
    }
    const Picture sheet = decoded(ask(small(agaric, "&view=turntable")));
    EXPECT_EQ(sheet.width, 4 * 48);
    EXPECT_EQ(sheet.height, 2 * 32);
}

TEST_F(PicturesTest, CanonicalUrlsNameWhatDiffersOfProductAndPicture) {
    const auto canonical = [&](const std::string& target) {
        const std::string location = header(ask(target), "Content-Location");
        return location.substr(0, location.find("v=") - 1);
    };
    EXPECT_EQ(canonical(agaric + "?height=32&age=0.60&lod=3&width=256&texture_size=128"),
              agaric + "?lod=3&texture_size=128&height=32");
    EXPECT_EQ(canonical(agaric + "?view=three_quarter&turn_deg=-0.0"), agaric);
    const std::string full = small(agaric, "&view=below&turn_deg=12.5&background=grey");
    EXPECT_EQ(canonical(full), full);
    const Response again = ask(full);
    EXPECT_EQ(header(again, "Cache-Status"), "sporeprint; hit");
    EXPECT_EQ(ask(get(full, {{"If-None-Match", header(again, "ETag")}})).status, 304);
}

TEST_F(PicturesTest, ViewsBackgroundsAndAgesAreDifferentPictures) {
    const std::string plain = text_of(ask(small(agaric)));
    EXPECT_EQ(text_of(ask(small("/v1/mushrooms/fomes_fomentarius.png", "&materials=rich"))),
              text_of(ask(small("/v1/mushrooms/fomes_fomentarius.png"))))
        << "opaque";
    EXPECT_NE(text_of(ask(small("/v1/mushrooms/mycena_galericulata.png", "&materials=rich"))),
              text_of(ask(small("/v1/mushrooms/mycena_galericulata.png"))));
    for (const char* more : {"&view=top", "&background=white", "&turn_deg=40", "&age=0.2",
                             "&seed=2", "&textures=none"})
        EXPECT_NE(text_of(ask(small(agaric, more))), plain) << more;
}

TEST_F(PicturesTest, ListsLinkToThem) {
    for (const char* product : {"mushrooms", "colonies", "leaves", "trees", "species"}) {
        const Value list = json_of(ask(std::string("/v1/") + product));
        const Value& first = list.find(product)->items().front();
        const std::string link = first.find("links")->find("image")->as_string();
        EXPECT_EQ(ask(small(link)).status, 200) << link;
    }
}

TEST_F(PicturesTest, OptionsOfFilesAreRefusedByName) {
    for (const char* of_file :
         {"profile=web", "compress=meshopt", "image_format=webp", "lods=msft", "materials=core",
          "variants=weather", "animation=growth", "frames=3"}) {
        const Response response = ask(agaric + '?' + of_file);
        const std::string name = std::string(of_file).substr(0, std::string(of_file).find('='));
        expect_problem(response, 400);
        EXPECT_TRUE(names(response, name, "changes no picture")) << text_of(response);
    }
    expect_problem(ask("/v1/colonies/hypholoma_fasciculare.png?instancing=gpu"), 400);
    expect_problem(ask("/v1/colonies/hypholoma_fasciculare.png?variants=weather"), 400);
    expect_problem(ask(agaric + "?textures=linked"), 422);
}

TEST_F(PicturesTest, BadSizesViewsAndNamesAreRefused) {
    for (const char* wrong : {"width=15", "height=1025", "width=1e9", "view=left", "turn_deg=181",
                              "background=pink", "widht=20", "width=20&width=20"})
        expect_problem(ask(agaric + '?' + wrong), 400);
    expect_problem(ask(agaric + "?width=513&view=turntable"), 422);
    expect_problem(ask("/v1/mushrooms/amanita_muscari.png"), 404);
    const Response many =
        ask("/v1/colonies/hypholoma_fasciculare.png?count=256&distinct=1&textures=none");
    expect_problem(many, 422);
    EXPECT_TRUE(names(many, "lod", "triangles")) << text_of(many);
}

TEST_F(PicturesTest, TheSchemaHasTheProductsParametersWithoutThoseOfFiles) {
    const Value openapi = json_of(ask("/openapi.json"));
    const Value* const operation =
        openapi.find("paths")->find("/v1/mushrooms/{mix}.png")->find("get");
    ASSERT_NE(operation, nullptr);
    std::set<std::string> found;
    for (const Value& parameter : operation->find("parameters")->items())
        if (const Value* name = parameter.find("name")) found.insert(name->as_string());
    for (const char* name : {"age", "seed", "lod", "width", "height", "view", "background"})
        EXPECT_TRUE(found.contains(name)) << name;
    for (const char* name : {"profile", "compress", "frames", "lods"})
        EXPECT_FALSE(found.contains(name)) << name;
    for (const Value& parameter : operation->find("parameters")->items())
        if (const Value* name = parameter.find("name"); name && name->as_string() == "materials") {
            EXPECT_EQ(dump(*parameter.find("schema")->find("enum")), R"(["rich","full"])");
        }
}

TEST_F(PicturesTest, LargerPicturesAndMoreTrianglesCostMore) {
    const auto work = [&](const std::string& target) {
        return std::get<Job>(test::plan(service_, get(target))).cost.work();
    };
    const std::string none = "?textures=none&lod=3";
    const std::uint64_t plain = work(agaric + none);
    EXPECT_GT(work(agaric + none + "&width=1024&height=1024"), 4 * plain);
    EXPECT_GT(work(agaric + none + "&view=turntable"), 4 * plain);
    EXPECT_GT(work(agaric + "?textures=none&lod=0"), 2 * plain);
}

}  // namespace
}  // namespace sporeprint::api::products_pictures_test
