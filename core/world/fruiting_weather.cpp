#include "core/world/fruiting_weather.h"

#include <algorithm>
#include <cmath>

#include "core/math/elementary.h"

namespace sporeprint {

namespace {

/// Rain is that of so many days; half of the bodies come at so many mm of it.
constexpr double days_of_rain = 12.0, half_rain = 20.0, rain_width = 5.0;

/// Wetness at which half of the bodies come.
constexpr double half_wetness = 0.5, wetness_width = 0.07;

/// Nights are colder than the mean of the day by this much, K. Below this temperature three nights in a row stop
/// species that tolerate no frost; others tolerate as much more as they tolerate frost.
constexpr double colder_nights = 4.0, cold_night = 5.5;
constexpr int cold_nights = 3;

/// Days before and after the months of fruiting.
constexpr double soft_days = 10.0;

double logistic(double x) { return 1.0 / (1.0 + exponential(-x)); }

/// Returns for each day of a year how far the months allow a species to fruit.
std::array<double, days_of_year> month_gate(std::uint16_t months) {
    std::array<double, days_of_year> gate{};
    if ((months & 0xFFFU) == 0) {
        gate.fill(1.0);
        return gate;
    }
    std::array<bool, days_of_year> fruits{};
    std::size_t day = 0;
    for (std::size_t month = 0; month < days_of_months.size(); ++month)
        for (int i = 0; i < days_of_months[month]; ++i) fruits[day++] = (months >> month & 1U) != 0;
    constexpr auto reach = static_cast<int>(soft_days);
    for (int d = 0; d < days_of_year; ++d)
        for (int shift = -reach; shift <= reach; ++shift) {
            const int other = (d + shift + days_of_year) % days_of_year;
            if (!fruits[static_cast<std::size_t>(other)]) continue;
            double& value = gate[static_cast<std::size_t>(d)];
            value = std::max(value, 1.0 - std::abs(shift) / soft_days);
        }
    return gate;
}

/// Two years of weather, counted from the first day of the second one.
class WeatherBefore {
  public:
    WeatherBefore(const WeatherYear& before, const WeatherYear& year)
        : before_(before), year_(year) {}
    const WeatherDay& operator[](int day) const {
        return day >= 0 ? year_[static_cast<std::size_t>(day)]
                        : before_[static_cast<std::size_t>(day + days_of_year)];
    }

  private:
    const WeatherYear &before_, &year_;
};

/// Returns the weights of the rain of the days before, the nearest first: a gamma distribution of shape 3. Their sum is
/// days_of_rain.
std::vector<double> rain_weights(int memory) {
    std::vector<double> weights;
    weights.reserve(static_cast<std::size_t>(4 * memory));
    double sum = 0.0;
    for (int day = 0; day < 4 * memory; ++day) {
        const double time = (day + 0.5) / memory;
        weights.push_back(time * time * exponential(-3.0 * time));
        sum += weights.back();
    }
    for (double& weight : weights) weight *= days_of_rain / sum;
    return weights;
}

}  // namespace

double moisture_gate(double wetness) { return logistic((wetness - half_wetness) / wetness_width); }

SeasonConditions conditions_of(std::span<const FungusSpecies> species, const WeatherYear& before,
                               const WeatherYear& year) {
    const WeatherBefore weather(before, year);
    SeasonConditions out;
    out.species.resize(species.size());
    for (std::size_t i = 0; i < species.size(); ++i) {
        const Ecology& ecology = species[i].ecology;
        const std::array<double, days_of_year> months = month_gate(species[i].months);
        const std::vector<double> weights = rain_weights(ecology.fruit.rain_memory);
        const double cold =
            colder_nights + cold_night + std::min(0.0, ecology.temperature.tolerates.from);
        for (int day = 0; day < days_of_year; ++day) {
            FruitingDay& gate = out.species[i][static_cast<std::size_t>(day)];
            gate.month = months[static_cast<std::size_t>(day)];
            double mean = 0.0;
            for (int back = 0; back < 5; ++back) mean += weather[day - back].temperature;
            gate.temperature = ecology.temperature.at(mean / 5.0);
            bool is_cold = true;
            for (int back = 0; back < cold_nights; ++back)
                is_cold = is_cold && weather[day - back].temperature < cold;
            gate.cold = is_cold ? 0.0 : 1.0;
            double rain = 0.0;
            int back = 0;
            for (const double weight : weights) rain += weight * weather[day - back++].rain;
            gate.rain = logistic((rain - half_rain) / rain_width);
        }
    }
    for (std::size_t day = 0; day < year.size(); ++day) out.soil_water[day] = year[day].soil_water;
    return out;
}

}  // namespace sporeprint
