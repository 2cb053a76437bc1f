// Simple closed meshes, and scenes of them.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "core/gltf/glb.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// Returns a ball of columns x rings quads, its poles on the y axis, with exact normals.
inline Mesh ball(float radius, const glm::vec3& centre, int columns = 48, int rings = 24) {
    constexpr double half_turn = 3.14159265358979;
    Mesh mesh;
    for (int ring = 0; ring <= rings; ++ring)
        for (int column = 0; column < columns; ++column) {
            const double polar = half_turn * ring / rings,
                         azimuth = 2.0 * half_turn * column / columns;
            const glm::vec3 normal(glm::dvec3(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                              std::sin(polar) * std::cos(azimuth)));
            mesh.normals.push_back(normal);
            mesh.positions.push_back(centre + normal * radius);
        }
    const auto at = [&](int ring, int column) {
        return static_cast<std::uint32_t>(ring * columns + column % columns);
    };
    for (int ring = 0; ring < rings; ++ring)
        for (int column = 0; column < columns; ++column)
            for (const std::uint32_t i :
                 {at(ring, column), at(ring + 1, column), at(ring + 1, column + 1),
                  at(ring, column), at(ring + 1, column + 1), at(ring, column + 1)})
                mesh.indices.push_back(i);
    return mesh;
}

/// Returns a scene with one mesh of one material, without images.
inline GlbScene scene_of(const Mesh& mesh) {
    GlbScene scene;
    scene.materials.push_back({.name = "matt"});
    scene.meshes.push_back({"solid", {{&mesh, 0, {}}}});
    scene.nodes.push_back({.name = "solid", .mesh = 0});
    return scene;
}

}  // namespace sporeprint
