// POST and GET under /v1/scenes.
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/gltf/inspect.h"
#include "tests/api/support.h"
#include "tests/support/scene_glb.h"

namespace sporeprint::api::products_scenes_test {
namespace {

namespace fs = std::filesystem;

using namespace test;

/// A service that stores in a folder of its own, which is gone with it.
class SceneRoutes : public testing::Test {
  protected:
    SceneRoutes() : service_(built_in_atlas(), options()) {}
    ~SceneRoutes() override { fs::remove_all(folder_); }

    static Response upload(Service& service, const Bytes& file, const std::string& query = "") {
        return handle(service, post(std::string(file.begin(), file.end()), "/v1/scenes" + query,
                                    "model/gltf-binary"));
    }
    Response upload(const Bytes& file) { return upload(service_, file); }
    Response ask(std::string target, std::vector<Header> headers = {}) {
        return handle(service_, get(std::move(target), std::move(headers)));
    }
    static std::string id_in(const Response& response) {
        const Value body = json_of(response);
        const Value* const id = body.find("scene");
        return id != nullptr ? id->as_string() : text_of(response);
    }
    [[nodiscard]] ServiceOptions options() const {
        ServiceOptions some;
        some.store = folder_;
        return some;
    }
    static fs::path made_folder() {
        std::string name = (fs::temp_directory_path() / "sporeprint-scene-XXXXXX").string();
        return mkdtemp(name.data());
    }

