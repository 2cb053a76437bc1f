#include "core/skeleton/fork.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"

namespace sporeprint {

namespace {

// Returns the distance at which control tubes of segments at an angle of `half` to each side meet,
// or the tube's radius where they do not.
double crotch_distance(double half, double factor) {
    return factor / sine(std::clamp(half, radians(15.0), 0.5 * pi));
}

}  // namespace

Fork fork_of(const std::array<glm::dvec3, 3>& directions, double factor) {
    Fork fork;
    const glm::dvec3 across =
        glm::cross(directions[1] - directions[0], directions[2] - directions[0]);
    const double size = glm::length(across);
    if (size > 1e-9) {
        fork.pole = across / size;
    } else {
        // For collinear segments any perpendicular direction serves.
        const glm::dvec3& d = directions[0];
        const glm::dvec3 axis = std::abs(d.y) < 0.8 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        fork.pole = glm::normalize(glm::cross(d, axis));
    }
    fork.cone = glm::dot(fork.pole, directions[0]);
    if (fork.cone < 0.0) {
        fork.pole = -fork.pole;
        fork.cone = -fork.cone;
    }
    glm::dvec3 first = directions[0] - fork.pole * glm::dot(fork.pole, directions[0]);
    first = glm::normalize(first);
    const glm::dvec3 second = glm::cross(fork.pole, first);
    std::array<double, 3> azimuth{};
    for (std::size_t i = 1; i < 3; ++i) {
        azimuth[i] = arc_tangent(glm::dot(directions[i], second), glm::dot(directions[i], first));
        if (azimuth[i] < 0.0) azimuth[i] += 2.0 * pi;
    }
    fork.order = {0, 1, 2};
    if (azimuth[2] < azimuth[1]) std::swap(fork.order[1], fork.order[2]);
    for (std::size_t k = 0; k < 3; ++k) {
        const double from = azimuth[fork.order[k]];
        const double to = k == 2 ? 2.0 * pi : azimuth[fork.order[k + 1]];
        const double half = 0.5 * (to - from);
        const SineCosine middle = sine_cosine(from + half);
        const double distance = crotch_distance(half, factor);
        // The crotch is as high above the plane as the segments are there.
        const double rise =
            half < 0.5 * pi
                ? cosine(half) * fork.cone / std::sqrt(std::max(1e-9, 1.0 - fork.cone * fork.cone))
                : 0.0;
        fork.crotch[k] =
            distance * (middle.cosine * first + middle.sine * second + rise * fork.pole);
    }
    return fork;
}

double reach_of(const Fork& fork, const glm::dvec3& direction, std::size_t place, double factor) {
    const double before = glm::dot(fork.crotch[(place + 2) % 3], direction);
    const double after = glm::dot(fork.crotch[place], direction);
    const double pole = factor * std::abs(glm::dot(fork.pole, direction));
    return std::max({0.0, before, after, pole});
}

double bend_reach(const glm::dvec3& first, const glm::dvec3& second, double factor) {
    // This is tan(bend / 2), from the cosine of the bend.
    const double cosine_of_bend = std::clamp(-glm::dot(first, second), -1.0, 1.0);
    return factor * std::sqrt((1.0 - cosine_of_bend) / std::max(1e-9, 1.0 + cosine_of_bend));
}

}  // namespace sporeprint
