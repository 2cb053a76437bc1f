// When a mycelium fruits, how many bodies come at once, and how long they stay: what is the same wherever fungi grow.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/model/ecology.h"
#include "core/world/cell_random.h"
#include "core/world/fruiting_weather.h"
#include "core/world/records.h"

namespace sporeprint {

/// Share of good days that a mycelium needs per day, and the days between two flushes.
inline constexpr double flush_rate = 0.12;
inline constexpr int rest_days = 14;
inline constexpr int most_flushes = 8;

/// Less than this allows nothing: without rain, nothing fruits.
inline constexpr double least_gate = 0.02;

/// Bodies of a flush emerge within so many days.
inline constexpr double emergence_days = 2.0;

/// Numbers of at least one: one more than those of a Poisson distribution.
class AtLeastOne {
  public:
    AtLeastOne() = default;
    explicit AtLeastOne(double mean)
        : more_(std::max(0.0, mean - 1.0)), none_(exponential(-more_)) {}
    /// Returns the number of a draw, 0 <= draw < 1.
    [[nodiscard]] int operator()(double draw) const { return 1 + poisson(more_, none_, draw, 299); }

  private:
    double more_ = 0.0, none_ = 1.0;
};

/// A day on which the weather allows a species to fruit.
struct GoodDay {
    int day;  ///< 0 to 364
    double gate, soil_water;
};

/// Returns the days of a year on which the weather allows a species to fruit.
[[nodiscard]] inline std::vector<GoodDay> good_days_of(const SeasonConditions& conditions,
                                                       std::size_t species) {
    std::vector<GoodDay> days;
    for (int day = 0; day < days_of_year; ++day) {
        const auto i = static_cast<std::size_t>(day);
        const double gate = conditions.species[species][i].all();
        if (gate >= least_gate) days.push_back({day, gate, conditions.soil_water[i]});
    }
    return days;
}

/// Returns the days, 0 to 364, on which a mycelium begins to fruit: as soon as it has had enough good days, and again
/// two weeks later at the earliest.
///
/// seed      of the world
/// moisture  returns how far the wetness of the mycelium's place allows it to fruit on a good day, 0..1
template <class Days, class Moisture>
[[nodiscard]] std::vector<int> flush_days(std::uint32_t seed, int year, const Genet& genet,
                                          const Days& good_days, const Moisture& moisture) {
    std::vector<int> days;
    CellRandom random(seed, purposes::flushes, static_cast<std::uint32_t>(year), genet.id);
    const double first = random.uniform();
    double needed = -logarithm(1.0 - first), sum = 0.0;
    int rested = 0;
    for (const GoodDay& good : good_days) {
        if (good.day < rested || !genet.lives_at(time_of(year, good.day + 1))) continue;
        const double gate = good.gate * moisture(good);
        if (gate < least_gate) continue;
        sum += flush_rate * gate;
        if (sum < needed) continue;
        days.push_back(good.day);
        if (days.size() == most_flushes) break;
        const double next = random.uniform();
        needed = -logarithm(1.0 - next);
        sum = 0.0;
        rested = good.day + rest_days;
    }
    return days;
}

/// Returns the number of a flush, which no other one of any year has.
[[nodiscard]] constexpr std::uint32_t flush_number(int year, std::size_t flush) {
    return static_cast<std::uint32_t>(year) * 16U + static_cast<std::uint32_t>(flush) + 1U;
}

/// Calls place(appears, random) for each cluster of a flush that appears at an abundance: with the abundance from which
/// on it is there, and its own draws.
///
/// bodies  their mean number in the flush
/// key     of what the clusters belong to, as the id of a mycelium
template <class Place>
void for_clusters(std::uint32_t seed, const FruitHabit& fruit, double bodies, double abundance,
                  std::uint64_t key, std::uint32_t flush, const Place& place) {
    const double mean = bodies / (fruit.clusters * fruit.tufts);
    if (!(mean > 0.0)) return;
    CellRandom random(seed, purposes::fruit_places, flush, key);
    double appears = 0.0;
    constexpr std::uint32_t most = 20000;
    for (std::uint32_t i = 0; i < most; ++i) {
        const double wait = random.uniform();
        appears += -logarithm(1.0 - wait) / mean;
        if (appears > abundance) return;
        place(appears, CellRandom(seed, purposes::fruit_places, i + 1, mixed(key, flush, 1)));
    }
}

/// Returns days as ticks.
[[nodiscard]] inline WorldTime ticks_of_days(double days) {
    return static_cast<WorldTime>(std::floor(days * ticks_of_day + 0.5));
}

/// Sets the times of a body that belongs to a flush.
///
/// end  of the year
inline void set_times(FruitBody& body, const BodyLife& life, WorldTime flush, WorldTime end,
                      CellRandom& random) {
    const double wait = random.uniform(), growth = random.uniform(), rest = random.uniform();
    body.emerged = flush + ticks_of_days(2.0 * emergence_days * wait);
    // So that the year of its flush is the year of a body.
    if (!life.perennial) body.emerged = std::min(body.emerged, end - 1);
    body.matured =
        body.emerged + std::max(1, ticks_of_days(life.days_to_mature * (0.8 + 0.4 * growth)));
    body.gone = body.matured + std::max(1, ticks_of_days(life.days_alive * (0.7 + 0.6 * rest)));
    if (!life.perennial) body.gone = std::min(body.gone, body.emerged + ticks_of_year);
    body.matured = std::min(body.matured, body.gone - 1);
}

}  // namespace sporeprint
