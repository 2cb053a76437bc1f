#include "core/world/horizon.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "core/math/elementary.h"
#include "core/problems.h"
#include "core/world/weather.h"

namespace sporeprint::horizon_test {
namespace {

/// Returns the horizon of heights given as a function of x and y, metres.
Horizon horizon_from(const Grid& grid, auto height) {
    std::vector<std::int32_t> heights;
    heights.reserve(grid.nodes());
    for (int row = 0; row < grid.side; ++row)
        for (int column = 0; column < grid.side; ++column)
            heights.push_back(quantised_height(height(grid.place(column), grid.place(row))));
    return horizon_of(grid, heights);
}

const Grid grid{129, 2.5, -160.0};

const Horizon& level() {
    static const Horizon made = horizon_from(grid, [](double, double) { return 3.0; });
    return made;
}

/// A wall 20 m high from 50 m east of the centre on.
const Horizon& wall() {
    static const Horizon made =
        horizon_from(grid, [](double x, double) { return x >= 50.0 ? 20.0 : 0.0; });
    return made;
}

constexpr double berlin = 0.916;  // radians

TEST(Horizon, OfLevelGroundIsLowAndTheSkyIsOpen) {
    const LocalHorizon here = horizon_at(level(), 12.0, -7.0);
    for (const double sine : here.sines) EXPECT_EQ(sine, 0.0);
    EXPECT_NEAR(here.sky, 1.0, 1e-12);
    EXPECT_EQ(level().bytes(), sizeof(Horizon) + 65 * 65 * 17);
}

TEST(Horizon, OfAPlaneIsThatOfItsSlope) {
    const Horizon plane =
        horizon_from(world_grid(1024), [](double x, double y) { return 0.3 * x - 0.4 * y; });
    const LocalHorizon here = horizon_at(plane, 0.0, 0.0);
    double sum = 0.0;
    for (std::size_t azimuth = 0; azimuth < horizon_azimuths; ++azimuth) {
        const double angle = 2.0 * pi * static_cast<double>(azimuth) / horizon_azimuths;
        const double rise = std::max(0.0, 0.3 * std::sin(angle) - 0.4 * std::cos(angle));
        const double expected = rise / std::sqrt(1.0 + rise * rise);
        EXPECT_NEAR(here.sines[azimuth], expected, 0.004);
        sum += expected;
    }
    EXPECT_NEAR(here.sky, 1.0 - sum / horizon_azimuths, 0.003);
}

TEST(Horizon, OfAWallHasItsHeightOverItsDistance) {
    // Samples are up to 30 % apart, and the wall is as broad as a cell.
    const LocalHorizon here = horizon_at(wall(), 0.0, 0.0);
    const double rise = 20.0 / 50.0;
    EXPECT_LE(here.sines[4], rise / std::sqrt(1.0 + rise * rise) + 0.003);
    EXPECT_GE(here.sines[4], rise / 1.3 / std::sqrt(1.0 + rise * rise / 1.69) - 0.003);
    EXPECT_EQ(here.sines[12], 0.0);
    EXPECT_EQ(here.sines[0], 0.0);
    EXPECT_EQ(horizon_at(wall(), 100.0, 0.0).sines[4], 0.0);
}

TEST(Horizon, IsHigherTheCloserTheWall) {
    double before = 0.0, sky = 1.0;
    for (const double x : {-150.0, -100.0, -50.0, 0.0, 25.0, 40.0}) {
        const LocalHorizon here = horizon_at(wall(), x, 10.0);
        EXPECT_GT(here.sines[4], before);
        EXPECT_LT(here.sky, sky);
        before = here.sines[4];
        sky = here.sky;
    }
}

TEST(Horizon, TurnsWithTheGround) {
    const auto bumps = [](double x, double y) {
        return 15.0 * sine(x / 17.0) * cosine(y / 29.0) + 0.1 * x;
    };
    const Horizon before = horizon_from(grid, bumps);
    const Horizon turned = horizon_from(grid, [&](double x, double y) { return bumps(-y, x); });
    // What was to the east is to the south: a quarter of all directions further.
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {45.0, -30.0}, {-80.0, 25.0}}) {
        const LocalHorizon here = horizon_at(before, x, y), there = horizon_at(turned, y, -x);
        for (std::size_t azimuth = 0; azimuth < horizon_azimuths; ++azimuth)
            EXPECT_NEAR(here.sines[azimuth], there.sines[(azimuth + 4) % horizon_azimuths], 0.005);
    }
}

TEST(Horizon, HasTheSameSkyAlone) {
    std::vector<std::int32_t> heights;
    for (std::size_t i = 0; i < grid.nodes(); ++i)
        heights.push_back(static_cast<std::int32_t>(i * 7919 % 20011));
    const Horizon horizon = horizon_of(grid, heights);
    for (double x = -70.0; x < 70.0; x += 3.3)
        EXPECT_EQ(sky_at(horizon, x, 0.7 * x), horizon_at(horizon, x, 0.7 * x).sky);
    const Horizon reversed =
        horizon_of(grid, heights, [](std::span<const std::function<void()>> tasks) {
            for (std::size_t i = tasks.size(); i-- > 0;) tasks[i]();
        });
    EXPECT_EQ(reversed.sines, horizon.sines);
    EXPECT_EQ(reversed.sky, horizon.sky);
}

