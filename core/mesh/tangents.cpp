#include "core/mesh/tangents.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace sporeprint {

void add_tangents(Mesh& mesh) {
    const std::size_t count = mesh.positions.size();
    std::vector<glm::dvec3> along_u(count, glm::dvec3(0.0)), along_v(count, glm::dvec3(0.0));
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::uint32_t* t = &mesh.indices[i];
        const glm::dvec3 from(mesh.positions[t[0]]);
        const glm::dvec3 p = glm::dvec3(mesh.positions[t[1]]) - from;
        const glm::dvec3 q = glm::dvec3(mesh.positions[t[2]]) - from;
        const glm::dvec2 corner(mesh.texture_coordinates[t[0]]);
        const glm::dvec2 a = glm::dvec2(mesh.texture_coordinates[t[1]]) - corner;
        const glm::dvec2 b = glm::dvec2(mesh.texture_coordinates[t[2]]) - corner;
        // Triangles are weighted by their area in texture space; mirrored ones contribute with
        // their own direction.
        const double turn = a.x * b.y - a.y * b.x < 0.0 ? -1.0 : 1.0;
        for (std::size_t k = 0; k < 3; ++k) {
            along_u[t[k]] += turn * (b.y * p - a.y * q);
            along_v[t[k]] += turn * (a.x * q - b.x * p);
        }
    }
    mesh.tangents.clear();
    mesh.tangents.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 normal = glm::normalize(glm::dvec3(mesh.normals[i]));
        glm::dvec3 tangent = along_u[i] - glm::dot(along_u[i], normal) * normal;
        if (!(glm::length(tangent) > 1e-6 * glm::length(along_u[i]))) {
            const glm::dvec3 other =
                std::abs(normal.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
            tangent = other - glm::dot(other, normal) * normal;
        }
        tangent = glm::normalize(tangent);
        const double up = -glm::dot(glm::cross(normal, tangent), along_v[i]);
        mesh.tangents.emplace_back(glm::vec3(tangent), up < 0.0 ? -1.0F : 1.0F);
    }
}

}  // namespace sporeprint
