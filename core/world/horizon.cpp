#include "core/world/horizon.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/math/elementary.h"
#include "core/problems.h"
#include "core/world/drainage.h"
#include "core/world/weather.h"

namespace sporeprint {

namespace {

constexpr std::size_t samples = 18;

/// Ratio of the distances of two samples, and the cells that the farthest one may be away: 1.3^17 = 86.5.
constexpr double distance_ratio = 1.3;
constexpr int farthest = 87;

/// Height in which the sun sinks, as a sine.
constexpr double sun_height = 0.035;

/// Heights in metres on every second node, with a margin that is as high as the border.
struct PaddedHeights {
    int side = 0;
    std::ptrdiff_t stride = 0;
    std::vector<float> metres;

    [[nodiscard]] const float* row(int number) const {
        return &metres[static_cast<std::size_t>((number + farthest + 1) * stride + farthest + 1)];
    }
};

PaddedHeights padded(const Grid& grid, std::span<const std::int32_t> heights) {
    PaddedHeights out;
    out.side = (grid.side + 1) / 2;
    out.stride = out.side + 2 * (farthest + 1);
    out.metres.reserve(static_cast<std::size_t>(out.stride * out.stride));
    const auto node = [&](std::ptrdiff_t number) {
        return 2 * std::clamp(static_cast<int>(number) - farthest - 1, 0, out.side - 1);
    };
    for (std::ptrdiff_t row = 0; row < out.stride; ++row)
        for (std::ptrdiff_t column = 0; column < out.stride; ++column)
            out.metres.push_back(static_cast<float>(heights[grid.index(node(column), node(row))]) *
                                 (1.0F / height_units));
    return out;
}

/// A place relative to a node: the node to its south-west, and weights of that and its neighbours.
struct Sample {
    std::ptrdiff_t offset = 0;
    float south_west = 0.0F, south_east = 0.0F, north_west = 0.0F, north_east = 0.0F;
    float per_metre = 0.0F;
};

Sample sample_at(std::size_t azimuth, double cells, double cell, std::ptrdiff_t stride) {
    const auto [east, north] =
        sine_cosine(2.0 * pi * static_cast<double>(azimuth) / horizon_azimuths);
    // Along rows and columns, rounding must not lead across a node.
    const double x = std::floor(east * cells * 1024.0 + 0.5) / 1024.0;
    const double y = std::floor(north * cells * 1024.0 + 0.5) / 1024.0;
    const double column = std::floor(x), row = std::floor(y), t = x - column, u = y - row;
    Sample out;
    out.offset = static_cast<std::ptrdiff_t>(row) * stride + static_cast<std::ptrdiff_t>(column);
    out.south_west = static_cast<float>((1.0 - t) * (1.0 - u));
    out.south_east = static_cast<float>(t * (1.0 - u));
    out.north_west = static_cast<float>((1.0 - t) * u);
    out.north_east = static_cast<float>(t * u);
    out.per_metre = static_cast<float>(1.0 / (std::sqrt(x * x + y * y) * cell));
    return out;
}

/// The nodes round a place, and their weights per unit of what is stored.
struct Corners {
    Corners(const Grid& grid, double x, double y) {
        const auto along = [&](double metres) {
            return std::clamp((metres - grid.origin) / grid.cell, 0.0, grid.side - 1.0);
        };
        const double column = along(x), row = along(y);
        const int i = std::min(static_cast<int>(column), grid.side - 2);
        const int j = std::min(static_cast<int>(row), grid.side - 2);
        const double t = column - i, u = row - j;
        const std::size_t south = grid.index(i, j), north = grid.index(i, j + 1);
        weights = {(1.0 - t) * (1.0 - u) / 255.0, t * (1.0 - u) / 255.0, (1.0 - t) * u / 255.0,
                   t * u / 255.0};
        nodes = {south, south + 1, north, north + 1};
    }
    [[nodiscard]] double sky(const Horizon& horizon) const {
        double sum = 0.0;
        for (std::size_t k = 0; k < nodes.size(); ++k) sum += weights[k] * horizon.sky[nodes[k]];
        return std::min(1.0, sum);
    }

