#include "core/skeleton/fork.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"

namespace sporeprint {

namespace {

// Where control tubes of limbs that stand `half` to each side meet; on the tube itself where there is nothing to meet.
double crotch_distance(double half, double factor) {
    return factor / sine(std::clamp(half, radians(15.0), 0.5 * pi));
}

}  // namespace

Fork fork_of(const std::array<glm::dvec3, 3>& limbs, double factor) {
    Fork fork;
    const glm::dvec3 across = glm::cross(limbs[1] - limbs[0], limbs[2] - limbs[0]);
    const double size = glm::length(across);
    if (size > 1e-9) {
        fork.pole = across / size;
    } else {
        // Limbs on a line: anything across it.
        const glm::dvec3& d = limbs[0];
        const glm::dvec3 axis = std::abs(d.y) < 0.8 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        fork.pole = glm::normalize(glm::cross(d, axis));
    }
    fork.cone = glm::dot(fork.pole, limbs[0]);
    if (fork.cone < 0.0) {
        fork.pole = -fork.pole;
        fork.cone = -fork.cone;
    }
    glm::dvec3 first = limbs[0] - fork.pole * glm::dot(fork.pole, limbs[0]);
    first = glm::normalize(first);
    const glm::dvec3 second = glm::cross(fork.pole, first);
    std::array<double, 3> azimuth{};
    for (std::size_t i = 1; i < 3; ++i) {
        azimuth[i] = arc_tangent(glm::dot(limbs[i], second), glm::dot(limbs[i], first));
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
        // As high as the limbs are there.
        const double rise =
            half < 0.5 * pi
                ? cosine(half) * fork.cone / std::sqrt(std::max(1e-9, 1.0 - fork.cone * fork.cone))
                : 0.0;
        fork.crotch[k] =
            distance * (middle.cosine * first + middle.sine * second + rise * fork.pole);
    }
    return fork;
}

double reach_of(const Fork& fork, const glm::dvec3& limb, std::size_t place, double factor) {
    const double before = glm::dot(fork.crotch[(place + 2) % 3], limb);
    const double after = glm::dot(fork.crotch[place], limb);
    const double pole = factor * std::abs(glm::dot(fork.pole, limb));
    return std::max({0.0, before, after, pole});
}

double bend_reach(const glm::dvec3& first, const glm::dvec3& second, double factor) {
    // tan(bend / 2), from the cosine of the bend.
    const double cosine_of_bend = std::clamp(-glm::dot(first, second), -1.0, 1.0);
    return factor * std::sqrt((1.0 - cosine_of_bend) / std::max(1e-9, 1.0 + cosine_of_bend));
}

}  // namespace sporeprint
