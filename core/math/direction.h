// Unit vectors that turn, and those of lengths that may vanish: what skeletons carry from limb to limb, and what solids stand by.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace sporeprint {

/// A direction carried along as the heading turns from one unit vector to another, without twist. Headings that are all but opposite leave
/// it as it is.
[[nodiscard]] glm::dvec3 carried(const glm::dvec3& v, const glm::dvec3& from, const glm::dvec3& to);

/// `v`, which is square to the unit vector `axis`, turned about it.
///
/// angle  radians, right-handed
[[nodiscard]] glm::dvec3 turned_square(const glm::dvec3& v, const glm::dvec3& axis, double angle);

/// `v` made unit; `fallback` where it has no length.
[[nodiscard]] inline glm::dvec3 unit_or(const glm::dvec3& v, const glm::dvec3& fallback) {
    const double square = glm::dot(v, v);
    return square > 1e-30 ? v / std::sqrt(square) : fallback;
}

/// `direction` made unit and square to the unit vector `normal`; some such vector where it has no length or lies along the normal.
[[nodiscard]] glm::dvec3 square_to(const glm::dvec3& normal, const glm::dvec3& direction);

}  // namespace sporeprint
