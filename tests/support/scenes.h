// Small scenes and fungi that tests of uploaded scenes share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "core/images.h"
#include "core/scene/scene_habitat.h"
#include "core/scene/scene_season.h"

namespace sporeprint::scenes {

/// A scene that is put together of squares and boxes.
struct Made {
    Scene scene;

    Made() { scene.materials.emplace_back(); }

    /// Returns the number of a material, which is added if there is none of its name.
    std::uint16_t material(const std::string& name) {
        for (std::size_t i = 0; i < scene.materials.size(); ++i)
            if (scene.materials[i] == name) return static_cast<std::uint16_t>(i);
        scene.materials.push_back(name);
        return static_cast<std::uint16_t>(scene.materials.size() - 1);
    }

    /// Adds a quadrangle; its corners go round counter-clockwise as seen from outside.
    Made& quad(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d,
               const std::string& name) {
        const auto first = static_cast<std::uint32_t>(scene.positions.size());
        scene.positions.insert(scene.positions.end(), {a, b, c, d});
        const std::uint16_t number = material(name);
        scene.triangles.push_back({{first, first + 1, first + 2}, number});
        scene.triangles.push_back({{first, first + 2, first + 3}, number});
        return *this;
    }

    /// Adds level ground that faces up.
    Made& floor(float west, float north, float east, float south, float height,
                const std::string& name) {
        return quad({west, height, south}, {east, height, south}, {east, height, north},
                    {west, height, north}, name);
    }

    Made& box(const glm::vec3& low, const glm::vec3& high, const std::string& name) {
        const float x = low.x, y = low.y, z = low.z, X = high.x, Y = high.y, Z = high.z;
        quad({x, Y, Z}, {X, Y, Z}, {X, Y, z}, {x, Y, z}, name);
        quad({x, y, z}, {X, y, z}, {X, y, Z}, {x, y, Z}, name);
        quad({x, y, Z}, {X, y, Z}, {X, Y, Z}, {x, Y, Z}, name);
        quad({X, y, z}, {x, y, z}, {x, Y, z}, {X, Y, z}, name);
        quad({X, y, Z}, {X, y, z}, {X, Y, z}, {X, Y, Z}, name);
        quad({x, y, z}, {x, y, Z}, {x, Y, Z}, {x, Y, z}, name);
        return *this;
    }

    [[nodiscard]] std::shared_ptr<const Scene> shared() const {
        return std::make_shared<const Scene>(scene);
    }
};

/// Runs tasks by several threads.
inline void by_threads(std::span<const std::function<void()>> tasks) {
    std::vector<std::jthread> threads;
    for (std::size_t k = 0; k < 4; ++k)
        threads.emplace_back([tasks, k] {
            for (std::size_t i = k; i < tasks.size(); i += 4) tasks[i]();
        });
}

inline const std::vector<std::string>& kinds() {
    static const std::vector<std::string> all = {"birch",  "broadleaf", "herb",
                                                 "poplar", "shrub",     "spruce"};
    return all;
}

/// Returns the conditions of a scene whose materials are what their names say, in a mild and wet climate.
inline SceneConditions conditions_for(const Scene& scene) {
    SceneConditions out;
    out.seed = 7;
    out.climate = {.latitude_deg = 51, .temperature = 8.5, .swing = 9, .rain = 900};
    std::vector<Problem> problems;
    out.soils = soils_of(scene.materials, {}, kinds(), "", problems);
    return out;
}

inline SceneHabitat habitat_in(const std::shared_ptr<const SceneShape>& shape) {
    return habitat_of(shape, conditions_for(*shape->scene));
}

/// Returns a species that lives on wood of any tree and fruits often.
inline FungusSpecies wood_species() {
    FungusSpecies species;
    Ecology& ecology = species.ecology;
    ecology.guild = Guild::wood;
    ecology.on_standing_wood = true;
    ecology.genet = {.rate = 0.001, .speed = 0.3, .life = 15.0, .reach = 3.0};
    ecology.fruit = {.density = 8.0, .clusters = 2.0, .cluster_spread = 0.05, .tufts = 2.0};
    species.stream = stream_of("wood_species");
    species.months = 0xFFF;
    species.kinds = all_trees;
    species.cap_radius = 0.02;
    return species;
}

/// Returns a species of turf.
inline FungusSpecies grass_species() {
    FungusSpecies species = wood_species();
    species.ecology.guild = Guild::grass;
    species.ecology.genet = {.rate = 0.001, .speed = 0.3, .life = 20.0, .reach = 4.0};
    species.ecology.fruit.density = 5.0;
    species.stream = stream_of("grass_species");
    return species;
}

/// Returns a species of the litter of any tree.
inline FungusSpecies litter_species() {
    FungusSpecies species = grass_species();
    species.ecology.guild = Guild::litter;
    species.stream = stream_of("litter_species");
    return species;
}

}  // namespace sporeprint::scenes
