// How far two contours are from each other.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "core/trace/contour.h"

namespace sporeprint {

/// Returns the mean distance of the points of one contour from another.
inline double mean_distance(const trace::Contour& from, const trace::Contour& to) {
    double sum = 0.0;
    for (const glm::dvec2& a : from) {
        double least = 1e300;
        for (const glm::dvec2& b : to) least = std::min(least, glm::dot(a - b, a - b));
        sum += std::sqrt(least);
    }
    return sum / static_cast<double>(from.size());
}

/// Returns the mean distance between a contour and another one of the same shape, of the height of the first, after
/// the other is scaled to this height and moved to where it fits best: pictures are fitted to what they show.
inline double contour_error(const trace::Contour& truth, trace::Contour own) {
    const auto range = [](const trace::Contour& contour) {
        glm::dvec2 found(1e9, -1e9);
        for (const glm::dvec2& at : contour)
            found = {std::min(found.x, at.y), std::max(found.y, at.y)};
        return found;
    };
    const glm::dvec2 of_truth = range(truth), of_own = range(own);
    const double height = of_truth.y - of_truth.x, scale = height / (of_own.y - of_own.x);
    for (glm::dvec2& at : own) at *= scale;
    for (int round = 0; round < 20; ++round) {
        glm::dvec2 move(0.0);
        for (const glm::dvec2& a : own) {
            glm::dvec2 nearest = truth.front() - a;
            for (const glm::dvec2& b : truth)
                if (glm::dot(b - a, b - a) < glm::dot(nearest, nearest)) nearest = b - a;
            move += nearest;
        }
        for (glm::dvec2& at : own) at += 1.5 * move / static_cast<double>(own.size());
    }
    return 0.5 * (mean_distance(own, truth) + mean_distance(truth, own)) / height;
}

}  // namespace sporeprint