    fs::path folder_ = made_folder();
    Service service_;
};

/// Returns the file of a lawn with a log.
Bytes lawn() {
    return scenes::glb_of(scenes::Made()
                              .floor(-1.5F, -1.5F, 1.5F, 1.5F, 0, "Lawn")
                              .box({-1, -0.05F, 0.2F}, {1, 0.35F, 0.6F}, "Beech log")
                              .scene);
}

const std::string world =
    "meadow,fungi.species=fomes_fomentarius+marasmius_oreades,fungi.abundance=4,climate.rain=1100";

TEST_F(SceneRoutes, GiveAnIdOfTheContent) {
    const Response response = upload(lawn());
    ASSERT_EQ(response.status, 201) << text_of(response);
    const std::string id = id_in(response);
    EXPECT_EQ(header(response, "Location"), "/v1/scenes/" + id + ".json");
    const Value body = json_of(response);
    EXPECT_EQ(body.find("triangles")->as_number(), 14);
    EXPECT_EQ(body.find("bounds_m")->find("min")->items()[0].as_number(), -1.5);
    const Value& materials = *body.find("materials");
    ASSERT_EQ(materials.items().size(), 2U);
    EXPECT_EQ(materials.items()[0].find("substrate")->as_string(), "grass");
    EXPECT_EQ(materials.items()[1].find("substrate")->as_string(), "wood");
    EXPECT_EQ(materials.items()[1].find("trees")->items()[0].as_string(), "broadleaf");
    const Response again = upload(lawn());
    EXPECT_EQ(again.status, 200);
    EXPECT_EQ(id_in(again), id);
    const Response described = ask("/v1/scenes/" + id + ".json");
    EXPECT_EQ(described.status, 200);
    EXPECT_EQ(json_of(described), body);
    const std::string etag = header(described, "ETag");
    EXPECT_EQ(ask("/v1/scenes/" + id + ".json", {{"If-None-Match", etag}}).status, 304);
    expect_problem(ask("/v1/scenes/" + id + ".json?v=1-00000000"), 410);
    expect_problem(ask("/v1/scenes/" + id + ".json?lod=1"), 400);
    Service other(built_in_atlas(), options());
    EXPECT_EQ(handle(other, get("/v1/scenes/" + id + ".json")).status, 200);
}

TEST_F(SceneRoutes, LetFungiGrow) {
    const std::string base = "/v1/scenes/" + id_in(upload(lawn())) + '/' + world;
    // One of some days has bodies of both.
    std::size_t most = 0;
    std::string best = "/y60d270/";
    for (const char* const time : {"/y60d270/", "/y64d280/", "/y75d262/", "/y90d275/"}) {
        const Response list = ask(base + time + "placements.json");
        ASSERT_EQ(list.status, 200) << text_of(list);
        const auto count = static_cast<std::size_t>(json_of(list).find("count")->as_number());
        if (count <= most) continue;
        most = count;
        best = time;
    }
    ASSERT_GT(most, 0U);
    const Value list = json_of(ask(base + best + "placements.json"));
    const Value& first = list.find("placements")->items()[0];
    EXPECT_EQ(first.find("kind")->as_string(), "fungus");
    EXPECT_NE(first.find("model")->as_string().find("/v1/mushrooms/"), std::string::npos);
    const Response csv = ask(base + best + "placements.csv");
    ASSERT_EQ(csv.status, 200);
    EXPECT_EQ(header(csv, "Content-Type"), "text/csv");
    EXPECT_NE(text_of(csv).find(first.find("id")->as_string()), std::string::npos);
    const std::string bin = text_of(ask(base + best + "placements.bin"));
    EXPECT_EQ(bin.substr(0, 4), "SPPL");
    std::uint32_t rows = 0;
    std::memcpy(&rows, bin.data() + 8, 4);
    EXPECT_EQ(rows, most);

    const Response file = ask(base + best + "fungi.glb?textures=none&lod=2");
    ASSERT_EQ(file.status, 200) << text_of(file);
    EXPECT_EQ(header(file, "Content-Type"), "model/gltf-binary");
    const std::string glb = text_of(file);
    std::vector<Problem> problems;
    const Value document =
        parse(json_chunk(std::span<const std::uint8_t>(
                  reinterpret_cast<const std::uint8_t*>(glb.data()), glb.size())),
              problems);
    EXPECT_EQ(document.find("nodes")->items().size(), most);
    EXPECT_EQ(document.find("asset")->find("extras")->find("bodies")->items().size(), most);

    const Response grass = ask(base + best + "placements.json?species=marasmius_oreades");
    ASSERT_EQ(grass.status, 200);
    EXPECT_LE(json_of(grass).find("count")->as_number(), static_cast<double>(most));
    const Response none =
        ask(base + best + "placements.json?substrates=Lawn:none,Beech%20log:none");
    ASSERT_EQ(none.status, 200) << text_of(none);
    EXPECT_EQ(json_of(none).find("count")->as_number(), 0);
}

TEST_F(SceneRoutes, HaveOneCanonicalAddress) {
    const std::string id = id_in(upload(lawn()));
    const Response response =
        ask("/v1/scenes/" + id + "/" + world +
            ",terrain.relief=10,stand.density=0.3,extent=256/y60d270/placements.csv?decay=0.30");
    ASSERT_EQ(response.status, 200) << text_of(response);
    const std::string canonical = header(response, "Content-Location");
    EXPECT_EQ(canonical.find("relief"), std::string::npos) << "the ground of the world is not used";
    EXPECT_EQ(canonical.find("density"), std::string::npos);
    EXPECT_EQ(canonical.find("extent"), std::string::npos);
    EXPECT_EQ(canonical.find("decay"), std::string::npos);
    ASSERT_EQ(canonical.find("/v1/scenes/" + id + "/meadow,"), 0U) << canonical;
    const Response there = ask(canonical);
    EXPECT_EQ(there.status, 200);
    EXPECT_EQ(header(there, "ETag"), header(response, "ETag"));
    EXPECT_NE(header(there, "Cache-Control").find("immutable"), std::string::npos);
    EXPECT_EQ(ask(canonical, {{"If-None-Match", header(there, "ETag")}}).status, 304);
}

TEST_F(SceneRoutes, GiveMapsForVerticesAndSurfels) {
    const std::string base = "/v1/scenes/" + id_in(upload(lawn())) + '/' + world + "/y60d270/maps/";
    for (const char* const map : {"sky", "light", "rain", "water", "wetness",
                                  "spores:marasmius_oreades", "probability:fomes_fomentarius"}) {
        const Response about = ask(base + map + ".json");
        ASSERT_EQ(about.status, 200) << text_of(about);
        const Value body = json_of(about);
        EXPECT_EQ(body.find("count")->as_number(), 42) << "three for each triangle";
        EXPECT_LE(body.find("least")->as_number(), body.find("mean")->as_number());
        EXPECT_LE(body.find("mean")->as_number(), body.find("most")->as_number());
        EXPECT_EQ(text_of(ask(base + map + ".bin")).size(), 4U * 42U);
        const double surfels = body.find("surfels")->as_number();
        EXPECT_EQ(text_of(ask(base + map + ".bin?points=surfels")).size(),
                  static_cast<std::size_t>(16.0 * surfels));
    }
    for (const char* const map :
         {"gold", "spores", "light:marasmius_oreades", "spores:boletus_edulis", "probability:"})
        expect_problem(ask(base + map + ".bin"), 404);
}

TEST_F(SceneRoutes, NameWhatIsWrongInARequest) {
    const std::string id = id_in(upload(lawn()));
    const std::string base = "/v1/scenes/" + id + "/meadow/";
    expect_problem(ask(base + "y80/fungi.glb"), 400);
    expect_problem(ask(base + "y300d1/fungi.glb"), 400);
    expect_problem(ask(base + "y80d270/fungi.glb?lod=3"), 400);
    expect_problem(ask(base + "y80d270/fungi.glb?decay=2"), 400);
    expect_problem(ask(base + "y80d270/fungi.glb?substrates=Lawn"), 400);
    expect_problem(ask(base + "y80d270/fungi.glb?substrates=Lawn:plastic"), 400);
    expect_problem(ask(base + "y80d270/placements.csv?species=nothing_at_all"), 422);
    expect_problem(ask("/v1/scenes/" + id + "/medow/y80d270/fungi.glb"), 404);
    const std::string unknown = "s-0123456789abcdef0123456789abcdef";
    for (const std::string& target :
         {"/v1/scenes/" + unknown + ".json", "/v1/scenes/" + unknown + "/meadow/y80d270/fungi.glb",
          std::string("/v1/scenes/nothing.json")}) {
        const Response response = ask(target);
        expect_problem(response, 404);
        EXPECT_NE(text_of(response).find("upload it"), std::string::npos);
    }
    const Response material = ask(base + "y80d270/fungi.glb?substrates=Rock:none");
    EXPECT_GE(material.status, 400);
    EXPECT_LT(material.status, 500);
    EXPECT_NE(text_of(material).find("no material"), std::string::npos) << text_of(material);
}

TEST_F(SceneRoutes, RefuseWhatIsNoScene) {
    expect_problem(upload({}), 422);
    expect_problem(upload(Bytes(100, 7)), 422);
    Bytes cut = lawn();
    cut.resize(cut.size() / 2);
    expect_problem(upload(cut), 422);
    const Response large =
        upload(scenes::glb_of(scenes::Made().floor(-40, -40, 40, 40, 0, "soil").scene));
    expect_problem(large, 422);
    EXPECT_NE(text_of(large).find("80 m long"), std::string::npos) << text_of(large);
    expect_problem(upload(service_, lawn(), "?metres=3"), 400);
    expect_problem(handle(service_, post("{}", "/v1/scenes", "application/json")), 415);
    Service bare(built_in_atlas(), {});
    const Response nowhere = upload(bare, lawn());
    expect_problem(nowhere, 422);
    EXPECT_NE(text_of(nowhere).find("--store"), std::string::npos);
}

}  // namespace
}  // namespace sporeprint::api::products_scenes_test
