#include "core/math/even_table.h"

#include <gtest/gtest.h>

#include <array>

namespace sporeprint::math_even_table_test {
namespace {

TEST(EvenTable, HasItsEntriesAndLinesBetweenThem) {
    constexpr std::array<double, 4> table = {2.0, 5.0, -1.0, 0.0};
    for (std::size_t i = 0; i < table.size(); ++i)
        EXPECT_NEAR(of_table(table, static_cast<double>(i) / 3.0), table[i], 1e-12);
    EXPECT_NEAR(of_table(table, 0.5), 2.0, 1e-12);
    EXPECT_NEAR(of_table(table, 0.25 / 3.0), 2.75, 1e-12);
}

TEST(EvenTable, TheLastEntryIsTheEndOfTheLastInterval) {
    const auto [below, t] = between_entries(1.0, 5);
    EXPECT_EQ(below, 3U);
    EXPECT_EQ(t, 1.0);
}

}  // namespace
}  // namespace sporeprint::math_even_table_test
