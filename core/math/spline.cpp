#include "core/math/spline.h"

#include <cmath>

namespace sporeprint {

std::vector<SplineSegment<glm::dvec3>> open_spline(const std::vector<glm::dvec3>& points) {
    std::vector<SplineSegment<glm::dvec3>> segments;
    const std::size_t n = points.size();
    const auto velocity = [&](std::size_t i) {
        if (i > 0 && i + 1 < n)
            return centripetal_velocity(points[i - 1], points[i], points[i + 1]);
        // At an end the mirrored neighbour makes the velocity point straight at the next point.
        const std::size_t a = i == 0 ? 0 : n - 2;
        const double step = centripetal_step(points[a], points[a + 1]);
        return step < 1e-9 ? glm::dvec3(0.0) : (points[a + 1] - points[a]) / step;
    };
    for (std::size_t i = 0; i + 1 < n; ++i) {
        const double step = centripetal_step(points[i], points[i + 1]);
        segments.push_back({points[i], points[i + 1], velocity(i) * step, velocity(i + 1) * step});
    }
    return segments;
}

}  // namespace sporeprint
