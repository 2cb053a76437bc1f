// How grass and herbs look through the year.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace sporeprint {

/// Grass and herbs of a day.
struct GrassSeason {
    double dry = 0.0;    ///< share of the blades that are withered
    double fresh = 1.0;  ///< brightness of the others: less in winter, more in May
    double herbs = 1.0;  ///< share of the herbs of midsummer that stand
};

/// Returns grass and herbs of a day of the northern year: linear between the middles of months, whose values were chosen
/// by eye from what meadows and woods of Central Europe look like.
///
/// day  1 to 365
[[nodiscard]] inline GrassSeason grass_on(int day) {
    constexpr std::size_t months = 12;
    constexpr std::array<double, months> dry = {0.56, 0.60, 0.50, 0.24, 0.08, 0.08,
                                                0.15, 0.24, 0.24, 0.28, 0.40, 0.50},
                                         fresh = {0.78, 0.78, 0.86, 1.06, 1.18, 1.08,
                                                  0.98, 0.92, 0.92, 0.90, 0.84, 0.80},
                                         herbs = {0.0, 0.0, 0.15, 0.6,  1.0,  1.0,
                                                  1.0, 0.9, 0.75, 0.45, 0.15, 0.0};
    const double at = (day - 15.5) / (365.0 / months) + static_cast<double>(months);
    const double whole = std::floor(at), part = at - whole;
    const auto month = static_cast<std::size_t>(whole) % months, next = (month + 1) % months;
    const auto between = [&](const std::array<double, months>& of) {
        return of[month] + (of[next] - of[month]) * part;
    };
    return {between(dry), between(fresh), between(herbs)};
}

}  // namespace sporeprint