    std::array<double, 4> weights{};
    std::array<std::size_t, 4> nodes{};
};

/// Returns the share of the sun that is above a horizon; both are sines of heights.
double visible_share(double sun, double horizon) {
    return std::clamp((sun - horizon) / sun_height, 0.0, 1.0);
}

std::uint8_t quantised_share(double share) {
    return static_cast<std::uint8_t>(std::clamp(std::floor(share * 255.0 + 0.5), 0.0, 255.0));
}

}  // namespace

std::size_t Horizon::bytes() const {
    return sizeof(*this) + sines.size() * sizeof(sines[0]) + sky.size();
}

Horizon horizon_of(const Grid& grid, std::span<const std::int32_t> heights,
                   const Parallel& parallel) {
    require_values(grid, heights.size());
    if (grid.side < 5 || grid.side % 2 == 0)
        throw InvalidInput("", "a horizon needs an odd number of nodes a side, at least 5");
    const PaddedHeights ground = padded(grid, heights);
    Horizon out;
    out.grid = {ground.side, 2.0 * grid.cell, grid.origin};
    out.sines.resize(out.grid.nodes());
    out.sky.resize(out.grid.nodes());
    const auto side = static_cast<std::size_t>(ground.side);
    std::array<std::array<Sample, samples>, horizon_azimuths> around{};
    for (std::size_t azimuth = 0; azimuth < horizon_azimuths; ++azimuth) {
        double cells = 1.0;
        for (Sample& sample : around[azimuth]) {
            sample = sample_at(azimuth, cells, out.grid.cell, ground.stride);
            cells *= distance_ratio;
        }
    }
    const auto set_row = [&](int row) {
        std::vector<float> rise(side);
        std::vector<float> sums(side);
        const float* const here = ground.row(row);
        const std::size_t first = out.grid.index(0, row);
        for (std::size_t azimuth = 0; azimuth < horizon_azimuths; ++azimuth) {
            std::fill(rise.begin(), rise.end(), 0.0F);
            for (const Sample& sample : around[azimuth]) {
                const float* const south = here + sample.offset;
                const float* const north = south + ground.stride;
                for (std::size_t i = 0; i < side; ++i) {
                    const float height =
                        sample.south_west * south[i] + sample.south_east * south[i + 1] +
                        sample.north_west * north[i] + sample.north_east * north[i + 1];
                    rise[i] = std::max(rise[i], (height - here[i]) * sample.per_metre);
                }
            }
            for (std::size_t i = 0; i < side; ++i) {
                const float sine = rise[i] / std::sqrt(1.0F + rise[i] * rise[i]);
                sums[i] += sine;
                out.sines[first + i][azimuth] = static_cast<std::uint8_t>(sine * 255.0F + 0.5F);
            }
        }
        for (std::size_t i = 0; i < side; ++i)
            out.sky[first + i] =
                quantised_share(1.0 - static_cast<double>(sums[i]) / horizon_azimuths);
    };
    constexpr int stripe = 16;
    std::vector<std::function<void()>> tasks;
    for (int first = 0; first < ground.side; first += stripe)
        tasks.emplace_back([&, first] {
            for (int row = first; row < std::min(first + stripe, ground.side); ++row) set_row(row);
        });
    parallel(tasks);
    return out;
}

LocalHorizon horizon_at(const Horizon& horizon, double x, double y) {
    const Corners corners(horizon.grid, x, y);
    LocalHorizon out;
    for (std::size_t k = 0; k < corners.nodes.size(); ++k)
        for (std::size_t azimuth = 0; azimuth < horizon_azimuths; ++azimuth)
            out.sines[azimuth] += corners.weights[k] * horizon.sines[corners.nodes[k]][azimuth];
    out.sky = corners.sky(horizon);
    return out;
}

double sky_at(const Horizon& horizon, double x, double y) {
    return Corners(horizon.grid, x, y).sky(horizon);
}

SunDay sun_of(double latitude, int day) {
    constexpr double transmittance = 0.7;
    const double declination = sun_declination(day);
    const double sunset = sunset_hour_angle(latitude, declination);
    const SineCosine place = sine_cosine(latitude), sun = sine_cosine(declination);
    SunDay out;
    const auto moments = static_cast<double>(out.positions.size());
    for (std::size_t i = 0; i < out.positions.size(); ++i) {
        const double hour = sunset * (2.0 * (static_cast<double>(i) + 0.5) / moments - 1.0);
        const auto [sine_hour, cosine_hour] = sine_cosine(hour);
        SunPosition& one = out.positions[i];
        one.up = place.sine * sun.sine + place.cosine * sun.cosine * cosine_hour;
        one.north = place.cosine * sun.sine - place.sine * sun.cosine * cosine_hour;
        one.east = -sun.cosine * sine_hour;
        const double azimuth = arc_tangent(one.east, one.north) * (horizon_azimuths / (2.0 * pi));
        one.azimuth = azimuth < 0.0 ? azimuth + horizon_azimuths : azimuth;
        // The path through the air is that through a level layer. Lower suns have no light.
        if (one.up > 1e-3) one.strength = power(transmittance, 1.0 / one.up);
        out.level += visible_share(one.up, 0.0) * one.strength * one.up;
    }
    return out;
}

double sun_at(const LocalHorizon& horizon, const Place& place, const SunDay& sun) {
    const double length = std::sqrt(1.0 + place.east * place.east + place.north * place.north);
    double sum = 0.0;
    for (const SunPosition& one : sun.positions) {
        const double facing = (one.up - place.east * one.east - place.north * one.north) / length;
        if (facing <= 0.0 || one.strength <= 0.0) continue;
        const auto below = std::min(static_cast<std::size_t>(one.azimuth), horizon_azimuths - 1);
        const double t = one.azimuth - static_cast<double>(below);
        const double height =
            horizon.sines[below] * (1.0 - t) + horizon.sines[(below + 1) % horizon_azimuths] * t;
        sum += visible_share(one.up, height) * one.strength * facing;
    }
    return sun.level > 0.0 ? sum / sun.level : 0.0;
}

double light_at(const LocalHorizon& horizon, const Place& place, const SunDay& sun) {
    const double direct = sun_at(horizon, place, sun);
    return std::min(1.0, diffuse_share * horizon.sky + (1.0 - diffuse_share) * direct);
}

}  // namespace sporeprint
