// Limits of fungi at places of worlds over HTTP.

#include "api/products/worlds/limits.h"

#include <gtest/gtest.h>

#include <string>

#include "core/world/fruiting_limits.h"
#include "tests/api/support.h"

namespace sporeprint::api::products_world_limits_test {
namespace {

using test::header;
using test::json_of;
using test::names;
using test::text_of;

const std::string meadow = "/v1/worlds/meadow,seed=7,extent=256";

class WorldLimitsTest : public test::RequestedService {};

TEST_F(WorldLimitsTest, NameTheConditionThatLimitsEachSpecies) {
    const Response response = ask(meadow + "/y80d270/limits.json?x=4.5&y=-3");
    ASSERT_EQ(response.status, 200) << text_of(response);
    const Value found = json_of(response);
    EXPECT_EQ(found.find("place_m")->items()[0].as_number(), 4.5);
    EXPECT_EQ(found.find("species")->items().size(), 7U);
    for (const Value& species : found.find("species")->items()) {
        const Value& limits = *species.find("limits");
        EXPECT_EQ(limits.members().size(), condition_count);
        double least = 1.0;
        for (const auto& [condition, value] : limits.members())
            least = std::min(least, value.as_number());
        EXPECT_EQ(species.find("share")->as_number(), least);
        EXPECT_TRUE(species.find("why")->as_string().ends_with('.'));
        const std::string& limiting = species.find("limiting")->as_string();
        EXPECT_EQ(limiting == "nothing" ? 1.0 : limits.find(limiting)->as_number(), least);
    }
    const std::string canonical = header(response, "Content-Location");
    EXPECT_EQ(header(ask(canonical), "ETag"), header(response, "ETag"));
}

TEST_F(WorldLimitsTest, TellWhySpeciesCannotLiveInAWorld) {
    const std::string world =
        "/v1/worlds/meadow,seed=7,extent=256,stand.density=0,fungi.species="
        "marasmius_oreades+boletus_edulis";
    const Value found = json_of(ask(world + "/y80d270/limits.json"));
    const Value::Array& species = found.find("species")->items();
    ASSERT_EQ(species.size(), 2U);
    EXPECT_EQ(species[0].find("possible")->as_bool(), false);
    EXPECT_NE(species[0].find("why")->as_string().find("none of which grows here"),
              std::string::npos)
        << species[0].find("why")->as_string();
    const Value described = json_of(ask(world + ".json"));
    const Value::Array& fungi = described.find("fungi")->items();
    ASSERT_EQ(fungi.size(), 2U);
    EXPECT_EQ(fungi[0].find("possible")->as_bool(), false);
    EXPECT_EQ(fungi[0].find("why_not")->as_string(), species[0].find("why")->as_string());
    EXPECT_EQ(fungi[1].find("possible")->as_bool(), true);
    EXPECT_EQ(fungi[1].find("why_not"), nullptr);
}

TEST_F(WorldLimitsTest, RefusePlacesBeyondTheWorldAndTimesWithoutADay) {
    EXPECT_TRUE(names(ask(meadow + "/y80d270/limits.json?x=128"), "x", "outside the world"));
    EXPECT_EQ(ask(meadow + "/y80d270/limits.json?x=128").status, 422);
    EXPECT_EQ(ask(meadow + "/y80d270/limits.json?x=-128&y=127.9").status, 200);
    EXPECT_TRUE(names(ask(meadow + "/y80/limits.json"), "time", "y80d270"));
    EXPECT_TRUE(names(ask(meadow + "/y80d270/limits.json?x=nan"), "x", ""));
}

}  // namespace
}  // namespace sporeprint::api::products_world_limits_test
