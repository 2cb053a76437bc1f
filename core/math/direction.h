// Unit vectors under rotation and parallel transport, safe normalisation, and quaternions.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace sporeprint {

/// Angle between neighbours of a sequence that stays evenly spread round a circle, however long it is,
/// radians.
inline constexpr double golden_angle = 2.399963229728653;

/// Returns a direction transported, without twist, as the heading rotates from one unit vector to
/// another. Nearly opposite headings leave it unchanged.
[[nodiscard]] glm::dvec3 carried(const glm::dvec3& v, const glm::dvec3& from, const glm::dvec3& to);

/// Returns `v`, which is perpendicular to the unit vector `axis`, rotated about it.
///
/// angle  radians, right-handed
[[nodiscard]] glm::dvec3 turned_square(const glm::dvec3& v, const glm::dvec3& axis, double angle);

/// Returns `v` normalised, or `fallback` if its length is zero.
[[nodiscard]] inline glm::dvec3 unit_or(const glm::dvec3& v, const glm::dvec3& fallback) {
    const double square = glm::dot(v, v);
    return square > 1e-30 ? v / std::sqrt(square) : fallback;
}

/// Returns `direction` made perpendicular to the unit vector `normal` and normalised; any
/// perpendicular vector if its length is zero or it is parallel to the normal.
[[nodiscard]] glm::dvec3 square_to(const glm::dvec3& normal, const glm::dvec3& direction);

/// Returns a rotation as a unit quaternion x, y, z, w.
///
/// turn  its columns are unit vectors, square to each other and right-handed
[[nodiscard]] glm::dvec4 quaternion_of(const glm::dmat3& turn);

/// Returns a vector rotated by a unit quaternion x, y, z, w.
[[nodiscard]] inline glm::dvec3 rotated(const glm::dvec4& turn, const glm::dvec3& v) {
    const glm::dvec3 axis(turn);
    return v + 2.0 * glm::cross(axis, glm::cross(axis, v) + turn.w * v);
}

}  // namespace sporeprint