TEST(Horizon, IsDefinedBeyondTheGrid) {
    EXPECT_EQ(horizon_at(wall(), -1e4, 0.0).sines[4], horizon_at(wall(), -160.0, 0.0).sines[4]);
    EXPECT_THROW(static_cast<void>(horizon_of({6, 1.0, 0.0}, std::vector<std::int32_t>(36))),
                 InvalidInput);
}

TEST(Sun, StandsInTheSouthAtNoonAndHasTheHeightOfItsDeclination) {
    for (const int day : {1, 80, 172, 266, 355}) {
        const SunDay sun = sun_of(berlin, day);
        for (std::size_t i = 0; i < sun.positions.size(); ++i) {
            const SunPosition& one = sun.positions[i];
            const SunPosition& mirrored = sun.positions[sun.positions.size() - 1 - i];
            EXPECT_NEAR(one.east * one.east + one.north * one.north + one.up * one.up, 1.0, 1e-12);
            EXPECT_NEAR(one.east, -mirrored.east, 1e-12);
            EXPECT_GT(one.up, 0.0);
        }
        // East in the morning; the two middle moments are nearly at noon.
        EXPECT_GT(sun.positions[0].east, 0.0);
        EXPECT_LT(sun.positions[6].north, 0.0);
        EXPECT_NEAR(sun.positions[6].up, std::cos(berlin - sun_declination(day)), 0.03);
    }
    EXPECT_GT(sun_of(-berlin, 172).positions[6].north, 0.0);
}

TEST(Sun, ReachesOpenLevelGroundWhole) {
    const LocalHorizon open = horizon_at(level(), 0.0, 0.0);
    rc::check([&] {
        const double latitude = radians(*rc::gen::inRange(-66, 67));
        const SunDay sun = sun_of(latitude, *rc::gen::inRange(1, 366));
        RC_ASSERT(sun.level > 0.0);
        RC_ASSERT(sun_at(open, {5.0, 0.0, 0.0}, sun) == 1.0);
        RC_ASSERT(light_at(open, {5.0, 0.0, 0.0}, sun) > 1.0 - 1e-12);
    });
}

TEST(Sun, LeavesSlopesTowardsThePoleDarker) {
    rc::check([] {
        const int degrees = *rc::gen::inRange(45, 67);
        const double slope = *rc::gen::inRange(5, 60) / 100.0;
        const SunDay north = sun_of(radians(degrees), *rc::gen::inRange(1, 366));
        const LocalHorizon open;
        // Ground that rises to the south faces north.
        const double poleward = sun_at(open, {0.0, 0.0, -slope}, north);
        const double sunny = sun_at(open, {0.0, 0.0, slope}, north);
        RC_ASSERT(poleward < sunny);
        RC_ASSERT(poleward < 1.0);
        const double light = light_at(open, {0.0, 0.0, -slope}, north);
        RC_ASSERT(light < 1.0 && light >= diffuse_share);
    });
}

TEST(Sun, OfTheSouthIsMirrored) {
    const LocalHorizon open;
    for (const int day : {20, 111}) {
        // The declination is a sine of the day: half a year later it has the other sign.
        const SunDay north = sun_of(0.8, day);
        SunDay south = north;
        for (SunPosition& one : south.positions) {
            one.north = -one.north;
            const double turned = horizon_azimuths / 2.0 - one.azimuth;
            one.azimuth = turned < 0.0 ? turned + horizon_azimuths : turned;
        }
        EXPECT_NEAR(sun_at(open, {0.0, 0.1, 0.3}, north), sun_at(open, {0.0, 0.1, -0.3}, south),
                    1e-12);
    }
}

TEST(Sun, IsHiddenBehindAWallInTheMorning) {
    LocalHorizon east;
    for (std::size_t azimuth = 1; azimuth < 9; ++azimuth) east.sines[azimuth] = 1.0;
    const SunDay sun = sun_of(berlin, 80);
    const double share = sun_at(east, {}, sun);
    // A little less than the afternoon: the wall is taken as linear from south to south-south-west.
    EXPECT_GT(share, 0.3);
    EXPECT_LT(share, 0.5);
    LocalHorizon all;
    all.sines.fill(1.0);
    all.sky = 0.0;
    EXPECT_EQ(sun_at(all, {}, sun), 0.0);
    EXPECT_EQ(light_at(all, {}, sun), 0.0);
}

TEST(Sun, IsNeverMoreWhereTheHorizonIsHigher) {
    rc::check([] {
        LocalHorizon low, high;
        for (std::size_t azimuth = 0; azimuth < horizon_azimuths; ++azimuth) {
            low.sines[azimuth] = *rc::gen::inRange(0, 50) / 100.0;
            high.sines[azimuth] = low.sines[azimuth] + *rc::gen::inRange(0, 50) / 100.0;
        }
        const Place slope{0.0, *rc::gen::inRange(-50, 50) / 100.0,
                          *rc::gen::inRange(-50, 50) / 100.0};
        const SunDay sun = sun_of(berlin, *rc::gen::inRange(1, 366));
        RC_ASSERT(sun_at(high, slope, sun) <= sun_at(low, slope, sun));
    });
}

}  // namespace
}  // namespace sporeprint::horizon_test
