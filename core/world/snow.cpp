#include "core/world/snow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/math/elementary.h"
#include "core/math/noise.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/world/records.h"
#include "core/world/weather.h"

namespace sporeprint {

namespace {

/// Temperatures of the day between which rain turns into snow, degrees Celsius, and water that melts for each degree
/// and day, mm.
constexpr double all_snow = -1.0, all_rain = 1.5, melting = 2.8;

/// Returns the day on which the snow of a winter begins at the earliest.
int first_day_of(const ClimateParams& climate) { return climate.latitude_deg < 0.0 ? 92 : 274; }

/// Water as snow that covers everything, mm.
constexpr double closed_cover = 7.0;

/// Lengths of the waves of the border of patches of snow, metres, and their weights.
constexpr std::array<double, 3> waves = {0.9, 0.23, 0.06};
constexpr std::array<float, 3> weights = {0.55F, 0.35F, 0.25F};

/// Colour of snow, sRGB, its normal, and its occlusion, roughness and metalness.
constexpr std::array<std::array<float, 3>, 3> snow = {
    {{236.0F, 240.0F, 246.0F}, {127.5F, 127.5F, 255.0F}, {255.0F, 165.0F, 0.0F}}};

/// Shares of the relief and of the shades of the floor that are seen through closed snow.
constexpr std::array<float, 3> through = {0.03F, 0.25F, 0.1F};

double snow_after(double before, const WeatherDay& day) {
    const double frozen = 1.0 - smooth_step(all_snow, all_rain, day.temperature);
    return std::max(0.0, before + day.rain * frozen - melting * std::max(day.temperature, 0.0));
}

/// The place round a tree where there is less snow.
struct SnowWell {
    double x, y;       ///< middle, metres
    double bare, end;  ///< distances to which there is none, and less, metres
};

std::vector<SnowWell> wells_of(std::span<const TreeFoot> feet) {
    std::vector<SnowWell> wells;
    wells.reserve(feet.size());
    for (const TreeFoot& foot : feet) {
        // Some trees shelter more of the ground than others, whatever their size.
        const WorldPoint at = point_at(foot.x, foot.y);
        const double draw = Random(0, purposes::floor_noise, 4, {at.x, at.y}).uniform();
        const double radius = 0.55 * foot.diameter;
        wells.push_back({foot.x, foot.y, radius - 0.2 * draw,
                         std::min(radius + 0.08 + (0.2 + 1.2 * draw) * foot.diameter, snow_well)});
    }
    return wells;
}

}  // namespace

double snow_on(const ClimateParams& climate, std::uint32_t seed, int year, int day) {
    const int first_day = first_day_of(climate);
    double water = 0.0;
    if (day < first_day && year > 0) {
        const WeatherYear before = weather_of(climate, seed, year - 1);
        for (auto i = static_cast<std::size_t>(first_day - 1); i < before.size(); ++i)
            water = snow_after(water, before[i]);
    }
    const WeatherYear now = weather_of(climate, seed, year);
    for (int i = day < first_day ? 0 : first_day - 1; i < day; ++i)
        water = snow_after(water, now[static_cast<std::size_t>(i)]);
    return water;
}

double snow_cover(double water) { return smooth_step(0.0, closed_cover, water); }

void add_snow(RawImages& images, const WorldBox& box, double cover, std::uint32_t seed,
              std::span<const TreeFoot> feet, const Parallel& parallel) {
    if (cover <= 0.0) return;
    Random random(seed, purposes::floor_noise, 3);
    std::array<std::uint32_t, waves.size()> seeds{};
    for (std::uint32_t& one : seeds) one = random.bits();
    const std::vector<SnowWell> wells = wells_of(feet);
    const auto side = static_cast<std::size_t>(images.side);
    const auto place = [&](double from, double to, std::size_t i) {
        const double t = static_cast<double>(i) / static_cast<double>(side - 1);
        // Rounded, so that a place has the same coordinates in neighbouring images.
        return std::floor(((1.0 - t) * from + t * to) * 65536.0 + 0.5) / 65536.0;
    };
    const auto paint = [&](std::size_t first, std::size_t last) {
        std::vector<float> u(side), v(side), noise(side), sum(side);
        std::vector<double> left(side);
        for (std::size_t row = first; row < last; ++row) {
            std::fill(sum.begin(), sum.end(), 0.0F);
            for (std::size_t k = 0; k < waves.size(); ++k) {
                const double north = place(box.north, box.south, row);
                std::fill(v.begin(), v.end(), static_cast<float>(north / waves[k]));
                for (std::size_t i = 0; i < side; ++i)
                    u[i] = static_cast<float>(place(box.west, box.east, i) / waves[k]);
                gradient_noise(u, v, seeds[k], noise);
                for (std::size_t i = 0; i < side; ++i) sum[i] += weights[k] * noise[i];
            }
            std::fill(left.begin(), left.end(), 1.0);
            for (const SnowWell& well : wells) {
                const double north = place(box.north, box.south, row) - well.y;
                if (std::abs(north) > well.end) continue;
                for (std::size_t i = 0; i < side; ++i) {
                    const double east = place(box.west, box.east, i) - well.x;
                    if (std::abs(east) < well.end)
                        left[i] *= smooth_step(well.bare, well.end,
                                               std::sqrt(east * east + north * north));
                }
            }
            for (std::size_t i = 0; i < side; ++i) {
                // Bare ground is close to the trunk, and most of a well is thin snow.
                left[i] = 1.0 - (1.0 - left[i]) * (1.0 - left[i]);
                const std::size_t texel = 3 * (row * side + i);
                // What is bright stands out of the floor, and is covered last.
                const float bright = static_cast<float>(images.rgb[0][texel + 1]) / 255.0F;
                // Towards a trunk it thins out.
                const double edge = 0.12 + 0.4 * (1.0 - left[i]);
                const auto own = static_cast<float>(
                    smooth_step(-edge, edge,
                                1.5 * cover * left[i] - 0.5 + 0.6 * static_cast<double>(sum[i]) -
                                    0.35 * static_cast<double>(bright)));
                for (std::size_t image = 0; image < snow.size(); ++image)
                    for (std::size_t c = 0; c < 3; ++c) {
                        std::uint8_t& value = images.rgb[image][texel + c];
                        const float share = own * (1.0F - through[image]);
                        value = static_cast<std::uint8_t>(
                            static_cast<float>(value) +
                            share * (snow[image][c] - static_cast<float>(value)) + 0.5F);
                    }
            }
        }
    };
    constexpr std::size_t rows = 64;
    std::vector<std::function<void()>> tasks;
    for (std::size_t first = 0; first < side; first += rows)
        tasks.emplace_back([&, first] { paint(first, std::min(first + rows, side)); });
    parallel(tasks);
}

}  // namespace sporeprint
