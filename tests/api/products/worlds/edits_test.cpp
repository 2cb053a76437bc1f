// Ecologies, founders and masks of worlds over HTTP.

#include "api/products/worlds/edits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/params/types.h"
#include "core/surface/codecs.h"
#include "tests/api/support.h"
#include "tests/support/grey_png.h"

namespace sporeprint::api::products_world_edits_test {
namespace {

using test::header;
using test::json_of;
using test::names;
using test::post;
using test::text_of;

const std::string ring = "marasmius_oreades";

std::string quoted(const std::string& text) { return '"' + text + '"'; }

class WorldEditsTest : public test::RequestedService {
  protected:
    /// Sends a body for the fruit bodies in a square of 128 m of a meadow.
    Response fungi(const std::string& more,
                   const std::string& world =
                       "meadow,seed=7,extent=256,"
                       "fungi.abundance=5",
                   const std::string& time = "y80d270") {
        return ask(post(R"({"world":)" + quoted(world) + R"(,"time":)" + quoted(time) +
                            R"(,"kinds":"fungus","bbox":"-64,-64,64,64")" + more + '}',
                        "/v1/worlds/placements.json"));
    }
    Response masked(const std::string& name, const Bytes& file) {
        return fungi(R"(,"masks":{")" + name + "\":" + quoted(base64_text(file)) + '}');
    }
};

/// Returns a mask whose pixels are black on one half and white on the other.
Bytes half(int side) {
    return grey_png(side, [&](int column, int) { return 2 * column < side ? 0 : 255; });
}

TEST_F(WorldEditsTest, LeaveNothingWhereAMaskIsBlack) {
    const Response all = fungi("");
    ASSERT_EQ(all.status, 200) << text_of(all);
    const Response some = masked("fungi", half(16));
    ASSERT_EQ(some.status, 200) << text_of(some);
    std::size_t east = 0, west = 0;
    const Value everything = json_of(all);
    for (const Value& row : everything.find("placements")->items())
        ++(row.find("translation")->items()[0].as_number() < 0.0 ? west : east);
    ASSERT_GT(west, 0U);
    ASSERT_GT(east, 0U);
    EXPECT_FALSE(json_of(some).find("placements")->items().empty());
    const Value list = json_of(some);
    for (const Value& row : list.find("placements")->items())
        EXPECT_GE(row.find("translation")->items()[0].as_number(), 0.0);
    const Response none = masked("fungi", grey_png(1, [](int, int) { return 0; }));
    EXPECT_TRUE(json_of(none).find("placements")->items().empty());
}

TEST_F(WorldEditsTest, AreOneResourceIfTheirMasksHaveEqualValues) {
    std::vector<std::uint16_t> numbers;
    for (int i = 0; i < 64; ++i)
        numbers.push_back(static_cast<std::uint16_t>(i % 8 < 4 ? 0 : 65535));
    const Response deep = masked(ring, png_of_numbers(numbers, 8, 8, {{"Title", "mask"}})),
                   shallow = masked(ring, half(8));
    ASSERT_EQ(deep.status, 200) << text_of(deep);
    EXPECT_EQ(header(deep, "ETag"), header(shallow, "ETag"));
    EXPECT_NE(header(masked("fungi", half(8)), "ETag"), header(shallow, "ETag"));
    EXPECT_NE(header(masked(ring, half(16)), "ETag"), header(shallow, "ETag"));
}

TEST_F(WorldEditsTest, HaveBodiesInTheMonthsOfTheirOwnEcology) {
    const std::string world = "meadow,seed=7,extent=256,fungi.species=" + ring +
                              ",fungi.abundance=5,climate.rain=1500,climate.temperature=7";
    const std::string april = R"(,"ecology":{")" + ring + R"(":{"months":[4]}})";
    const auto count = [&](const std::string& edits, const char* time) {
        const Response response = fungi(edits, world, time);
        EXPECT_EQ(response.status, 200) << text_of(response);
        return json_of(response).find("placements")->items().size();
    };
    std::size_t usual_in_autumn = 0, own_in_autumn = 0;
    for (const char* time : {"y80d260", "y81d260", "y82d260"}) {
        usual_in_autumn += count("", time);
        own_in_autumn += count(april, time);
    }
    EXPECT_GT(usual_in_autumn, 0U);
    EXPECT_EQ(own_in_autumn, 0U);
}

TEST_F(WorldEditsTest, NameWhatNoWorldHas) {
    const auto refused = [&](const std::string& edits, int status, const char* place,
                             const char* words) {
        const Response response = fungi(',' + edits);
        EXPECT_EQ(response.status, status) << edits << text_of(response);
        EXPECT_TRUE(names(response, place, words)) << edits << text_of(response);
    };
    refused(R"("ecology":[])", 400, "/ecology", "expected an object");
    refused(R"("ecology":{"boletus_edulis":{}})", 422, "/ecology/boletus_edulis",
            "its fungi are coprinus_comatus");
    refused(R"("ecology":{"marasmius_oreades":7})", 400, "/ecology/marasmius_oreades",
            "expected an object");
    refused(R"("ecology":{"marasmius_oreades":{"months":[13]}})", 400,
            "/ecology/marasmius_oreades/months/0", "12");
    refused(R"("ecology":{"marasmius_oreades":{"mouths":[3]}})", 400,
            "/ecology/marasmius_oreades/mouths", "months");
    refused(R"("ecology":{"marasmius_oreades":{"genet":{"rate":1}}})", 400,
            "/ecology/marasmius_oreades/genet/rate", "0.001");
    refused(R"("ecology":{"marasmius_oreades":{"guild":"litter","genet":{"reach":20}}})", 422,
            "/ecology/marasmius_oreades/genet/reach", "8 m");
    refused(R"("ecology":{"marasmius_oreades":{"trees":["brich"]}})", 422,
            "/ecology/marasmius_oreades/trees/0", "brich");
    refused(R"("founders":{})", 400, "/founders", "expected a list");
    refused(R"("founders":[{"x":1}])", 400, "/founders/0/species", "is missing");
    refused(R"("founders":[{"species":"boletus_edulis"}])", 422, "/founders/0/species",
            "does not live");
    refused(R"("founders":[{"species":"marasmius_oreades","x":129}])", 422, "/founders/0/x",
            "from -128 to 128");
    refused(R"("founders":[{"species":"marasmius_oreades","year":201}])", 400, "/founders/0/year",
            "200");
    refused(R"("founders":[{"species":"marasmius_oreades","year":1.5}])", 400, "/founders/0/year",
            "whole number");
    std::string many;
    for (std::size_t i = 0; i <= most_founders; ++i)
        many += std::string(i ? "," : "") + R"({"species":"marasmius_oreades"})";
    refused(R"("founders":[)" + many + ']', 400, "/founders", "256");
    refused(R"("masks":7)", 400, "/masks", "expected an object");
    refused(R"("masks":{"tress":""})", 422, "/masks/tress", "trees");
    refused(R"("masks":{"trees":null})", 400, "/masks/trees", "base64");
    refused(R"("masks":{"trees":"@@@@"})", 400, "/masks/trees", "base64");
    refused(R"("masks":{"trees":""})", 422, "/masks/trees", "not a PNG");
}

TEST_F(WorldEditsTest, RefuseWhatIsNoMask) {
    const auto refused = [&](const Bytes& file, const char* words) {
        const Response response = masked("trees", file);
        EXPECT_EQ(response.status, 422) << text_of(response);
        EXPECT_TRUE(names(response, "/masks/trees", words)) << text_of(response);
    };
    refused(png_file({4, 3, 8, 0}, Bytes(15)), "square");
    refused(png(Bytes(64), 4, 4), "grey");
    refused(png_file({1025, 1025, 8, 0}, Bytes(10)), "1024 x 1024");
    refused(png_file({1000, 1000, 8, 0}, Bytes(10)), "broken");
    Bytes longer = half(8);
    longer.push_back(0);
    refused(longer, "followed by other bytes");
    // Five of a million pixels, each of which is small.
    std::string masks;
    const std::string large =
        quoted(base64_text(grey_png(1024, [](int column, int) { return column / 4; })));
    for (const char* name :
         {"trees", "fungi", "marasmius_oreades", "coprinus_comatus", "hygrocybe_conica"})
        masks += std::string(masks.empty() ? "" : ",") + quoted(name) + ':' + large;
    const Response many = fungi(R"(,"masks":{)" + masks + '}');
    EXPECT_EQ(many.status, 422);
    EXPECT_TRUE(names(many, "/masks/hygrocybe_conica", "pixels together")) << text_of(many);
}

TEST_F(WorldEditsTest, RefuseMoreBodiesThanAWorldHasPlaceFor) {
    // It tolerates all weather, all places and all months.
    std::string dense = R"("fruit":{"density":200,"clusters":10,"tufts":10},"months":[],)"
                        R"("temperature":{"tolerates":[-20,45],"prefers":[-20,45]})";
    for (const char* condition : {"light", "wetness", "acidity"})
        dense += ",\"" + std::string(condition) + R"(":{"tolerates":[0,1],"prefers":[0,1]})";
    const Response response = fungi(R"(,"ecology":{")" + ring + "\":{" + dense + "}}",
                                    "meadow,seed=7,extent=256,fungi.abundance=10");
    EXPECT_EQ(response.status, 422) << text_of(response).substr(0, 200);
    if (response.status == 422) {
        EXPECT_TRUE(names(response, "/world", "fungi.abundance") ||
                    names(response, "/bbox", "things"))
            << text_of(response);
    }
}

}  // namespace
}  // namespace sporeprint::api::products_world_edits_test
