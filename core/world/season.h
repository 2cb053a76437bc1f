// The fruit bodies of a block of a world in a year: on which days mycelia fruit, how many bodies there are, and where.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/world/mycelia.h"
#include "core/world/records.h"
#include "core/world/weather.h"

namespace sporeprint {

/// How far the weather of a day allows a species to fruit, each 0..1.
struct FruitingDay {
    double temperature = 0.0;  ///< the mean of five days
    double rain = 0.0;   ///< of the days before, weighted by how long bodies take from rain on
    double month = 0.0;  ///< 1 in the months in which it fruits, 0 ten days before and after
    double cold = 0.0;   ///< 0 when the last three nights were cold
    [[nodiscard]] double all() const { return temperature * rain * month * cold; }
};

/// What the weather of a year means for all species, wherever they are.
struct SeasonConditions {
    std::vector<std::array<FruitingDay, days_of_year>> species;
    std::array<double, days_of_year> soil_water{};  ///< mean of the world, mm
};

/// Returns how the weather of a year allows species to fruit. Its constants were chosen by hand.
///
/// before  the weather of the year before, whose rain counts in January
/// cost    about 0.4 ms for 12 species
[[nodiscard]] SeasonConditions conditions_of(std::span<const FungusSpecies> species,
                                             const WeatherYear& before, const WeatherYear& year);

/// Returns how far the wetness of the ground, 0..1, allows fungi to fruit, 0..1: half at 0.5.
[[nodiscard]] double moisture_gate(double wetness);

/// What is needed of a block for the fruit bodies of a year.
struct BlockYear {
    CellIndex block;
    int year = 0;
    std::span<const Genet>
        genets;           ///< of the block and its eight neighbours, in the epoch of the year
    Surroundings around;  ///< of the same
};

/// Returns the fruit bodies in a block: those that emerge in a year, at the end of which some of them still stand, and
/// the brackets of perennial species that stand at some time of it. Sorted by id.
///
/// A mycelium fruits as soon as it has had enough good days, and again two weeks later at the earliest. Bodies stand in
/// tufts and these in clusters; on arcs of rings, or on bark. A body that is nearer to one of higher priority than the
/// two tolerate does not grow, whether or not the other one does, so that bodies farther away do not matter.
///
/// abundance  factor of the number of bodies, 0..10; with a higher one all bodies of a lower one stand where they did
/// cost       about 1 ms for 12 species
/// source     clusters of clusters: [Thomas1949]
[[nodiscard]] std::vector<FruitBody> season_of(const Fungi& fungi, const BlockYear& input,
                                               const SeasonConditions& conditions,
                                               double abundance);

/// Returns the age of a body, 0 to 1: 0.6 when it is mature, 1 when it is gone. Logistic until it is mature, then
/// linear; never decreasing.
[[nodiscard]] double age_at(const FruitBody& body, WorldTime time);

/// Returns how many bodies of each species stand at noon of each day of a year: [species][day].
[[nodiscard]] std::vector<std::array<std::uint32_t, days_of_year>> daily_counts(
    std::span<const FruitBody> bodies, std::size_t species, int year);

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
[[nodiscard]] Limits limits_at(const Fungi& fungi, const BlockYear& input,
                               const SeasonConditions& conditions, std::size_t species,
                               WorldPoint place, int day);

}  // namespace sporeprint
