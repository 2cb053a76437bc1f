// The records of a world: what stands or lies at a place from one moment to another. Whatever a world shows at a time is
// a choice among records, never a step from the time before.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "core/math/random.h"

namespace sporeprint {

/// A moment of a world: sixteenths of a day since the 1st of January of year 0, negative before it.
using WorldTime = std::int32_t;

inline constexpr WorldTime ticks_of_day = 16, ticks_of_year = 365 * ticks_of_day;

/// Returns the beginning of a day, 1 to 365, of a year.
[[nodiscard]] constexpr WorldTime time_of(int year, int day = 1) {
    return year * ticks_of_year + (day - 1) * ticks_of_day;
}

/// Returns the years between two moments.
[[nodiscard]] constexpr double years_between(WorldTime from, WorldTime to) {
    return static_cast<double>(to - from) / ticks_of_year;
}

/// A place in the plane of a world, in units of 2^-16 m: x to the east and y to the north of its centre.
struct WorldPoint {
    std::int32_t x = 0, y = 0;
    auto operator<=>(const WorldPoint&) const = default;
};

inline constexpr std::int32_t units_of_metre = 65536;

[[nodiscard]] constexpr double metres(std::int32_t units) {
    return static_cast<double>(units) / units_of_metre;
}

/// Returns the place at so many metres to the east and north, rounded down to units.
[[nodiscard]] inline WorldPoint point_at(double x, double y) {
    return {static_cast<std::int32_t>(std::floor(x * units_of_metre)),
            static_cast<std::int32_t>(std::floor(y * units_of_metre))};
}

/// A world is computed by squares of this side, metres: nothing in one depends on what is further away than its eight
/// neighbours.
inline constexpr int block_side = 64;

/// Returns the block of a place: blocks include their southern and western borders.
[[nodiscard]] constexpr CellIndex block_at(WorldPoint place) {
    constexpr int bits = 22;  // 64 m in units of 2^-16 m
    return {place.x >> bits, place.y >> bits};
}

/// Years for which the mycelia of a block are computed at once.
inline constexpr int epoch_years = 40;

/// Returns the epoch of a year from 0 on.
[[nodiscard]] constexpr int epoch_of(int year) { return year / epoch_years; }

/// A living tree. `tree_growth.h` says how large it is at a moment.
struct StandTree {
    std::uint64_t id = 0;
    WorldPoint at;
    WorldTime born = 0, died = 0;
    std::uint8_t kind = 0;  ///< which of the kinds of its stand
    double height = 0.0;    ///< in old age, metres
    bool by_storm = false;  ///< it died in a storm
    [[nodiscard]] bool lives_at(WorldTime time) const { return born <= time && time < died; }
    bool operator==(const StandTree&) const = default;
};

/// A trunk that is dead: a snag until it falls, then a log.
struct DeadWood {
    std::uint64_t id = 0;
    std::uint64_t tree = 0;  ///< id of the tree that it was
    WorldPoint at;           ///< its foot
    WorldTime died = 0, fell = 0, gone = 0;
    std::uint8_t kind = 0;   ///< which of the kinds of the stand
    double direction = 0.0;  ///< in which it lies, radians from east to north
    double length = 0.0;     ///< when it died, metres; length_at() says how much is left
    double radius = 0.0;     ///< at the foot, when it died, metres; the top has a fifth of that
    double decay = 0.0;      ///< k of its mass e^(-k t), per year
    [[nodiscard]] bool stands_at(WorldTime time) const { return died <= time && time < fell; }
    [[nodiscard]] bool lies_at(WorldTime time) const { return fell <= time && time < gone; }
    bool operator==(const DeadWood&) const = default;
};

/// A mycelium: a cone in space and time whose margin advances at one speed from its birth on.
struct Genet {
    std::uint64_t id = 0;
    WorldPoint centre;
    WorldTime born = 0, died = 0;
    std::uint8_t species = 0;  ///< which of the species of the world
    double speed = 0.0;        ///< metres per year
    double reach = 0.0;        ///< greatest radius, metres
    std::uint64_t host = 0;    ///< id of the tree or the dead trunk that it lives on, 0 if none
    [[nodiscard]] bool lives_at(WorldTime time) const { return born <= time && time < died; }
    bool operator==(const Genet&) const = default;
};

/// A fruit body.
struct FruitBody {
    std::uint64_t id = 0;
    WorldPoint at;
    WorldTime emerged = 0, matured = 0, gone = 0;
    std::uint8_t species = 0;  ///< which of the species of the world
    std::uint64_t genet = 0;   ///< id of its mycelium
    std::uint64_t host = 0;    ///< that of the mycelium (Genet), 0 if none
    std::uint64_t trunk = 0;   ///< id of the tree or dead trunk that it grows on, 0 on the ground
    double height = 0.0;       ///< above the ground, metres
    double facing = 0.0;       ///< on wood: direction away from it, radians from east to north
    double pitch = 0.0;        ///< on wood: of that direction above the level, radians
    /// The seed of the mushroom that it is.
    [[nodiscard]] std::uint32_t seed() const { return static_cast<std::uint32_t>(id); }
    [[nodiscard]] bool stands_at(WorldTime time) const { return emerged <= time && time < gone; }
    bool operator==(const FruitBody&) const = default;
};

}  // namespace sporeprint
