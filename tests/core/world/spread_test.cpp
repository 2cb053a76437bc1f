#include "core/world/spread.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/math/random.h"
#include "core/problems.h"

namespace sporeprint::spread_test {
namespace {

constexpr std::uint32_t test_purpose = 9998;

/// Returns heights given as a function of the column and the row, metres.
std::vector<std::int32_t> heights_from(const Grid& grid, auto height) {
    std::vector<std::int32_t> out;
    out.reserve(grid.nodes());
    for (int row = 0; row < grid.side; ++row)
        for (int column = 0; column < grid.side; ++column)
            out.push_back(quantised_height(height(column, row)));
    return out;
}

/// Returns open ground without hills, or on a slope that rises by rows, with a wind and rain.
SpreadGround even_ground(double from_deg, double focus, double speed, double rain,
                         double rise = 0) {
    const Grid grid = spread_grid(world_grid(1024));
    ClimateParams climate;
    climate.wind_from_deg = from_deg;
    climate.wind_focus = focus;
    climate.wind_speed = speed;
    SpreadGround out;
    out.grid = grid;
    out.rose = wind_rose(climate);
    for (std::vector<std::uint8_t>& factors : out.wind) factors.assign(grid.nodes(), 128);
    out.wash = wash_graph(
        grid, heights_from(grid, [&](int, int row) { return rise * grid.cell * row; }), rain);
    return out;
}

const Ground& hills() {
    static const Ground made = [] {
        WorldParams params;
        params.seed = 7;
        return ground_of(params);
    }();
    return made;
}

const SpreadGround& hilly() {
    static const SpreadGround made = spread_ground(hills(), {}, {0.15, 0.8, 28.0});
    return made;
}

std::vector<double> random_source(std::uint32_t seed) {
    Random random(seed, test_purpose);
    std::vector<double> out(hilly().grid.nodes());
    for (double& one : out) {
        const double draw = random.uniform();
        one = draw < 0.9 ? 0.0 : draw;
    }
    return out;
}

double sum_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

/// The mean column and row of a cover.
struct Middle {
    double column = 0.0, row = 0.0, sum = 0.0;
};

Middle middle_of(const Grid& grid, const auto& values) {
    Middle out;
    for (int row = 0; row < grid.side; ++row)
        for (int column = 0; column < grid.side; ++column) {
            const double here = values[grid.index(column, row)];
            out.column += here * column;
            out.row += here * row;
            out.sum += here;
        }
    out.column /= out.sum;
    out.row /= out.sum;
    return out;
}

/// The spores of one species.
class OneFall {
  public:
    OneFall(const SpreadGround& ground, const SporeHabit& spores) : fall_(ground, {&spores, 1}) {}
    double fall(const std::vector<double>& source, std::vector<double>& deposit) {
        std::vector<SporeLanes> emitted(source.size()), fallen(source.size());
        for (std::size_t i = 0; i < source.size(); ++i) emitted[i].of[0] = source[i];
        const SporeLanes gone = fall_.fall(emitted, fallen);
        for (std::size_t i = 0; i < source.size(); ++i) deposit[i] = fallen[i].of[0];
        return gone.of[0];
    }

