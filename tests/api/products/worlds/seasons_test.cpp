// Seasons of worlds over HTTP.

#include "api/products/worlds/seasons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/api/support.h"

namespace sporeprint::api::products_world_seasons_test {
namespace {

using test::header;
using test::json_of;
using test::names;
using test::text_of;

const std::string world = "/v1/worlds/meadow,seed=7,extent=256";

class WorldSeasonsTest : public test::RequestedService {};

TEST_F(WorldSeasonsTest, CountEachSpeciesOnEachDay) {
    const Response response = ask(world + "/season.json?year=80");
    ASSERT_EQ(response.status, 200) << text_of(response);
    const Value season = json_of(response);
    EXPECT_EQ(season.find("area_m2")->as_number(), 4096);
    EXPECT_EQ(season.find("days")->find("rain_mm")->items().size(), 365U);
    double emerged = 0.0, most = 0.0;
    for (const Value& species : season.find("species")->items()) {
        EXPECT_EQ(species.find("standing")->items().size(), 365U);
        emerged += species.find("emerged")->as_number();
        for (const Value& day : species.find("standing")->items())
            most = std::max(most, day.as_number());
    }
    EXPECT_GT(emerged, 100.0);
    EXPECT_GT(most, 10.0);
    EXPECT_LT(most, emerged);
}

TEST_F(WorldSeasonsTest, HaveNoBodyWithoutRain) {
    const Value season =
        json_of(ask("/v1/worlds/meadow,seed=7,extent=256,climate.rain=0/season.json?year=80"));
    for (const Value& species : season.find("species")->items())
        EXPECT_EQ(species.find("emerged")->as_number(), 0.0);
}

TEST_F(WorldSeasonsTest, RefuseRectanglesThatAreTooLargeOrElsewhere) {
    EXPECT_TRUE(names(ask(world + "/season.json?bbox=-60,-60,60,60"), "bbox", "at most 10000"));
    EXPECT_EQ(ask(world + "/season.json?bbox=-60,-60,60,60").status, 422);
    EXPECT_TRUE(names(ask(world + "/season.json?bbox=0,0,1"), "bbox", "four numbers"));
    EXPECT_TRUE(names(ask(world + "/season.json?bbox=120,0,140,10"), "bbox", "outside the world"));
    EXPECT_TRUE(names(ask(world + "/season.json?year=201"), "year", "200"));
    EXPECT_EQ(header(ask(world + "/season.json?bbox=-32,-32,32,32"), "ETag"),
              header(ask(world + "/season.json"), "ETag"));
}

}  // namespace
}  // namespace sporeprint::api::products_world_seasons_test
