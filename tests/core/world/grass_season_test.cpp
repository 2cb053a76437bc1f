#include "core/world/grass_season.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sporeprint::grass_season_test {
namespace {

TEST(GrassSeason, ChangesLittleFromDayToDayAlsoAtTheTurnOfTheYear) {
    for (int day = 1; day <= 365; ++day) {
        const GrassSeason today = grass_on(day), tomorrow = grass_on(day % 365 + 1);
        EXPECT_LT(std::abs(today.dry - tomorrow.dry), 0.02) << day;
        EXPECT_LT(std::abs(today.fresh - tomorrow.fresh), 0.02) << day;
        EXPECT_LT(std::abs(today.herbs - tomorrow.herbs), 0.03) << day;
    }
}

TEST(GrassSeason, IsWitheredInWinterAndFreshInMay) {
    const GrassSeason winter = grass_on(40), may = grass_on(140), september = grass_on(258);
    EXPECT_GT(winter.dry, 0.5);
    EXPECT_LT(may.dry, 0.1);
    EXPECT_GT(september.dry, may.dry);
    EXPECT_LT(september.dry, winter.dry);
    EXPECT_GT(may.fresh, september.fresh);
    EXPECT_GT(september.fresh, winter.fresh);
    EXPECT_EQ(winter.herbs, 0.0);
    EXPECT_EQ(may.herbs, 1.0);
}

TEST(GrassSeason, HasSharesOnAllDays) {
    for (int day = 1; day <= 365; ++day) {
        const GrassSeason today = grass_on(day);
        EXPECT_TRUE(today.dry >= 0.0 && today.dry <= 1.0 && today.herbs >= 0.0 &&
                    today.herbs <= 1.0)
            << day;
    }
}

}  // namespace
}  // namespace sporeprint::grass_season_test
