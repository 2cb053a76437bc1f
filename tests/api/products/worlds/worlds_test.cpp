// Worlds over HTTP: the text that names one, its description, its weather, and errors.

#include "api/products/worlds/worlds.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/api/support.h"

namespace sporeprint::api::products_worlds_test {
namespace {

using test::header;
using test::json_of;
using test::names;
using test::text_of;

class WorldsTest : public test::RequestedService {
  protected:
    /// Returns the path of a world with the current version token, from its Content-Location.
    std::string canonical(const std::string& target) {
        const Response response = ask(target);
        EXPECT_EQ(response.status, 200) << target << '\n' << text_of(response);
        return header(response, "Content-Location");
    }
};

TEST_F(WorldsTest, AreListedWithTheirLinks) {
    const Value list = json_of(ask("/v1/worlds"));
    const auto& worlds = list.find("worlds")->items();
    EXPECT_EQ(worlds.size(), built_in_atlas()->worlds().size());
    for (const Value& world : worlds)
        for (const auto& [name, link] : world.find("links")->members())
            // A plot takes a second of each world; others are tested by themselves.
            if (name != "plot" || &world == &worlds.front()) {
                EXPECT_EQ(ask(link.as_string()).status, 200) << name;
            }
}

TEST_F(WorldsTest, HaveOneTextForEqualParameters) {
    const std::string token = json_of(ask("/v1/worlds/beech.json")).find("v")->as_string();
    EXPECT_EQ(canonical("/v1/worlds/beech.json"), "/v1/worlds/beech,v=" + token + ".json");
    EXPECT_EQ(canonical("/v1/worlds/beech,climate.rain=600,seed=7.json"),
              "/v1/worlds/beech,seed=7,climate.rain=600,v=" + token + ".json");
    // What the preset has, a number written otherwise, and escapes of commas.
    EXPECT_EQ(canonical("/v1/worlds/beech,climate.latitude_deg=51,seed=7%2Cclimate.rain=6e2.json"),
              "/v1/worlds/beech,seed=7,climate.rain=600,v=" + token + ".json");
    EXPECT_EQ(canonical("/v1/worlds/beech,climate.temperature=-0/weather.json?year=3"),
              "/v1/worlds/beech,climate.temperature=0,v=" + token + "/weather.json?year=3");
    EXPECT_EQ(canonical("/v1/worlds/beech/weather.json?year=0"),
              "/v1/worlds/beech,v=" + token + "/weather.json");
}

TEST_F(WorldsTest, AreImmutableWithTheTokenOfToday) {
    const std::string address = canonical("/v1/worlds/spruce,seed=3/weather.json?year=12");
    const Response first = ask(address);
    EXPECT_EQ(header(first, "Cache-Status"), "sporeprint; hit");
    EXPECT_NE(header(first, "Cache-Control").find("immutable"), std::string::npos);
    EXPECT_EQ(ask(address, {{"If-None-Match", header(first, "ETag")}}).status, 304);
    EXPECT_EQ(header(ask("/v1/worlds/spruce/weather.json"), "Cache-Control").find("immutable"),
              std::string::npos);
    const Response gone = ask("/v1/worlds/spruce,seed=3,v=1-00000000/weather.json?year=12");
    test::expect_problem(gone, 410);
    EXPECT_TRUE(names(gone, "v", "is no longer made"));
    EXPECT_EQ(json_of(gone).find("canonical")->as_string(), address);
}

TEST_F(WorldsTest, AreDescribedWithEffectiveParameters) {
    const Value world = json_of(ask("/v1/worlds/meadow,seed=9.json"));
    EXPECT_EQ(world.find("canonical")->as_string(), "/v1/worlds/meadow,seed=9.json");
    EXPECT_EQ(world.find("preset")->as_string(), "meadow");
    EXPECT_EQ(world.find("effective")->find("seed")->as_number(), 9);
    EXPECT_EQ(world.find("effective")->find("climate")->find("swing")->as_number(), 7);
    EXPECT_TRUE(world.find("world")->as_string().starts_with("meadow,seed=9,v="));
    for (const auto& [name, link] : world.find("links")->members())
        EXPECT_EQ(ask(link.as_string()).status, 200) << name;
}

TEST_F(WorldsTest, HaveWeatherThatAddsUp) {
    const Value weather = json_of(ask("/v1/worlds/mixed,seed=4/weather.json?year=80"));
    EXPECT_EQ(weather.find("year")->as_number(), 80);
    EXPECT_TRUE(weather.find("world")->as_string().starts_with("mixed,seed=4,v="));
    const Value& days = *weather.find("days");
    double rain = 0.0, wet_days = 0.0;
    ASSERT_EQ(days.find("rain_mm")->items().size(), 365U);
    for (const Value& day : days.find("rain_mm")->items()) {
        rain += day.as_number();
        wet_days += day.as_number() > 0.0 ? 1.0 : 0.0;
    }
    double of_months = 0.0;
    ASSERT_EQ(weather.find("months")->items().size(), 12U);
    for (const Value& month : weather.find("months")->items())
        of_months += month.find("rain_mm")->as_number();
    const Value& year = *weather.find("whole_year");
    EXPECT_NEAR(rain, year.find("rain_mm")->as_number(), 365 * 0.005);
    EXPECT_NEAR(of_months, year.find("rain_mm")->as_number(), 12 * 0.005);
    EXPECT_EQ(wet_days, year.find("rain_days")->as_number());
    for (const char* kind : {"temperature_c", "potential_evaporation_mm", "soil_water_mm"})
        EXPECT_EQ(days.find(kind)->items().size(), 365U) << kind;
}

TEST_F(WorldsTest, ReportAllThatIsWrong) {
    const Response unknown = ask("/v1/worlds/bech,seed=7.json");
    test::expect_problem(unknown, 404);
    EXPECT_TRUE(names(unknown, "world", "did you mean 'beech'?"));

    const Response wrong =
        ask("/v1/worlds/beech,seed=-1,seed=2,climate.rian=600,climate.rain=9000,x,=3/weather.json"
            "?year=201&day=3");
    test::expect_problem(wrong, 400);
    EXPECT_TRUE(names(wrong, "seed", "given more than once"));
    EXPECT_TRUE(names(wrong, "climate.rian", "did you mean 'climate.rain'"));
    EXPECT_TRUE(names(wrong, "climate.rain", "9000"));
    EXPECT_TRUE(names(wrong, "world", "'x' is not name=value"));
    EXPECT_TRUE(names(wrong, "world", "'=3' is not name=value"));
    EXPECT_TRUE(names(wrong, "year", "201"));
    EXPECT_TRUE(names(wrong, "day"));

    EXPECT_TRUE(names(ask("/v1/worlds/beech,.json"), "world", "'' is not name=value"));
    EXPECT_TRUE(names(ask("/v1/worlds/beech,seed=x.json"), "seed", "whole number"));
    EXPECT_TRUE(names(ask("/v1/worlds/beech,v=1,v=2.json"), "v", "more than once"));
    EXPECT_TRUE(names(ask("/v1/worlds/beech.json?v=1-00000000"), "v", "ends its text"));
    EXPECT_TRUE(names(ask("/v1/worlds/beech.json?year=3"), "year"));
    EXPECT_TRUE(names(ask("/v1/worlds/beech," + std::string(2100, 'a') + ".json"), "world",
                      "at most 2048"));
}

TEST_F(WorldsTest, AreNotGeneratedForHead) {
    const Response head = handle(service_, test::request("HEAD", "/v1/worlds/birch/weather.json"));
    EXPECT_EQ(head.status, 200);
    EXPECT_EQ(generated(), 0U);
    EXPECT_EQ(header(head, "ETag"), header(ask("/v1/worlds/birch/weather.json"), "ETag"));
    EXPECT_EQ(generated(), 1U);
}

TEST(WorldText, IsReadAsItIsWritten) {
    const std::shared_ptr<const Atlas> owner = built_in_atlas();
    const Atlas& atlas = *owner;
    for (const WorldPreset& preset : atlas.worlds()) {
        WorldSpec spec{preset.id.string(), params_of(preset)};
        EXPECT_EQ(world_text(spec, atlas), preset.id.view());
        spec.params.seed = 4294967295U;
        spec.params.climate.latitude_deg = -65.5;
        spec.params.climate.rain_days = 0.123456789;
        ValidationErrors errors;
        const WorldRequest again = read_world(world_text(spec, atlas, "35-x"), atlas, errors);
        EXPECT_TRUE(errors.empty());
        EXPECT_EQ(again.spec.preset, spec.preset);
        EXPECT_EQ(again.spec.params, spec.params);
        EXPECT_EQ(again.version, "35-x");
    }
}

}  // namespace
}  // namespace sporeprint::api::products_worlds_test
