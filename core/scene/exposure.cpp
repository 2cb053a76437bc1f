#include "core/scene/exposure.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

/// Rays begin this far above the surface, metres, and end nowhere in a scene.
constexpr double above = 1e-3, endless = 1e6;

/// Height of the wind that drives the rain, and of the grass below it, metres.
constexpr double rain_height = 2.0, grass_height = 0.15;

/// Below the ground no more of the sky is seen than this, beyond the rim of the scene.
constexpr float most_sky_below = 0.2F;

/// Directions of the rain in each sector of the wind.
constexpr int rains_of_sector = 2;

constexpr std::size_t stripe = 1024;

/// Calls value(i) for each surfel and returns what it returns.
template <class ValueOf>
std::vector<float> values_of(const Surfels& surfels, const Parallel& parallel,
                             const ValueOf& value) {
    std::vector<float> out(surfels.size());
    std::vector<std::function<void()>> tasks;
    for (std::size_t first = 0; first < out.size(); first += stripe)
        tasks.emplace_back([&, first] {
            for (std::size_t i = first; i < std::min(first + stripe, out.size()); ++i)
                out[i] = static_cast<float>(value(i));
        });
    parallel(tasks);
    return out;
}

glm::dvec3 start_of(const Surfel& surfel) {
    return glm::dvec3(surfel.at) + above * glm::dvec3(surfel.normal);
}

/// The directions by which surfels look for the sky: x and z in the plane, y along the normal.
struct SkyDirections {
    std::array<glm::dvec3, sky_rays> all{};

    SkyDirections() {
        // Equal areas of the disk below the hemisphere, whose heights follow the cosine law.
        for (std::size_t i = 0; i < sky_rays; ++i) {
            const double radius =
                std::sqrt((static_cast<double>(i) + 0.5) / static_cast<double>(sky_rays));
            const auto [sine, cosine] = sine_cosine(golden_angle * static_cast<double>(i));
            all[i] = {radius * cosine, std::sqrt(1.0 - radius * radius), radius * sine};
        }
    }
};

}  // namespace

std::vector<float> sky_of(const Surfels& surfels, const TriangleTree& tree, std::uint32_t seed,
                          const Parallel& parallel) {
    const SkyDirections directions;
    return values_of(surfels, parallel, [&](std::size_t i) {
        const Surfel& surfel = surfels[i];
        Random random(seed, purposes::scene_rays, static_cast<std::uint32_t>(i));
        const double turn = random.uniform();
        const glm::dvec3 normal(surfel.normal);
        const glm::dvec3 across = square_to(normal, {1.0, 0.0, 0.0});
        const glm::dvec3 right = turned_square(across, normal, 2.0 * pi * turn);
        const glm::dvec3 forward = glm::cross(normal, right);
        int open = 0;
        for (const glm::dvec3& one : directions.all) {
            const glm::dvec3 way = one.x * right + one.y * normal + one.z * forward;
            if (way.y > 0.0 && !tree.is_blocked(start_of(surfel), way, 0.0, endless)) ++open;
        }
        return static_cast<double>(open) / sky_rays;
    });
}

std::vector<std::uint8_t> buried_of(const Surfels& surfels, const TriangleTree& tree,
                                    const Scene& scene, const std::vector<float>& sky,
                                    const Parallel& parallel) {
    // Straight up and aslant: leaves that are single sheets may be passed from behind in some of these directions.
    constexpr int around = 5;
    std::vector<glm::dvec3> ways = {{0.0, 1.0, 0.0}};
    const auto [rise, level] = sine_cosine(pi / 3.0);
    for (int k = 0; k < around; ++k) {
        const auto [sine, cosine] = sine_cosine(2.0 * pi * k / around);
        ways.emplace_back(level * cosine, rise, level * sine);
    }
    const auto is_within = [&](const glm::dvec3& start, const glm::dvec3& way) {
        constexpr int most_passed = 64;
        int balance = 0;
        double from = 0.0;
        for (int passed = 0; passed < most_passed; ++passed) {
            const auto hit = tree.first_hit(start, way, from, endless);
            if (!hit) break;
            balance += glm::dot(normal_of(scene, hit->triangle), way) > 0.0 ? 1 : -1;
            from = hit->distance + above;
        }
        return balance > 0;
    };
    const std::vector<float> found = values_of(surfels, parallel, [&](std::size_t i) {
        if (sky[i] > most_sky_below) return 0.0;
        return std::ranges::all_of(
                   ways,
                   [&](const glm::dvec3& way) { return is_within(start_of(surfels[i]), way); })
                   ? 1.0
                   : 0.0;
    });
    std::vector<std::uint8_t> out;
    out.reserve(found.size());
    for (const float one : found) out.push_back(one > 0.0F ? 1 : 0);
    return out;
}

std::vector<float> sun_on(const Surfels& surfels, const TriangleTree& tree, const SunDay& sun,
                          const Parallel& parallel) {
    return values_of(surfels, parallel, [&](std::size_t i) {
        const Surfel& surfel = surfels[i];
        double sum = 0.0;
        for (const SunPosition& one : sun.positions) {
            if (one.up <= 0.0 || one.strength <= 0.0) continue;
            const glm::dvec3 way = scene_direction(one.east, one.up, one.north);
            const double facing = glm::dot(glm::dvec3(surfel.normal), way);
            if (facing > 0.0 && !tree.is_blocked(start_of(surfel), way, 0.0, endless))
                sum += one.strength * facing;
        }
        return sun.level > 0.0 ? sum / sun.level : 0.0;
    });
}

std::vector<float> rain_on(const Surfels& surfels, const TriangleTree& tree, const WindRose& rose,
                           std::uint32_t seed, const Parallel& parallel) {
    constexpr double width = 2.0 * pi / wind_sectors;
    return values_of(surfels, parallel, [&](std::size_t i) {
        const Surfel& surfel = surfels[i];
        Random random(seed, purposes::scene_rays, static_cast<std::uint32_t>(i), {1, 0});
        double sum = 0.0;
        for (const WindSector& sector : rose) {
            const double wind = wind_above_grass(sector.speed, rain_height, grass_height);
            for (int k = 0; k < rains_of_sector; ++k) {
                const double draw = random.uniform();
                const auto [sine, cosine] =
                    sine_cosine(width * ((k + draw) / rains_of_sector - 0.5));
                const double east = sector.east * cosine - sector.north * sine,
                             north = sector.north * cosine + sector.east * sine;
                // Towards where the rain comes from; its height is 1, so that level ground has a facing of 1.
                const glm::dvec3 way =
                    scene_direction(-east * wind / rain_fall, 1.0, -north * wind / rain_fall);
                const double facing = glm::dot(glm::dvec3(surfel.normal), way);
                if (facing > 0.0 && !tree.is_blocked(start_of(surfel), way, 0.0, endless))
                    sum += sector.share * facing / rains_of_sector;
            }
        }
        return sum;
    });
}

}  // namespace sporeprint
