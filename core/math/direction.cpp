#include "core/math/direction.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/math/elementary.h"

namespace sporeprint {

glm::dvec3 carried(const glm::dvec3& v, const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 axis = glm::cross(from, to);
    const double d = glm::dot(from, to);
    if (d < -0.999999) return v;
    return v + glm::cross(axis, v) + glm::cross(axis, glm::cross(axis, v)) / (1.0 + d);
}

glm::dvec3 turned_square(const glm::dvec3& v, const glm::dvec3& axis, double angle) {
    const SineCosine at = sine_cosine(angle);
    return at.cosine * v + at.sine * glm::cross(axis, v);
}

glm::dvec3 square_to(const glm::dvec3& normal, const glm::dvec3& direction) {
    const glm::dvec3 other =
        std::abs(normal.x) < 0.8 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 any = unit_or(other - glm::dot(other, normal) * normal, other);
    const glm::dvec3 flat = direction - glm::dot(direction, normal) * normal;
    // A much shorter vector means that the direction was almost parallel to the normal: the rest is
    // rounding noise.
    if (glm::dot(flat, flat) > 1e-8 * glm::dot(direction, direction)) return unit_or(flat, any);
    return any;
}

glm::dvec4 quaternion_of(const glm::dmat3& m) {
    // Of the four squared components the largest is used, to avoid dividing by a small number.
    const std::array<double, 4> squares = {
        1.0 + m[0][0] - m[1][1] - m[2][2], 1.0 - m[0][0] + m[1][1] - m[2][2],
        1.0 - m[0][0] - m[1][1] + m[2][2], 1.0 + m[0][0] + m[1][1] + m[2][2]};
    const auto most = static_cast<std::size_t>(std::max_element(squares.begin(), squares.end()) -
                                               squares.begin());
    const double xy = m[0][1] + m[1][0], yz = m[1][2] + m[2][1], zx = m[2][0] + m[0][2];
    const double wx = m[1][2] - m[2][1], wy = m[2][0] - m[0][2], wz = m[0][1] - m[1][0];
    const std::array<glm::dvec4, 4> rows = {{{squares[0], xy, zx, wx},
                                             {xy, squares[1], yz, wy},
                                             {zx, yz, squares[2], wz},
                                             {wx, wy, wz, squares[3]}}};
    const glm::dvec4 row = rows[most];
    return row / std::sqrt(row.x * row.x + row.y * row.y + row.z * row.z + row.w * row.w);
}

}  // namespace sporeprint
