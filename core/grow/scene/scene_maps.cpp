#include "core/grow/scene/scene_maps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <optional>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/world/horizon.h"
#include "core/world/weather.h"

namespace sporeprint {

namespace {

/// The surfels near a vertex are at most so many spacings away.
constexpr double near_spacings = 2.0;

/// Returns the middle of the month of a day, 1 to 365.
int middle_of_month(int day) {
    int first = 1;
    for (const int days : days_of_months) {
        if (day < first + days) return first + days / 2;
        first += days;
    }
    return day;
}

}  // namespace

std::vector<float> scene_map(const SceneFungi& fungi, const SceneMapChoice& choice,
                             const Parallel& parallel) {
    const SceneHabitat& habitat = *fungi.habitat;
    const SceneShape& shape = *habitat.shape;
    switch (choice.map) {
        case SceneMap::sky:
            return shape.sky;
        case SceneMap::rain:
            return habitat.rain;
        case SceneMap::water:
            return habitat.water;
        case SceneMap::probability:
            return scene_probability(fungi, choice.species, choice.year);
        case SceneMap::light: {
            const SunDay sun = sun_of(radians(habitat.conditions.climate.latitude_deg),
                                      middle_of_month(choice.day));
            std::vector<float> out = sun_on(shape.surfels, shape.tree, sun, parallel);
            for (std::size_t i = 0; i < out.size(); ++i)
                out[i] = static_cast<float>(
                    light_of(static_cast<double>(shape.sky[i]), static_cast<double>(out[i])));
            return out;
        }
        case SceneMap::wetness: {
            const SurfaceWater water = water_of(habitat.conditions, choice.year);
            std::vector<float> out(shape.surfels.size());
            for (std::size_t i = 0; i < out.size(); ++i)
                out[i] = static_cast<float>(
                    water.on(habitat.supply(i), static_cast<std::size_t>(choice.day - 1)) /
                    most_soil_water);
            return out;
        }
        case SceneMap::spores: {
            std::vector<float> out(shape.surfels.size());
            for (std::size_t i = 0; i < out.size(); ++i)
                out[i] = static_cast<float>(
                    fungi.establishment[choice.species].at(i, static_cast<double>(choice.year)));
            return out;
        }
    }
    return {};
}

std::vector<float> on_vertices(const SceneShape& shape, const std::vector<float>& values) {
    const Scene& scene = *shape.scene;
    const Surfels& surfels = shape.surfels;
    std::vector<glm::dvec3> normals(scene.positions.size(), glm::dvec3(0.0));
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i)
        for (const std::uint32_t corner : scene.triangles[i].corners)
            normals[corner] += normal_of(scene, i);
    const double reach = near_spacings * surfels.spacing();
    std::vector<float> out(scene.positions.size(), 0.0F);
    for (std::size_t vertex = 0; vertex < out.size(); ++vertex) {
        if (normals[vertex] == glm::dvec3(0.0)) continue;
        const glm::dvec3 at(scene.positions[vertex]);
        const glm::dvec3 normal = unit_or(normals[vertex], {0.0, 1.0, 0.0});
        double sum = 0.0, weights = 0.0;
        surfels.each_near(at, reach, [&](std::uint32_t i) {
            const glm::dvec3 way = glm::dvec3(surfels[i].at) - at;
            const double facing = glm::dot(glm::dvec3(surfels[i].normal), normal);
            const double weight = facing * (reach * reach - glm::dot(way, way));
            if (facing <= 0.0 || weight <= 0.0) return;
            sum += weight * static_cast<double>(values[i]);
            weights += weight;
        });
        if (weights > 0.0) out[vertex] = static_cast<float>(sum / weights);
    }
    return out;
}

}  // namespace sporeprint
