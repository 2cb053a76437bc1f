// POST and GET under /v1/terrains, and worlds that stand on what was sent.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/surface/codecs.h"
#include "core/surface/grey_codec.h"
#include "tests/api/support.h"
#include "tests/support/grey_png.h"

namespace sporeprint::api::products_terrains_test {
namespace {

namespace fs = std::filesystem;

using namespace test;

/// A service that stores in a folder of its own, which is gone with it.
class TerrainRoutes : public testing::Test {
  protected:
    TerrainRoutes() : service_(built_in_atlas(), options()) {}
    ~TerrainRoutes() override { fs::remove_all(folder_); }

    static Response upload(Service& service, const Bytes& file,
                           const std::string& query = "?metres=320&max=50") {
        return handle(service, post(std::string(file.begin(), file.end()), "/v1/terrains" + query,
                                    "image/png"));
    }
    Response upload(const Bytes& file, const std::string& query = "?metres=320&max=50") {
        return upload(service_, file, query);
    }
    Response ask(std::string target, std::vector<Header> headers = {}) {
        return handle(service_, get(std::move(target), std::move(headers)));
    }
    /// Returns the id of the terrain that a response is about.
    static std::string id_in(const Response& response) {
        const Value body = json_of(response);
        const Value* const id = body.find("terrain");
        return id != nullptr ? id->as_string() : text_of(response);
    }
    [[nodiscard]] ServiceOptions options() const {
        ServiceOptions some;
        some.store = folder_;
        return some;
    }
    static fs::path made_folder() {
        std::string name = (fs::temp_directory_path() / "sporeprint-terrain-XXXXXX").string();
        return mkdtemp(name.data());
    }

