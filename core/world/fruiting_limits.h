// Why a species fruits or does not fruit at a place.
#pragma once

#include <array>
#include <cstddef>

#include "core/world/season.h"

namespace sporeprint {

/// The conditions of fruiting.
enum class Condition {
    establishment,
    substrate,
    light,
    wetness,
    acidity,
    mycelium,
    temperature,
    rain,
    moisture,
    month,
    cold
};

inline constexpr std::size_t condition_count = 11;

constexpr const char* name(Condition condition) {
    constexpr std::array<const char*, condition_count> names{
        "establishment", "substrate", "light",    "wetness", "acidity", "mycelium",
        "temperature",   "rain",      "moisture", "month",   "cold"};
    return names[static_cast<std::size_t>(condition)];
}

/// How far each condition allows a species to fruit at a place on a day, 0..1 each.
struct Limits {
    std::array<double, condition_count> values{};
    [[nodiscard]] double operator[](Condition condition) const {
        return values[static_cast<std::size_t>(condition)];
    }
    /// Returns the condition that limits it most; of equal ones the first.
    [[nodiscard]] Condition limiting() const;
};

/// Returns why a species fruits or does not fruit at a place.
///
/// day  1 to 365, of the year of `input`
[[nodiscard]] Limits limits_at(const Fungi& fungi, const RegionYear& input,
                               const SeasonConditions& conditions, std::size_t species,
                               WorldPoint place, int day);

}  // namespace sporeprint
