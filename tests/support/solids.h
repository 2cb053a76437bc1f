// Simple closed meshes, and scenes of them.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
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

/// Returns a level plate of cells x cells quads on either face, about a centre. In the image its upper
/// face is the left half, the lower one the right half, and the rim a point.
inline Mesh plate(float side, float thickness, const glm::vec3& centre = glm::vec3(0.0F),
                  int cells = 16) {
    Mesh mesh;
    const auto add = [&](const glm::vec3& at, const glm::vec3& normal, const glm::vec2& uv) {
        mesh.positions.push_back(centre + at);
        mesh.normals.push_back(normal);
        mesh.texture_coordinates.push_back(uv);
        return static_cast<std::uint32_t>(mesh.positions.size() - 1);
    };
    const auto add_quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        for (const std::uint32_t i : {a, b, c, a, c, d}) mesh.indices.push_back(i);
    };
    const float half = 0.5F * side, high = 0.5F * thickness;
    const auto row = static_cast<std::uint32_t>(cells + 1);
    for (const float up : {1.0F, -1.0F}) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (int z = 0; z <= cells; ++z)
            for (int x = 0; x <= cells; ++x) {
                const glm::vec2 share(static_cast<float>(x) / static_cast<float>(cells),
                                      static_cast<float>(z) / static_cast<float>(cells));
                add({side * share.x - half, up * high, side * share.y - half}, {0.0F, up, 0.0F},
                    {0.5F * share.x + (up > 0.0F ? 0.0F : 0.5F), share.y});
            }
        for (std::uint32_t z = 0; z + 1 < row; ++z)
            for (std::uint32_t x = 0; x + 1 < row; ++x) {
                const std::uint32_t a = first + z * row + x, b = a + row;
                if (up > 0.0F)
                    add_quad(a, b, b + 1, a + 1);
                else
                    add_quad(a, a + 1, b + 1, b);
            }
    }
    for (const glm::vec2 out :
         {glm::vec2(1, 0), glm::vec2(0, 1), glm::vec2(-1, 0), glm::vec2(0, -1)}) {
        const glm::vec3 normal(out.x, 0.0F, out.y), along(-out.y, 0.0F, out.x);
        const auto corner = [&](float right, float up) {
            return add(normal * half + along * (right * half) + glm::vec3(0.0F, up * high, 0.0F),
                       normal, glm::vec2(0.0F));
        };
        const std::uint32_t a = corner(-1.0F, -1.0F), b = corner(1.0F, -1.0F),
                            c = corner(1.0F, 1.0F), d = corner(-1.0F, 1.0F);
        add_quad(a, d, c, b);
    }
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