    fs::path folder_ = made_folder();
    Service service_;
};

/// Returns a PNG file of 16 bits: a hill in the north-east.
Bytes hill(int side = 65) {
    std::vector<std::uint16_t> samples;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const double x = static_cast<double>(column) / (side - 1) - 0.75,
                         y = static_cast<double>(row) / (side - 1) - 0.25;
            samples.push_back(static_cast<std::uint16_t>(
                std::lround(60000.0 * std::exp(-40.0 * (x * x + y * y)))));
        }
    return png_of_numbers(samples, side, side, {});
}

/// Returns the grey values of a response.
GreyValues grey_of(const Response& response) {
    const std::string file = text_of(response);
    return decoded_grey({reinterpret_cast<const std::uint8_t*>(file.data()), file.size()}, 4096,
                        "");
}

TEST_F(TerrainRoutes, GiveAnIdOfTheContentAndTheHeightsBack) {
    const Response response = upload(hill());
    ASSERT_EQ(response.status, 201) << text_of(response);
    const std::string id = id_in(response);
    EXPECT_EQ(header(response, "Location"), "/v1/terrains/" + id + ".json");
    const Value body = json_of(response);
    EXPECT_EQ(body.find("side")->as_number(), 65);
    EXPECT_EQ(body.find("metres")->as_number(), 320);
    EXPECT_EQ(body.find("min")->as_number(), 0);
    EXPECT_EQ(body.find("max")->as_number(), 50);
    EXPECT_NEAR(body.find("highest")->as_number(), 50.0 * 60000 / 65535, 0.05);
    EXPECT_LT(body.find("lowest")->as_number(), 0.001);

    const Response again = upload(hill());
    EXPECT_EQ(again.status, 200);
    EXPECT_EQ(id_in(again), id);
    EXPECT_NE(id_in(upload(hill(), "?metres=321&max=50")), id);
    EXPECT_NE(id_in(upload(hill(), "?metres=320&max=50&min=-1")), id);

    const Response described = ask("/v1/terrains/" + id + ".json");
    EXPECT_EQ(described.status, 200);
    EXPECT_EQ(json_of(described), body);
    const Response image = ask("/v1/terrains/" + id + ".png");
    ASSERT_EQ(image.status, 200) << text_of(image);
    const Bytes sent = hill();
    EXPECT_EQ(grey_of(image).values, decoded_grey(sent, 65, "").values);
    const std::string etag = header(image, "ETag");
    EXPECT_EQ(ask("/v1/terrains/" + id + ".png", {{"If-None-Match", etag}}).status, 304);
    const std::string canonical = header(image, "Content-Location");
    ASSERT_NE(canonical.find("v="), std::string::npos) << canonical;
    EXPECT_NE(header(ask(canonical), "Cache-Control").find("immutable"), std::string::npos);
    expect_problem(ask("/v1/terrains/" + id + ".png?v=1-00000000"), 410);
    expect_problem(ask("/v1/terrains/" + id + ".json?metres=3"), 400);
}

TEST_F(TerrainRoutes, AreTheGroundOfWorlds) {
    const std::string id = id_in(upload(hill()));
    const std::string world = "/v1/worlds/meadow,extent=256,terrain.id=" + id;
    const Response response = ask(world + "/y80d270/maps/height.json?size=65");
    ASSERT_EQ(response.status, 200) << text_of(response);
    EXPECT_NE(header(response, "Content-Location").find("terrain.id=" + id), std::string::npos);
    const Response map = ask(world + "/y80d270/maps/height.png?size=65");
    ASSERT_EQ(map.status, 200);
    const GreyValues grey = grey_of(map);
    // The hill is in the north-east: a quarter from the rim of its 320 m, which is 48 m from that of the world.
    const auto at = [&](int row, int column) {
        return grey.values[static_cast<std::size_t>(row * 65 + column)];
    };
    EXPECT_GT(at(12, 52), at(12, 12) + 20'000);
    EXPECT_GT(at(12, 52), at(52, 52) + 20'000);
    EXPECT_EQ(ask(world + "/y80d270/plot.json?size=2").status, 200);
    EXPECT_EQ(ask(world + ".json").status, 200);
}

TEST_F(TerrainRoutes, ForgetNothingBetweenTwoServicesOfAFolder) {
    const std::string id = id_in(upload(hill()));
    Service other(built_in_atlas(), options());
    EXPECT_EQ(handle(other, get("/v1/terrains/" + id + ".json")).status, 200);
    EXPECT_EQ(handle(other, get("/v1/worlds/birch,terrain.id=" + id + ".json")).status, 200);
}

TEST_F(TerrainRoutes, SayWhenATerrainIsNotThere) {
    const std::string id = "t-0123456789abcdef0123456789abcdef";
    for (const std::string& target : {"/v1/terrains/" + id + ".json", "/v1/terrains/" + id + ".png",
                                      std::string("/v1/terrains/nothing.png")}) {
        const Response response = ask(target);
        expect_problem(response, 404);
        EXPECT_NE(text_of(response).find("upload it"), std::string::npos);
    }
    const Response world = ask("/v1/worlds/birch,terrain.id=" + id + ".json");
    expect_problem(world, 404);
    EXPECT_TRUE(names(world, "terrain.id", "upload it to /v1/terrains again"));
    expect_problem(ask("/v1/worlds/birch,terrain.id=hills.json"), 400);

    // A file that somebody has removed, or damaged.
    const std::string stored = id_in(upload(hill()));
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "terrains"))
        if (entry.is_regular_file()) std::ofstream(entry.path()) << "nothing";
    EXPECT_GE(ask("/v1/worlds/birch,terrain.id=" + stored + "/y80/maps/height.png").status, 400);
    expect_problem(ask("/v1/worlds/birch,terrain.id=" + stored + ".json"), 404);
    EXPECT_EQ(id_in(upload(hill())), stored);
    EXPECT_EQ(ask("/v1/worlds/birch,terrain.id=" + stored + ".json").status, 200);
}

TEST_F(TerrainRoutes, RefuseParametersThatHaveNoMeaningBesideATerrain) {
    const std::string id = id_in(upload(hill()));
    const Response response =
        ask("/v1/worlds/birch,terrain.relief=3,terrain.erosion=0.1,"
            "terrain.micro=0.1,terrain.id=" +
            id + ".json");
    expect_problem(response, 400);
    const Value body = json_of(response);
    EXPECT_TRUE(names(response, "terrain.relief", "no meaning beside terrain.id"));
    EXPECT_TRUE(names(response, "terrain.erosion", "no meaning beside terrain.id"));
    EXPECT_EQ(body.find("errors")->items().size(), 2U) << "micro has one";
}

TEST_F(TerrainRoutes, NameWhatAnImageCannotBe) {
    const auto refused = [&](const Bytes& file, int status, const std::string& parameter,
                             const std::string& words,
                             const std::string& query = "?metres=320&max=50") {
        const Response response = upload(file, query);
        expect_problem(response, status);
        EXPECT_TRUE(names(response, parameter, words)) << text_of(response);
    };
    refused(hill(), 400, "metres", "missing", "?max=50");
    refused(hill(), 400, "max", "missing", "?metres=320");
    refused(hill(), 400, "metres", "", "?metres=3&max=50");
    refused(hill(), 400, "side", "unknown", "?metres=300&max=50&side=3");
    refused(hill(), 422, "max", "not above min", "?metres=320&max=5&min=5");
    refused(hill(), 422, "metres", "steeper than 80 degrees", "?metres=16&max=9000");
    refused({1, 2, 3}, 422, "", "not a PNG file");
    refused(grey_png(65, [](int, int) { return 7; }), 422, "", "8 bits");
    refused(hill(16), 422, "", "at least 17");
    const std::vector<std::uint16_t> numbers(65 * 33, 7);
    refused(png_of_numbers(numbers, 65, 33, {}), 422, "", "square");
    // Its header promises more than a terrain may have, or more than follows.
    refused(png_file({2050, 2050, 16, 0}, Bytes(10)), 422, "", "at most 2049");
    refused(png_file({2049, 2049, 16, 0}, Bytes(10)), 422, "", "broken");
    Bytes longer = hill();
    longer.push_back(0);
    refused(longer, 422, "", "followed by other bytes");
    EXPECT_FALSE(fs::exists(folder_ / "terrains" / "aside" / "0")) << "nothing is left over";
}

TEST_F(TerrainRoutes, NeedAServiceWithAFolder) {
    Service service(built_in_atlas(), ServiceOptions{});
    const Response response = upload(service, hill());
    expect_problem(response, 422);
    EXPECT_NE(text_of(response).find("--store"), std::string::npos);
    const Response world =
        handle(service, get("/v1/worlds/birch,terrain.id=t-0123456789abcdef0123456789abcdef.json"));
    expect_problem(world, 404);
    EXPECT_TRUE(names(world, "terrain.id", "--store"));
}

}  // namespace
}  // namespace sporeprint::api::products_terrains_test
