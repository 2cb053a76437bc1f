#include "core/world/world_species.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/random.h"
#include "tests/support/refusals.h"

namespace sporeprint::world_species_test {
namespace {

const WorldLookup& lookup() {
    static const WorldLookup one{[](std::string_view) { return nullptr; },
                                 [](std::string_view id) -> std::optional<SpeciesRecord> {
                                     if (id != "bolete") return std::nullopt;
                                     SpeciesRecord record;
                                     record.ecology.trees = {Text<48>("spruce")};
                                     record.months = 0b0011'0000'0000;  // September and October
                                     record.cap_radius = 0.06;
                                     return record;
                                 }};
    return one;
}

TEST(WorldSpecies, HaveTheirEcologyTreesAndDraws) {
    std::vector<Problem> problems;
    const std::vector<std::string> ids = {"bolete"}, kinds = {"birch", "spruce"};
    const auto fungi = fungi_of(ids, {}, kinds, lookup(), nullptr, problems);
    ASSERT_EQ(fungi.size(), 1U);
    EXPECT_TRUE(problems.empty());
    EXPECT_EQ(fungi[0].kinds, 2U);
    EXPECT_EQ(fungi[0].stream, stream_of("bolete"));
    EXPECT_EQ(fungi[0].cap_radius, 0.06);
    EXPECT_EQ(fungi[0].months, 0b0011'0000'0000);
}

TEST(WorldSpecies, FruitHalfAYearLaterInTheSouth) {
    std::vector<Problem> problems;
    const std::vector<std::string> ids = {"bolete"};
    const auto fungi = fungi_of(ids, {.latitude_deg = -40}, {}, lookup(), nullptr, problems);
    ASSERT_EQ(fungi.size(), 1U);
    EXPECT_EQ(fungi[0].months, 0b0000'0000'1100) << "March and April";
}

TEST(WorldSpecies, NameThoseThatAreUnknown) {
    std::vector<Problem> problems;
    const std::vector<std::string> ids = {"boletus", "bolete"};
    EXPECT_EQ(fungi_of(ids, {}, {}, lookup(), nullptr, problems).size(), 1U);
    EXPECT_TRUE(names(problems, "fungi.species", "there is no species 'boletus'"));
}

}  // namespace
}  // namespace sporeprint::world_species_test
