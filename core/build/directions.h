// Unit vectors where lengths may vanish: what solids and dents are turned by.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace sporeprint {

/// `v` made unit; `fallback` when it has no length.
inline glm::dvec3 unit_or(const glm::dvec3& v, const glm::dvec3& fallback) {
    const double square = glm::dot(v, v);
    return square > 1e-30 ? v / std::sqrt(square) : fallback;
}

/// `direction` made unit and square to a unit normal; any such direction when it has none.
inline glm::dvec3 square_to(const glm::dvec3& normal, const glm::dvec3& direction) {
    const glm::dvec3 other =
        std::abs(normal.x) < 0.8 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 flat = direction - glm::dot(direction, normal) * normal;
    // Much shorter than it was: almost parallel to the normal, so its direction is rounding noise.
    if (glm::dot(flat, flat) > 1e-8 * glm::dot(direction, direction)) return unit_or(flat, other);
    return unit_or(other - glm::dot(other, normal) * normal, other);
}

}  // namespace sporeprint
