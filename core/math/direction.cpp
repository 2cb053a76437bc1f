#include "core/math/direction.h"

#include <cmath>
#include <glm/geometric.hpp>

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

glm::dvec3 square_to(const glm::dvec3& v, const glm::dvec3& axis) {
    const glm::dvec3 flat = v - glm::dot(v, axis) * axis;
    const double size = glm::length(flat);
    if (size > 1e-6) return flat / size;
    const glm::dvec3 other = std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    return glm::normalize(other - glm::dot(other, axis) * axis);
}

}  // namespace sporeprint
