#include "core/geometry/wrap.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace sporeprint {

namespace {

/// A value and its derivative.
struct Sloped {
    double value = 0.0, slope = 0.0;
};

/// How far a circle of radius 1 is behind its tangent, by the place along that; straight beyond
/// `widest`.
Sloped behind_tangent(double x) {
    constexpr double widest = 0.8;
    const double within = std::clamp(x, -widest, widest);
    const double height = std::sqrt(1.0 - within * within);
    const double slope = within / height;
    return {1.0 - height + slope * (x - within), slope};
}

/// The share of points that follows the trunk, by their distance in front of the wall in radii of
/// the trunk: from 1 to 0 as a cubic, flat at both ends.
Sloped following(double z) {
    const double at = std::clamp(z, 0.0, 1.0), rest = 1.0 - at;
    return {rest * rest * (1.0 + 2.0 * at), -6.0 * at * rest};
}

}  // namespace

void wrap_round_trunk(Mesh& mesh, double radius) {
    if (radius <= 0.0) return;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        glm::vec3& position = mesh.positions[i];
        const Sloped back = behind_tangent(static_cast<double>(position.x) / radius);
        const Sloped share = following(static_cast<double>(position.z) / radius);
        position.z -= static_cast<float>(radius * back.value * share.value);
        // The derivatives of the new z by the old x and z; those of the other coordinates are 0 or 1.
        const double by_x = -back.slope * share.value, by_z = 1.0 - back.value * share.slope;
        glm::dvec3 normal(mesh.normals[i]);
        normal.z /= by_z;
        normal.x -= by_x * normal.z;
        normal = glm::normalize(normal);
        mesh.normals[i] = glm::vec3(normal);
        if (mesh.tangents.empty()) continue;
        glm::dvec3 tangent(mesh.tangents[i]);
        tangent.z = by_x * tangent.x + by_z * tangent.z;
        tangent = glm::normalize(tangent - glm::dot(tangent, normal) * normal);
        mesh.tangents[i] = glm::vec4(glm::vec3(tangent), mesh.tangents[i].w);
    }
}

}  // namespace sporeprint
