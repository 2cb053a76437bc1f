// Interpolating centripetal Catmull-Rom splines, which have neither loops nor cusps between their
// control points.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace sporeprint {

template <class V>
struct SplineSample {
    V position;
    V derivative;  ///< with respect to the segment's own parameter 0..1
    V second_derivative;
};

/// One cubic between two control points, in Hermite form.
template <class V>
struct SplineSegment {
    V from, to;
    V leaving, arriving;  ///< derivatives with respect to the parameter 0..1

    [[nodiscard]] SplineSample<V> at(double t) const {
        const V c = 3.0 * (to - from) - 2.0 * leaving - arriving;
        const V d = 2.0 * (from - to) + leaving + arriving;
        return {from + t * (leaving + t * (c + t * d)), leaving + t * (2.0 * c + 3.0 * t * d),
                2.0 * c + 6.0 * t * d};
    }
};

/// Returns the velocity at `here` of the centripetal curve through three points, with respect to a
/// parameter that increases from point to point by centripetal_step(). If `before` equals `here`,
/// it points straight to `after`; it is zero if `after` equals `here`.
///
/// source  [Yuksel2011] sec. 3: the tangent of the Barry-Goldman pyramid at a control point
template <class V>
[[nodiscard]] V centripetal_velocity(const V& before, const V& here, const V& after) {
    const double a = std::sqrt(std::sqrt(glm::dot(here - before, here - before)));
    const double b = std::sqrt(std::sqrt(glm::dot(after - here, after - here)));
    if (a < 1e-9 || b < 1e-9) return b < 1e-9 ? V(0.0) : (after - here) / b;
    return (here - before) / a - (after - before) / (a + b) + (after - here) / b;
}

/// Returns the parameter step from one point to the next: the square root of their distance.
template <class V>
[[nodiscard]] double centripetal_step(const V& from, const V& to) {
    return std::sqrt(std::sqrt(glm::dot(to - from, to - from)));
}

/// Returns the segments of an open curve through at least two points; its ends leave towards their
/// neighbours.
[[nodiscard]] std::vector<SplineSegment<glm::dvec3>> open_spline(
    const std::vector<glm::dvec3>& points);

}  // namespace sporeprint
