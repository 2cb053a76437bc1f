#include "core/world/weather.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/problems.h"
#include "core/world/soil_water.h"

namespace sporeprint {

namespace {

/// Correlation of wet days with the day before.
constexpr double persistence = 0.3;

/// A wet day brings `scale` (-ln u)^(1 / 0.8), whose mean is 1.133 times the scale: the gamma function of 2.25.
constexpr double weibull_exponent = 1.25, weibull_mean = 1.1330030963193471;

/// Deviation of daily temperatures from the cosine of the year: standard deviation in K, and correlation with the day
/// before.
constexpr double temperature_deviation = 3.0, temperature_memory = 0.7;

/// The warmest day of the north; that of the south is half a year later.
constexpr double warmest_day = 197.0;

/// Share of the rain that reaches the ground below crowns.
constexpr double throughfall = 0.8;

/// Draws of one day, which depend on nothing but the world and the day.
struct DayDraws {
    double is_wet, amount, warmth;
};

DayDraws draws_of(std::uint32_t seed, int year, int day) {
    // Days of the year before the first one have objects too.
    Random random(seed, purposes::weather, static_cast<std::uint32_t>((year + 1) * 366 + day));
    DayDraws draws{};
    draws.is_wet = random.uniform();
    draws.amount = random.uniform();
    draws.warmth = random.normal();
    return draws;
}

/// The weather from one day to the next.
class Weather {
  public:
    Weather(const ClimateParams& climate, std::uint32_t seed)
        : climate_(climate),
          seed_(seed),
          latitude_(radians(climate.latitude_deg)),
          warmest_(climate.latitude_deg < 0.0 ? warmest_day + 0.5 * days_of_year : warmest_day),
          rain_scale_(climate.rain / (days_of_year * climate.rain_days * weibull_mean)),
          soil_water_(0.5 * most_soil_water) {}

    /// Goes on to a day, 1 to 365.
    WeatherDay next(int year, int day) {
        const DayDraws draws = draws_of(seed_, year, day);
        WeatherDay out;
        const double share = climate_.rain_days;
        is_wet_ = draws.is_wet < share * (1.0 - persistence) + (is_wet_ ? persistence : 0.0);
        if (is_wet_)
            // The draw is below 1 and may be 0, where the logarithm ends.
            out.rain = rain_scale_ * power(-logarithm(1.0 - draws.amount), weibull_exponent);
        deviation_ = temperature_memory * deviation_ +
                     temperature_deviation *
                         std::sqrt(1.0 - temperature_memory * temperature_memory) * draws.warmth;
        out.temperature = climate_.temperature +
                          climate_.swing * cosine(2.0 * pi * (day - warmest_) / days_of_year) +
                          deviation_;
        out.evaporation = potential_evaporation(out.temperature, day);
        soil_water_ = soil_water_after(soil_water_, throughfall * out.rain, out.evaporation);
        out.soil_water = soil_water_;
        return out;
    }

  private:
    /// Returns the evaporation of a day, mm [Oudin2005].
    [[nodiscard]] double potential_evaporation(double temperature, int day) const {
        constexpr double heat_of_vaporisation = 2.45;  // MJ/kg, and a kilogram is a millimetre
        return sun_above_air(latitude_, day) / heat_of_vaporisation *
               std::max(0.0, temperature + 5.0) / 100.0;
    }

    ClimateParams climate_;
    std::uint32_t seed_;
    double latitude_, warmest_, rain_scale_;
    bool is_wet_ = false;
    double deviation_ = 0.0, soil_water_;
};

}  // namespace

namespace {

/// Returns the cosine of the hour angle of sunset.
double sunset_cosine(const SineCosine& latitude, const SineCosine& declination) {
    return std::clamp(-(latitude.sine / latitude.cosine) * (declination.sine / declination.cosine),
                      -1.0, 1.0);
}

double hour_angle_of(double cosine) {
    return arc_tangent(std::sqrt(1.0 - cosine * cosine), cosine);
}

}  // namespace

double sun_declination(int day) { return 0.409 * sine(2.0 * pi * day / days_of_year - 1.39); }

double sunset_hour_angle(double latitude, double declination) {
    return hour_angle_of(sunset_cosine(sine_cosine(latitude), sine_cosine(declination)));
}

double sun_above_air(double latitude, int day) {
    constexpr double solar_constant = 0.0820;  // MJ per square metre and minute
    const double angle = 2.0 * pi * day / days_of_year;
    const double distance = 1.0 + 0.033 * cosine(angle);
    const SineCosine place = sine_cosine(latitude), sun = sine_cosine(sun_declination(day));
    const double sunset = sunset_cosine(place, sun);
    return 24.0 * 60.0 / pi * solar_constant * distance *
           (hour_angle_of(sunset) * place.sine * sun.sine +
            place.cosine * sun.cosine * std::sqrt(1.0 - sunset * sunset));
}

WeatherYear weather_of(const ClimateParams& climate, std::uint32_t seed, int year) {
    if (year < 0 || year > last_year)
        throw InvalidInput(
            "year", std::to_string(year) + " is not a year of 0 to " + std::to_string(last_year));
    Weather weather(climate, seed);
    // After a summer, the water in the soil no longer depends on how much there was before it.
    for (int day = 1; day <= days_of_year; ++day) static_cast<void>(weather.next(year - 1, day));
    WeatherYear out{};
    for (int day = 1; day <= days_of_year; ++day)
        out[static_cast<std::size_t>(day - 1)] = weather.next(year, day);
    return out;
}

}  // namespace sporeprint
