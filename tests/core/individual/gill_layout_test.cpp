#include "core/individual/gill_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace sporeprint::individual_gill_layout_test {
namespace {

int there(const BladeRow& row) {
    return static_cast<int>(std::count_if(row.blades().begin(), row.blades().end(),
                                          [](const Blade& b) { return b.presence > 0.0; }));
}

TEST(GillLayout, ASingleSpeciesIsEvenlySpacedOnAllTiers) {
    const BladeRow row(slot_assignment(0, HymeniumPattern::gills, 40, 2), HymeniumPattern::gills,
                       0.0, 7, 160);
    EXPECT_EQ(there(row), 160);
    for (int slot = 0; slot < 160; ++slot) {
        const Blade& blade = row.blades()[static_cast<std::size_t>(slot)];
        EXPECT_NEAR(row.turn(blade, 1.0), slot / 160.0, gill_wander);
        if (slot % 4 == 0) {
            EXPECT_EQ(blade.begin, 0.0) << "reaches the stem";
        }
        if (slot % 4 != 0) {
            EXPECT_NEAR(blade.begin, slot % 2 == 0 ? 0.30 : 0.58, tier_strays);
        }
    }
}

TEST(GillLayout, InADenserLayoutEveryBladeHasItsOwnSlot) {
    for (const int gill_layout : {60, 84, 100})
        for (const int own : {12, 23, 40, 59})
            for (const int tiers : {0, 1, 2}) {
                if (own << tiers > gill_layout << 2) continue;
                const SlotAssignment assignment =
                    slot_assignment(gill_layout, HymeniumPattern::gills, own, tiers);
                const BladeRow row(assignment, HymeniumPattern::gills, 0.0, 3, gill_layout << 2);
                const int expected = own << tiers;
                EXPECT_NEAR(there(row), expected, expected >= gill_layout ? 1 : 0)
                    << gill_layout << ' ' << own << ' ' << tiers;
            }
}

TEST(GillLayout, ForksStartAtTheirRidgeAndEndBetweenTwo) {
    const BladeRow row(slot_assignment(0, HymeniumPattern::ridges, 30, 1), HymeniumPattern::ridges,
                       1.0, 5, 120);
    int forks = 0;
    for (int slot = 0; slot < 120; ++slot) {
        const Blade& blade = row.blades()[static_cast<std::size_t>(slot)];
        if (blade.presence <= 0.0 || blade.begin <= 0.0) continue;
        ++forks;
        EXPECT_NEAR(row.turn(blade, 1.0), slot / 120.0, 0.005 + ridge_wander);
        const double from = row.turn(blade, blade.begin);
        const double parent = std::abs(blade.from - blade.to);
        EXPECT_NEAR(parent, slot % 2 == 0 ? 0.5 : 0.25, 1e-12);
        EXPECT_LT(std::abs(from - row.turn(blade, 1.0)), 1.0 / 30.0);
    }
    EXPECT_GT(forks, 60);
    const BladeRow plain(slot_assignment(0, HymeniumPattern::ridges, 30, 1),
                         HymeniumPattern::ridges, 0.0, 5, 120);
    EXPECT_EQ(there(plain), 30) << "nothing forks";
}

TEST(GillLayout, PresenceOfForksIsContinuousInForking) {
    std::vector<double> before;
    for (double forking = 0.0; forking <= 1.0; forking += 0.004) {
        const BladeRow row(slot_assignment(0, HymeniumPattern::ridges, 34, 1),
                           HymeniumPattern::ridges, forking, 9, 136);
        std::vector<double> now;
        for (const Blade& blade : row.blades()) now.push_back(blade.presence);
        for (std::size_t i = 0; i < before.size(); ++i)
            EXPECT_LT(std::abs(now[i] - before[i]), 0.1);
        before = now;
    }
}

TEST(GillLayout, BladesKeepTheirOrderUnderWander) {
    for (const std::uint32_t seed : {1U, 2U, 77U}) {
        const BladeRow row(slot_assignment(0, HymeniumPattern::gills, 96, 1),
                           HymeniumPattern::gills, 0.0, seed, 192);
        for (const double share : {0.0, 0.3, 0.7, 1.0})
            for (std::size_t i = 0; i + 1 < 192; ++i)
                EXPECT_LT(row.turn(row.blades()[i], share), row.turn(row.blades()[i + 1], share));
    }
}

TEST(GillLayout, CrossVeinsStayInTheirRowsAndGrowWithForking) {
    EXPECT_EQ(cross_veins(34, 0.7, 3).size(), 34u * 7u);
    EXPECT_EQ(cross_veins(100, 0.7, 3).size(), 300u) << "many ridges have fewer rows";
    EXPECT_TRUE(cross_veins(400, 0.7, 3).empty()) << "gaps too narrow to be joined";
    std::vector<CrossVein> before = cross_veins(34, 0.0, 3);
    for (const CrossVein& vein : before) EXPECT_EQ(vein.height, 0.0);
    for (double forking = 0.01; forking <= 1.0; forking += 0.01) {
        const std::vector<CrossVein> now = cross_veins(34, forking, 3);
        for (std::size_t i = 0; i < now.size(); ++i) {
            EXPECT_EQ(now[i].share, before[i].share) << "places stay";
            EXPECT_GE(now[i].height, before[i].height);
            EXPECT_LT(now[i].height - before[i].height, 0.06);
            EXPECT_GT(now[i].share, 0.0);
            EXPECT_LT(now[i].share, 1.0);
        }
        before = now;
    }
}

TEST(GillLayout, SpineCountsFollowTheirSpacingUpToTheLimit) {
    const CellRows few = cell_rows(0.02, 0.005, 0.025, 500.0, most_spines);
    EXPECT_EQ(few.rows, 10);
    const double area = 3.14159265 * (0.025 * 0.025 - 0.005 * 0.005);
    EXPECT_NEAR(cell_count(few), area * 500.0 * 500.0, 0.1 * area * 500.0 * 500.0);
    const CellRows many = cell_rows(0.05, 0.01, 0.06, 1200.0, most_spines);
    EXPECT_LE(cell_count(many), most_spines);
    EXPECT_GT(cell_count(many), most_spines * 9 / 10);
    const std::vector<CellPlace> places = cell_places(many, 4);
    EXPECT_EQ(static_cast<int>(places.size()), cell_count(many));
    for (const CellPlace& place : places) {
        EXPECT_GT(place.share, 0.0);
        EXPECT_LT(place.share, 1.0);
        EXPECT_GT(place.turn, -0.5);
        EXPECT_LT(place.turn, 1.5);
    }
}

}  // namespace
}  // namespace sporeprint::individual_gill_layout_test
