#include "core/math/direction.h"

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
    const glm::dvec3 flat = direction - glm::dot(direction, normal) * normal;
    // A much shorter vector means that the direction was almost parallel to the normal: the rest is
    // rounding noise.
    if (glm::dot(flat, flat) > 1e-8 * glm::dot(direction, direction)) return unit_or(flat, other);
    return unit_or(other - glm::dot(other, normal) * normal, other);
}

}  // namespace sporeprint
