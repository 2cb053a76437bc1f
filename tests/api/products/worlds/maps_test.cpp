// Maps of worlds over HTTP: files, what describes them, times, rectangles, and the job that computes the ground first.

#include "api/products/worlds/maps.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/params/types.h"
#include "core/surface/codecs.h"
#include "core/world/ground.h"
#include "tests/api/support.h"

namespace sporeprint::api::products_world_maps_test {
namespace {

using test::header;
using test::json_of;
using test::names;
using test::text_of;

const std::string world = "/v1/worlds/meadow,seed=5,extent=256";

class WorldMapsTest : public test::RequestedService {
  protected:
    Response response_to(const std::string& map) { return ask(world + "/y0/maps/" + map); }
};

std::vector<std::uint16_t> numbers_of(const std::string& raw) {
    std::vector<std::uint16_t> numbers;
    for (std::size_t i = 0; i + 1 < raw.size(); i += 2)
        numbers.push_back(static_cast<std::uint16_t>(
            static_cast<unsigned char>(raw[i]) + 256U * static_cast<unsigned char>(raw[i + 1])));
    return numbers;
}

TEST_F(WorldMapsTest, AreListedByTheirWorldAndHaveAllTheirFiles) {
    const Value description = json_of(ask(world + ".json"));
    const Value& maps = *description.find("maps");
    EXPECT_EQ(maps.members().size(), map_names(MapFile::json).items().size());
    for (const auto& [name, link] : maps.members()) {
        const Response response = ask(link.as_string() + "?size=64");
        ASSERT_EQ(response.status, 200) << name << text_of(response);
        const Value map = json_of(response);
        EXPECT_EQ(map.find("map")->as_string(), name);
        EXPECT_EQ(map.find("width")->as_number(), 64);
        EXPECT_EQ(map.find("links")->find("r16") == nullptr, name == "terrarium");
        EXPECT_EQ(map.find("formula")->as_string().starts_with("256 R"), name == "terrarium");
        for (const auto& [kind, file] : map.find("links")->members())
            EXPECT_EQ(ask(file.as_string()).status, 200) << file.as_string();
    }
    EXPECT_EQ(generated(), 1 + 17 + 17 + 16U) << "each file once, whatever it was named";
}

TEST_F(WorldMapsTest, OfCrownsAndSporesChangeWithTheYear) {
    for (const char* map : {"canopy", "light", "spores"}) {
        const auto ask_in = [&](const char* time, const char* file) {
            return ask(world + '/' + time + "/maps/" + map + file);
        };
        const Response response = ask_in("y80d200", ".r16?size=64");
        ASSERT_EQ(response.status, 200) << text_of(response);
        EXPECT_NE(header(response, "Content-Location").find("/y80/maps/"), std::string::npos);
        EXPECT_EQ(header(ask_in("y80", ".r16?size=64"), "ETag"), header(response, "ETag"));
        EXPECT_NE(header(ask_in("y0", ".r16?size=64"), "ETag"), header(response, "ETag"));
    }
    const Response hygrocybe = ask(world + "/y80/maps/spores.r16?species=hygrocybe_conica");
    ASSERT_EQ(hygrocybe.status, 200);
    EXPECT_NE(header(hygrocybe, "ETag"), header(ask(world + "/y80/maps/spores.r16"), "ETag"));
    EXPECT_NE(header(hygrocybe, "Content-Disposition").find("meadow_spores_hygrocybe_conica_y80"),
              std::string::npos)
        << header(hygrocybe, "Content-Disposition");
}

TEST_F(WorldMapsTest, HaveSporesOfFungiOfTheWorldAlone) {
    EXPECT_TRUE(names(ask(world + "/y80/maps/spores.png?species=boletus_edulis"), "species",
                      "its fungi are coprinus_comatus"));
    EXPECT_TRUE(names(ask(world + "/y80/maps/light.png?species=marasmius_oreades"), "species",
                      "for the map of spores"));
    EXPECT_TRUE(
        names(ask("/v1/worlds/meadow,fungi.species=/y80/maps/spores.png"), "species", "no fungus"));
}

TEST_F(WorldMapsTest, OfSpeciesHaveAPalette) {
    const std::string place = world + "/y80/maps/species";
    const Value map = json_of(ask(place + ".json?size=65"));
    const Value::Array& palette = map.find("palette")->items();
    ASSERT_EQ(palette.size(), 8U) << "none, and the seven fungi of a meadow";
    EXPECT_EQ(palette[0].find("species")->as_string(), "");
    EXPECT_EQ(palette[1].find("species")->as_string(), "coprinus_comatus");
    const Response response = ask(place + ".png?size=65");
    ASSERT_EQ(response.status, 200) << text_of(response);
    const std::string file = text_of(response);
    EXPECT_NE(file.find("tEXtSpecies 1"), std::string::npos);
    EXPECT_NE(file.find("PLTE"), std::string::npos);
    const Picture picture = decoded_picture(
        std::span(reinterpret_cast<const std::uint8_t*>(file.data()), file.size()), "");
    const auto numbers = numbers_of(text_of(ask(place + ".r16?size=65")));
    ASSERT_EQ(picture.rgb.size(), 3 * numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        ASSERT_LT(numbers[i], palette.size());
        const Colour colour{picture.rgb[3 * i], picture.rgb[3 * i + 1], picture.rgb[3 * i + 2]};
        ASSERT_EQ(palette[numbers[i]].find("colour")->as_string(), colour_text(colour));
    }
    EXPECT_EQ(json_of(ask(world + "/y80/maps/light.json")).find("palette"), nullptr);
}

TEST_F(WorldMapsTest, OfTheCoverChangeWithTheDay) {
    const auto numbers_on = [&](const char* map, const char* day) {
        const Response response = ask(world + "/y80" + day + "/maps/" + map + ".r16?size=64");
        EXPECT_EQ(response.status, 200) << text_of(response);
        return numbers_of(text_of(response));
    };
    const auto sum = [](const std::vector<std::uint16_t>& numbers) {
        double out = 0.0;
        for (const std::uint16_t number : numbers) out += number;
        return out;
    };
    EXPECT_GT(sum(numbers_on("litter", "d340")), sum(numbers_on("litter", "d270")))
        << "leaves have fallen";
    EXPECT_GT(sum(numbers_on("grass", "d270")), 0.3 * 65535 * 64 * 64) << "it is a meadow";
    EXPECT_TRUE(names(ask(world + "/y80/maps/moss.png"), "time", "such as y80d270"));
}

TEST_F(WorldMapsTest, OfProbabilityAreOfOneSpecies) {
    const Response one = ask(world + "/y80/maps/probability.r16?size=64&species=hygrocybe_conica"),
                   first = ask(world + "/y80/maps/probability.r16?size=64");
    ASSERT_EQ(one.status, 200) << text_of(one);
    EXPECT_NE(header(one, "ETag"), header(first, "ETag"));
    EXPECT_NE(header(first, "Content-Location").find("species=coprinus_comatus"),
              std::string::npos);
}

TEST_F(WorldMapsTest, HaveTheHeightsOfTheGroundInMetres) {
    const std::string query = "?size=65&bbox=-64,-32,64,32";
    const Value map = json_of(response_to("height.json" + query));
    const double from = map.find("from")->as_number(), to = map.find("to")->as_number();
    EXPECT_EQ(map.find("unit")->as_string(), "m");
    EXPECT_EQ(map.find("height")->as_number(), 33);
    EXPECT_EQ(map.find("step_m")->items()[0].as_number(), 2);
    const auto numbers = numbers_of(text_of(response_to("height.r16" + query)));
    ASSERT_EQ(numbers.size(), 65U * 33U);
    WorldParams params = params_of(*built_in_atlas()->find_world("meadow"));
    params.seed = 5;
    params.extent.value = 256;
    const Ground ground = ground_of(params);
    for (int row = 0; row < 33; row += 8)
        for (int column = 0; column < 65; column += 16) {
            const double stored =
                from + (to - from) / 65535.0 * numbers[static_cast<std::size_t>(row * 65 + column)];
            EXPECT_NEAR(stored,
                        place_at(ground, coordinate_at(ground.grid, -64.0 + 2.0 * column),
                                 coordinate_at(ground.grid, 32.0 - 2.0 * row))
                            .height,
                        (to - from) / 131000.0);
        }
}

TEST_F(WorldMapsTest, SayInTheFileWhatTheirNumbersMean) {
    const std::string png = text_of(response_to("height.png?size=64"));
    EXPECT_EQ(png.substr(1, 3), "PNG");
    for (const char* text : {"tEXtFrom", "tEXtTo", "tEXtUnit", "tEXtBounding box", "meadow,seed=5"})
        EXPECT_NE(png.find(text), std::string::npos) << text;
    const std::string coloured = text_of(response_to("terrarium.png?size=64"));
    EXPECT_NE(coloured.find("256 R + G + B / 256 - 32768"), std::string::npos);
    EXPECT_EQ(header(response_to("height.png?size=64"), "Content-Type"), "image/png");
    EXPECT_EQ(header(response_to("height.r16?size=64"), "Content-Type"),
              "application/octet-stream");
}

TEST_F(WorldMapsTest, AreKeyedByNoMoreTimeThanTheyNeed) {
    const Response first = ask(world + "/y80d270/maps/slope.png?size=64");
    EXPECT_NE(header(first, "Content-Location").find("/y0/maps/slope.png?size=64"),
              std::string::npos);
    const Response other = ask(world + "/y3/maps/slope.png?size=64");
    EXPECT_EQ(header(other, "ETag"), header(first, "ETag"));
    EXPECT_EQ(header(other, "Cache-Status"), "sporeprint; hit");

    const Response june = ask(world + "/y80d160/maps/wetness.r16?size=64"),
                   january = ask(world + "/y80d10/maps/wetness.r16?size=64");
    EXPECT_NE(header(june, "ETag"), header(january, "ETag"));
    const auto dry = numbers_of(text_of(june)), wet = numbers_of(text_of(january));
    std::size_t wetter = 0;
    for (std::size_t i = 0; i < dry.size(); ++i) wetter += dry[i] < wet[i] ? 1 : 0;
    EXPECT_GT(wetter, dry.size() / 2) << "winter is wetter";
    EXPECT_TRUE(names(ask(world + "/y80/maps/wetness.png"), "time", "such as y80d270"));
}

TEST_F(WorldMapsTest, HaveOneAddressForEqualRectangles) {
    const auto canonical = [&](const std::string& query) {
        return header(response_to("twi.png" + query), "Content-Location");
    };
    const std::string whole = canonical("");
    EXPECT_EQ(canonical("?size=512&bbox=-128,-128,128,128"), whole);
    EXPECT_EQ(canonical("?bbox=-1.28e2,-128,128.0,128"), whole);
    const std::string part = canonical("?bbox=-0,1.50,20,30&size=64");
    EXPECT_TRUE(part.ends_with("twi.png?size=64&bbox=0,1.5,20,30") ||
                part.ends_with("twi.png?size=64&bbox=0%2C1.5%2C20%2C30"))
        << part;
    EXPECT_EQ(header(ask(part), "Content-Location"), part);
}

TEST_F(WorldMapsTest, ComputeTheGroundOnceAndWaitForItWithoutAJobOfTheirOwn) {
    const Request one = test::get(world + "/y0/maps/height.png?size=64"),
                  two = test::get(world + "/y0/maps/twi.r16?size=64");
    Plan first = test::plan(service_, one), second = test::plan(service_, two);
    ASSERT_TRUE(std::holds_alternative<Job>(first));
    Job& ground = std::get<Job>(first);
    EXPECT_TRUE(ground.is_warm_up);
    EXPECT_EQ(ground.key, std::get<Job>(second).key) << "both wait for the same job";
    EXPECT_GE(ground.cost.work(), 100'000U);
    static_cast<void>(ground.run(
        {}, [](Step) {}, in_turn));
    for (const Request& request : {one, two}) {
        Plan again = test::plan(service_, request, true);
        EXPECT_FALSE(std::get<Job>(again).is_warm_up);
        const Response response = std::get<Job>(test::plan(service_, request))
                                      .run(
                                          {}, [](Step) {}, in_turn);
        EXPECT_TRUE(header(response, "Cache-Status").starts_with("sporeprint-worlds; hit"));
    }
    EXPECT_EQ(service_.counters().ground_misses, 1U);
    EXPECT_EQ(service_.counters().ground_hits, 2U);
    EXPECT_EQ(service_.counters().world_cache_entries, 1U);
    EXPECT_GT(service_.counters().world_cache_bytes, 1'000'000U);
}

TEST_F(WorldMapsTest, NeedNoGroundForHeadersAndConditions) {
    const std::string target = world + "/y0/maps/height.png?size=64";
    const Plan head = test::plan(service_, test::request("HEAD", target));
    ASSERT_TRUE(std::holds_alternative<Response>(head));
    const std::string etag = header(std::get<Response>(head), "ETag");
    const Plan known = test::plan(service_, test::get(target, {{"If-None-Match", etag}}));
    ASSERT_TRUE(std::holds_alternative<Response>(known));
    EXPECT_EQ(std::get<Response>(known).status, 304);
    EXPECT_EQ(service_.counters().ground_misses, 0U);
}

TEST_F(WorldMapsTest, ReportAllThatIsWrong) {
    const Response wrong = ask(world + "/y201d366/maps/hight.png?size=63&bbox=1,2,3");
    test::expect_problem(wrong, 404);
    EXPECT_TRUE(names(wrong, "map", "did you mean 'height'?"));
    EXPECT_TRUE(names(wrong, "time", "from y0 to y200"));
    EXPECT_TRUE(names(wrong, "size", "63"));
    EXPECT_TRUE(names(wrong, "bbox", "not four numbers"));
    for (const char* time :
         {"80", "y", "y80d", "y80d0", "y080", "y-1", "d3", "y80d270x", "y8 0", "y99999999999"})
        EXPECT_TRUE(names(ask(world + '/' + std::string(time) + "/maps/height.png"), "time"))
            << time;
    for (const char* box : {"1,2,3,4,5", "a,b,c,d", "1;2;3;4", "nan,0,1,1", ",,,", "0,0,1"})
        EXPECT_TRUE(names(response_to("height.png?bbox=" + std::string(box)), "bbox",
                          "is not four numbers"))
            << box;
    EXPECT_TRUE(names(response_to("height.png?bbox=10,0,0,10"), "bbox", "the order is west"));
    EXPECT_TRUE(names(response_to("height.png?bbox=0,0,0.5,10"), "bbox", "less than a metre"));
    EXPECT_TRUE(names(response_to("height.png?bbox=-129,0,0,10"), "bbox",
                      "outside the world, which is -128,-128,128,128"));
    EXPECT_TRUE(names(response_to("terrarium.r16"), "map", ".r16"));
    EXPECT_TRUE(names(ask("/v1/worlds/meadow,extent=300/y0/maps/height.png"), "extent", "256"));
    EXPECT_EQ(service_.counters().ground_misses, 0U) << "nothing was computed for them";
}

}  // namespace
}  // namespace sporeprint::api::products_world_maps_test
