#include "core/trace/edge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

#include "core/trace/contour.h"
#include "core/trace/lab.h"

namespace sporeprint::trace {

namespace {

/// Returns the mean colour of a few pixels along a line; none if none of them is on the side of the mask.
std::optional<glm::dvec3> mean_along(const Picture& picture, const Mask& mask,
                                     const glm::dvec2& from, const glm::dvec2& step, int steps,
                                     bool is_inside) {
    glm::dvec3 sum(0.0);
    int count = 0;
    // The pixels at the border have some of both sides.
    for (int i = 2; i <= steps; ++i) {
        const glm::dvec2 at = from + static_cast<double>(i) * step;
        const int x = static_cast<int>(std::floor(at.x)), y = static_cast<int>(std::floor(at.y));
        if (x < 0 || y < 0 || x >= mask.width || y >= mask.height || mask.at(x, y) != is_inside)
            continue;
        const std::uint8_t* rgb = &picture.rgb[3 * mask.index(x, y)];
        sum += glm::dvec3(rgb[0], rgb[1], rgb[2]);
        ++count;
    }
    if (count == 0) return std::nullopt;
    return lab_of(sum / static_cast<double>(count));
}

}  // namespace

double edge_of(const Picture& picture, const Mask& mask) {
    constexpr double nothing = 100.0;
    if (mask.area() == 0) return nothing;
    const Contour contour = contour_of(mask, 2.0);
    const int steps = 2 + std::max(mask.width, mask.height) / 100;
    constexpr std::size_t most_places = 400;
    const std::size_t stride = std::max<std::size_t>(contour.size() / most_places, 1);
    std::vector<double> differences;
    differences.reserve(2 * most_places);
    for (std::size_t i = 0; i < contour.size(); i += stride) {
        const glm::dvec2 along =
            contour[(i + 1) % contour.size()] - contour[(i + contour.size() - 1) % contour.size()];
        const double length = glm::length(along);
        if (length <= 0.0) continue;
        // The mask is on the right of the contour as it is seen.
        const glm::dvec2 inwards = glm::dvec2(-along.y, along.x) / length;
        const auto inside = mean_along(picture, mask, contour[i], inwards, steps, true),
                   outside = mean_along(picture, mask, contour[i], -inwards, steps, false);
        if (inside && outside) differences.push_back(glm::length(*inside - *outside));
    }
    if (differences.empty()) return nothing;
    const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
    std::nth_element(differences.begin(), middle, differences.end());
    return *middle;
}

}  // namespace sporeprint::trace
