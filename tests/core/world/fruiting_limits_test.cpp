#include "core/world/fruiting_limits.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/support/forest.h"

namespace sporeprint::fruiting_limits_test {
namespace {

using namespace fungi;

TEST(Limits, NameTheConditionThatIsLeastSatisfied) {
    Forest all;
    const SeasonConditions conditions = conditions_in(all.species, beech, 7, 102);
    std::set<Condition> found;
    for (int day = 1; day <= days_of_year; day += 28)
        for (int i = 0; i < 10; ++i) {
            const Limits limits =
                limits_at(all.fungi(), all.in(102), conditions, 0, point(6.0 * i + 1.3, 30.0), day);
            found.insert(limits.limiting());
            for (const double value : limits.values) {
                EXPECT_GE(value, limits[limits.limiting()]);
                EXPECT_LE(value, 1.0);
            }
        }
    EXPECT_TRUE(found.contains(Condition::mycelium));
    EXPECT_TRUE(found.contains(Condition::month) || found.contains(Condition::temperature));
    all.habitat.established = 0.0;
    const Limits nowhere = limits_at(all.fungi(), all.in(102), conditions, 0, point(5, 5), 250);
    EXPECT_EQ(std::string(name(nowhere.limiting())), "establishment");
    EXPECT_EQ(nowhere[Condition::light], 1.0);
}

TEST(Limits, AllowAPlaceWhereBodiesEmerge) {
    const Forest all;
    const SeasonConditions conditions = conditions_in(all.species, beech, 7, 102);
    int checked = 0;
    for (const FruitBody& body : all.bodies(102)) {
        if (all.species[body.species].ecology.guild == Guild::wood || ++checked % 20 != 0) continue;
        const int day = (body.emerged - time_of(102)) / ticks_of_day + 1;
        const Limits limits =
            limits_at(all.fungi(), all.in(102), conditions, body.species, body.at, day);
        EXPECT_GT(limits[Condition::light], 0.0);
        EXPECT_EQ(limits[Condition::establishment], 1.0);
        EXPECT_GT(limits[Condition::month], 0.0);
    }
    EXPECT_GT(checked, 200);
}

}  // namespace
}  // namespace sporeprint::fruiting_limits_test
