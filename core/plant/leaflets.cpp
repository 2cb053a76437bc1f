#include "core/plant/leaflets.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/direction.h"
#include "core/math/elementary.h"

namespace sporeprint {

namespace {

// No source or measurement is recorded: least size of a leaflet, in that of the longest; share of
// its angle by which the last leaflet leans more to the tip.
constexpr double least_size = 0.05, leaning = 0.45;

// How unlike leaflets are: how much shorter the shortest is than its place requires, how far they stand
// from their place, in the distance of two, and how far they turn from their angles, in degrees.
constexpr double shorter = 0.2, moved = 0.7, opened_deg = 13.0, turned_deg = 20.0;

// Returns -1..1 for the n-th of many things.
//
// source  multiples of the root of three, modulo 1
double unlike(double n) {
    const double turns = n * 1.7320508075688772;
    return 2.0 * (turns - std::floor(turns)) - 1.0;
}

}  // namespace

glm::dvec3 PlacedLeaflet::place(const glm::dvec3& point) const {
    return glm::dvec3(0.0, 0.0, at) +
           size * (point.x * glm::cross(up, along) + point.y * up + point.z * along);
}

std::vector<PlacedLeaflet> placed_leaflets(const Leaflets& leaflets) {
    std::vector<PlacedLeaflet> placed;
    const auto size_at = [&](double share) {
        const double back = 1.0 - share;
        return leaflets.length *
               std::max(least_size, (1.0 - leaflets.narrow_base * back * back * back) *
                                        (1.0 - leaflets.narrow_tip * share * share));
    };
    const double last = size_at(1.0);
    for (int i = 0; i + 1 < leaflets.count; ++i) {
        const double share =
            (i + 0.5 + 0.5 * moved * unlike(5.0 * i + 1.0)) / (leaflets.count - 1.0);
        // Leaflets in two rows stay level.
        const bool in_rows = leaflets.turn_deg == 180.0;
        const SineCosine round = sine_cosine(
            radians(leaflets.turn_deg * i + (in_rows ? 0.0 : turned_deg * unlike(7.0 * i + 3.0))));
        const glm::dvec3 out =
            glm::normalize(glm::dvec3(round.cosine, (1.0 - 0.8 * leaflets.flat) * round.sine, 0.0));
        const SineCosine open =
            sine_cosine(radians(leaflets.angle_deg * (1.0 - leaning * share * share) +
                                std::min(opened_deg, 0.5 * leaflets.angle_deg) *
                                    (1.0 - share * share) * unlike(3.0 * i + 2.0)));
        PlacedLeaflet one;
        one.at = (1.0 - last) * share;
        one.size = size_at(share) * (1.0 - shorter * (0.5 + 0.5 * unlike(11.0 * i)));
        one.along = glm::dvec3(open.sine * out.x, open.sine * out.y, open.cosine);
        // The blade lies in the plane of its own direction and of the one across it, level or as
        // nearly so as it can be.
        one.up = square_to(one.along, glm::dvec3(0.0, 1.0, 0.0));
        placed.push_back(one);
    }
    if (leaflets.count > 0) placed.push_back({1.0 - last, last});
    return placed;
}

}  // namespace sporeprint
