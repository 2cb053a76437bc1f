#include "core/plant/leaflets.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/math/direction.h"
#include "core/math/elementary.h"

namespace sporeprint {

namespace {

// No source or measurement is recorded: least size of a leaflet, in that of the longest; share of
// its angle by which the last leaflet leans more to the tip.
constexpr double least_size = 0.05, leaning = 0.45;

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
        const double share = (i + 0.5) / (leaflets.count - 1.0);
        const SineCosine round = sine_cosine(radians(leaflets.turn_deg * i));
        const glm::dvec3 out =
            glm::normalize(glm::dvec3(round.cosine, (1.0 - 0.8 * leaflets.flat) * round.sine, 0.0));
        const SineCosine open =
            sine_cosine(radians(leaflets.angle_deg * (1.0 - leaning * share * share)));
        PlacedLeaflet one;
        one.at = (1.0 - last) * share;
        one.size = size_at(share);
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