  private:
    SporeFall fall_;
};

std::vector<double> single_source(const Grid& grid, int column, int row) {
    std::vector<double> out(grid.nodes(), 0.0);
    out[grid.index(column, row)] = 1.0;
    return out;
}

TEST(SporeFall, EverySporeLiesOnTheGroundOrLeavesTheWorld) {
    std::uint32_t seed = 0;
    for (const double height : {0.01, 0.1, 2.0, 20.0})
        for (const double settling : {0.0001, 0.0015, 0.05}) {
            OneFall fall(hilly(), {settling, height});
            const std::vector<double> source = random_source(++seed);
            std::vector<double> deposit(source.size());
            const double gone = fall.fall(source, deposit);
            EXPECT_GT(gone, 0.0);
            for (const double one : deposit) ASSERT_GE(one, 0.0);
            EXPECT_NEAR((sum_of(deposit) + gone) / sum_of(source), 1.0, 1e-12);
        }
}

TEST(SporeFall, IsLinearInItsSource) {
    OneFall fall(hilly(), {0.001, 0.1});
    const std::vector<double> a = random_source(1), b = random_source(2);
    std::vector<double> both(a.size()), of_a(a.size()), of_b(a.size()), of_both(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) both[i] = a[i] + 2.0 * b[i];
    const double gone_a = fall.fall(a, of_a), gone_b = fall.fall(b, of_b);
    EXPECT_NEAR(fall.fall(both, of_both) / (gone_a + 2.0 * gone_b), 1.0, 1e-12);
    for (std::size_t i = 0; i < a.size(); ++i)
        ASSERT_NEAR(of_both[i], of_a[i] + 2.0 * of_b[i], 1e-12);
}

TEST(SporeFall, CarriesSporesAsFarAsTheKernelSays) {
    // A steady wind from the west: what one cell sends travels u h / v on average.
    SpreadGround ground = even_ground(270, 5.0, 3.0, 0.0);
    for (std::size_t k = 0; k < wind_sectors; ++k) ground.rose[k].share = k == 6 ? 1.0 : 0.0;
    const SporeHabit spores{0.003, 0.3};
    const double mean = wind_near_ground(3.0 * (0.5 + 128 / 255.0), spores.height, ground.cover) *
                        spores.height / spores.settling;
    OneFall fall(ground, spores);
    const Grid& grid = ground.grid;
    std::vector<double> deposit(grid.nodes());
    static_cast<void>(fall.fall(single_source(grid, 2, 64), deposit));
    // What falls beside the bodies stays in their cell; so does half a cell of the way.
    deposit[grid.index(2, 64)] = 0.0;
    const Middle middle = middle_of(grid, deposit);
    EXPECT_NEAR(middle.row, 64.0, 1e-9);
    // A tenth of the ways are sqrt(2) as long, since they lead to the sides.
    EXPECT_NEAR((middle.column - 2.5) * grid.cell / mean, 1.0 / 1.0414, 0.01);
}

TEST(SporeFall, WithoutWindAndRainLeavesAllSporesWhereTheyAre) {
    const SpreadGround ground = even_ground(270, 1.0, 0.0, 0.0, 0.2);
    OneFall fall(ground, {});
    const std::vector<double> source = single_source(ground.grid, 70, 30);
    std::vector<double> deposit(source.size());
    EXPECT_EQ(fall.fall(source, deposit), 0.0);
    for (std::size_t i = 0; i < source.size(); ++i) ASSERT_NEAR(deposit[i], source[i], 1e-15);
}

TEST(SporeFall, RainOnASlopeWashesSporesDownhillAndOnLevelGroundHardly) {
    const auto fallen = [](double rain, double rise) {
        const SpreadGround ground = even_ground(270, 1.0, 0.0, rain, rise);
        OneFall fall(ground, {});
        std::vector<double> deposit(ground.grid.nodes());
        static_cast<void>(fall.fall(single_source(ground.grid, 64, 64), deposit));
        for (int row = 65; row < ground.grid.side; ++row)
            for (int column = 0; column < ground.grid.side; ++column)
                if (rise > 0.0) {
                    EXPECT_EQ(deposit[ground.grid.index(column, row)], 0.0);
                }
        return middle_of(ground.grid, deposit).row;
    };
    EXPECT_LT(fallen(800, 0.3), 63.5);
    EXPECT_LT(fallen(1600, 0.3), fallen(800, 0.3));
    EXPECT_LT(fallen(800, 0.3), fallen(800, 0.1));
    EXPECT_EQ(fallen(0, 0.3), 64.0);
    EXPECT_NEAR(fallen(800, 0.0), 64.0, 0.05);
}

/// Returns the cover of the last year from one founder of year 0.
Establishment from_one(const SpreadGround& ground, const SporeHabit& spores, int column, int row) {
    const std::vector<double> suitability(ground.grid.nodes(), 1.0);
    const std::vector<Founder> founder{{ground.grid.place(column), ground.grid.place(row), 0}};
    return spread_of(ground, spores, suitability, founder);
}

TEST(Spread, IsMirroredWhenTheWindTurns) {
    // Columns and rows 63 and 64 are mirror images of each other.
    const SporeHabit spores{0.0015, 0.2};
    for (const double from : {270.0, 30.0}) {
        const Establishment there = from_one(even_ground(from, 2.0, 3.0, 0.0), spores, 63, 63);
        const Establishment back = from_one(
            even_ground(from < 180 ? from + 180 : from - 180, 2.0, 3.0, 0.0), spores, 64, 64);
        for (std::size_t moment = 0; moment < spread_moments; ++moment)
            for (std::size_t i = 0; i < there.shares[moment].size(); ++i)
                ASSERT_NEAR(there.shares[moment][i],
                            back.shares[moment][there.shares[moment].size() - 1 - i], 1);
        const Middle went = middle_of(there.grid, there.shares[3]),
                     came = middle_of(back.grid, back.shares[3]);
        EXPECT_NEAR((went.column - 63) / (64 - came.column), 1.0, 0.1);
        EXPECT_GT(std::abs(went.column - 63) + std::abs(went.row - 63), 2.0);
    }
}

TEST(Spread, GoesWithTheWind) {
    const Establishment to_east = from_one(even_ground(270, 3.0, 3.0, 0.0), {0.0015, 0.2}, 64, 64);
    const Middle middle = middle_of(to_east.grid, to_east.shares[3]);
    EXPECT_GT(middle.column, 68.0);
    EXPECT_NEAR(middle.row, 64.0, 0.5);
}

TEST(Spread, ReachesMoreGroundFromYearToYearAndLessWithHeavySpores) {
    const SpreadGround ground = even_ground(250, 1.2, 3.0, 800);
    const Establishment light = from_one(ground, {0.0008, 0.1}, 64, 64),
                        heavy = from_one(ground, {0.004, 0.1}, 64, 64);
    double before = 0.0;
    for (std::size_t moment = 0; moment < spread_moments; ++moment) {
        const double sum = middle_of(light.grid, light.shares[moment]).sum;
        EXPECT_GT(sum, before);
        before = sum;
        if (moment > 1) {
            EXPECT_LT(middle_of(heavy.grid, heavy.shares[moment]).sum, sum);
        }
    }
}

TEST(Spread, LeavesUnsuitableGroundEmpty) {
    std::vector<double> suitability(hilly().grid.nodes());
    for (std::size_t i = 0; i < suitability.size(); ++i) suitability[i] = i % 3 == 0 ? 0.0 : 0.8;
    const std::vector<Founder> founders =
        founders_of(hilly().grid, 3, stream_of("fly_agaric"), suitability);
    const Establishment out = spread_of(hilly(), {}, suitability, founders);
    for (const std::vector<std::uint8_t>& shares : out.shares)
        for (std::size_t i = 0; i < shares.size(); i += 3) ASSERT_EQ(shares[i], 0);
    const std::vector<double> nowhere(suitability.size(), 0.0);
    EXPECT_TRUE(founders_of(hilly().grid, 3, 5, nowhere).empty());
    const Establishment none = spread_of(hilly(), {}, nowhere, founders);
    for (const std::vector<std::uint8_t>& shares : none.shares)
        EXPECT_TRUE(std::ranges::all_of(shares, [](std::uint8_t one) { return one == 0; }));
}

TEST(Spread, HasNothingBeforeTheFirstFounderArrives) {
    const std::vector<double> suitability(hilly().grid.nodes(), 1.0);
    const std::vector<Founder> late{{10.0, 20.0, 47}};
    const Establishment out = spread_of(hilly(), {}, suitability, late);
    for (std::size_t moment = 0; moment < spread_moments; ++moment)
        EXPECT_EQ(std::ranges::any_of(out.shares[moment], [](std::uint8_t one) { return one > 0; }),
                  moment >= 3);
    const std::vector<Founder> elsewhere{{5000.0, 0.0, 0}, {0.0, 0.0, 201}};
    EXPECT_EQ(spread_of(hilly(), {}, suitability, elsewhere).shares.back(),
              std::vector<std::uint8_t>(suitability.size()));
}

TEST(Spread, OfHashedFoundersCoversMostSuitableGroundByYearZero) {
    const std::vector<double> suitability(hilly().grid.nodes(), 0.8);
    const auto covered_at = [&](const SporeHabit& spores, std::size_t moment) {
        const Establishment out =
            spread_of(hilly(), spores, suitability, founders_of(hilly().grid, 7, 11, suitability));
        return middle_of(out.grid, out.shares[moment]).sum /
               (255.0 * static_cast<double>(suitability.size()));
    };
    EXPECT_GT(covered_at({0.0015, 0.08}, 0), 0.8);
    // Low bodies with heavy spores still spread.
    const double low = covered_at({0.003, 0.03}, 0);
    EXPECT_GT(low, 0.3);
    EXPECT_LT(low, covered_at({0.003, 0.03}, 10));
}

TEST(Founders, StandInTheirSquaresOnSuitableGroundAndAreThoseOfLargerWorlds) {
    const Grid small = spread_grid(world_grid(256)), large = spread_grid(world_grid(1024));
    std::vector<double> suitability(large.nodes(), 0.0);
    for (std::size_t i = 0; i < suitability.size(); i += 5) suitability[i] = 1.0;
    const std::vector<Founder> founders = founders_of(large, 9, 1, suitability);
    ASSERT_EQ(founders.size(), 64U);
    int early = 0;
    for (std::size_t i = 0; i < founders.size(); ++i) {
        const double west = -640.0 + 160.0 * static_cast<double>(i % 8);
        EXPECT_TRUE(founders[i].x > west && founders[i].x < west + 160.0);
        const auto cell = static_cast<std::size_t>((founders[i].y + 640.0) / 10.0) * 128 +
                          static_cast<std::size_t>((founders[i].x + 640.0) / 10.0);
        EXPECT_EQ(suitability[cell], 1.0);
        EXPECT_GE(founders[i].year, spread_begin);
        EXPECT_LE(founders[i].year, last_year);
        early += founders[i].year == spread_begin ? 1 : 0;
    }
    EXPECT_GT(early, 25);
    EXPECT_LT(early, 52);
    // Years are those of the square, whatever the world is; places differ by what suits them.
    const std::vector<double> everywhere(small.nodes(), 1.0);
    const std::vector<Founder> of_small = founders_of(small, 9, 1, everywhere);
    ASSERT_EQ(of_small.size(), 4U);
    EXPECT_EQ(of_small[0].year, founders[3 * 8 + 3].year);
    EXPECT_EQ(of_small[3].year, founders[4 * 8 + 4].year);
    EXPECT_NE(founders_of(large, 9, 2, suitability), founders);
    EXPECT_NE(founders_of(large, 10, 1, suitability), founders);
}

TEST(Establishment, IsLinearBetweenCellsAndMoments) {
    Establishment out{{4, 10.0, -15.0}, {}};
    for (std::size_t moment = 0; moment < spread_moments; ++moment)
        for (int i = 0; i < 16; ++i)
            out.shares[moment].push_back(
                static_cast<std::uint8_t>(10 * (i % 4) + static_cast<int>(5 * moment)));
    EXPECT_NEAR(establishment_at(out, -15.0, 0.0, 0.0), 0.0, 1e-12);
    EXPECT_NEAR(establishment_at(out, 0.0, 3.0, 30.0), (15.0 + 7.5) / 255.0, 1e-12);
    EXPECT_NEAR(establishment_at(out, 500.0, -500.0, 200.0), (30.0 + 50.0) / 255.0, 1e-12);
    EXPECT_EQ(out.bytes(), sizeof(out) + 16 * spread_moments);
}

TEST(Spread, OfASpeciesIsTheSameBesideOthers) {
    const SpreadGround& ground = hilly();
    const std::vector<SporeHabit> spores{{0.0015, 0.06}, {0.004, 0.3}, {0.0007, 1.5}, {0.01, 0.02}};
    std::vector<std::vector<double>> suits(4);
    std::vector<std::vector<Founder>> founders;
    std::vector<Spreading> together;
    for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t i = 0; i < ground.grid.nodes(); ++i)
            suits[k].push_back(static_cast<double>((i * (k + 3)) % 17) / 16.0);
        founders.push_back(founders_of(ground.grid, 5, static_cast<std::uint32_t>(k), suits[k]));
    }
    for (std::size_t k = 0; k < 4; ++k) together.push_back({spores[k], suits[k], founders[k]});
    const std::vector<Establishment> all = spread_together(ground, together);
    for (std::size_t k = 0; k < 4; ++k)
        EXPECT_EQ(spread_of(ground, spores[k], suits[k], founders[k]).shares, all[k].shares) << k;
    const std::vector<Establishment> two = spread_together(ground, std::span(together).subspan(2));
    EXPECT_EQ(two[1].shares, all[3].shares);
    EXPECT_THROW(SporeFall(ground, {}), InvalidInput);
    EXPECT_THROW(SporeFall(ground, std::vector<SporeHabit>(5)), InvalidInput);
}

TEST(Spread, RefusesValuesOfAnotherGrid) {
    const std::vector<double> few(7, 1.0);
    EXPECT_THROW(static_cast<void>(spread_of(hilly(), {}, few, {})), InvalidInput);
    EXPECT_THROW(static_cast<void>(founders_of(hilly().grid, 1, 1, few)), InvalidInput);
}

}  // namespace
}  // namespace sporeprint::spread_test
