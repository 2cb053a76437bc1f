#include "core/plant/spots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

std::vector<Spot> spots_of(std::span<const PlacedLeaf> leaves, double leaf_area, double middle,
                           std::size_t count) {
    const double share =
        leaves.empty()
            ? 0.0
            : std::min(1.0, static_cast<double>(count) / static_cast<double>(leaves.size()));
    std::vector<Spot> spots;
    for (const PlacedLeaf& leaf : thinned(leaves, share)) {
        if (spots.size() == count) break;  // a share of a whole number of leaves may round up
        // A larger spot represents leaves near the same position, so it does not move outwards with
        // its size.
        const double grown = leaves[spots.size()].size;
        spots.push_back({leaf.place + middle * grown * leaf.along, leaf.up,
                         leaf_area * leaf.size * leaf.size, leaf.id});
    }
    return spots;
}

PointCloud point_cloud(std::span<const Spot> spots) {
    PointCloud cloud;
    for (const Spot& spot : spots) {
        cloud.positions.emplace_back(spot.place);
        cloud.normals.emplace_back(spot.normal);
        cloud.half_sides.push_back(static_cast<float>(0.5 * std::sqrt(spot.area)));
        cloud.ids.push_back(spot.id);
    }
    return cloud;
}

Mesh polygonal_spots(std::span<const Spot> spots, int corners, std::uint32_t seed) {
    if (corners != 3 && corners != 4)
        throw InvalidInput("/corners", std::to_string(corners) + " is not 3 or 4");
    // Radius of a regular polygon of area 1: n / 2 sin(2 pi / n) r^2.
    const double unit = 1.0 / std::sqrt(0.5 * corners * sine(2.0 * pi / corners));
    Mesh mesh;
    for (const Spot& spot : spots) {
        Random random(seed, purposes::spot_spin, spot.id);
        const double spin = 2.0 * pi * random.uniform();
        const glm::dvec3 first = square_to(spot.normal, glm::dvec3(0.0));
        const glm::dvec3 second = glm::cross(spot.normal, first);
        const double radius = unit * std::sqrt(spot.area);
        const auto shift = static_cast<std::uint32_t>(mesh.positions.size());
        for (const double side : {1.0, -1.0})
            for (int k = 0; k < corners; ++k) {
                const SineCosine at = sine_cosine(spin + 2.0 * pi * k / corners);
                mesh.positions.emplace_back(spot.place +
                                            radius * (at.cosine * first + at.sine * second));
                mesh.normals.emplace_back(side * spot.normal);
            }
        // The two faces of a square are split along different diagonals, so that no edge has four
        // triangles.
        using Triangle = std::array<std::uint32_t, 3>;
        constexpr std::array<Triangle, 2> three = {{{0, 1, 2}, {3, 5, 4}}};
        constexpr std::array<Triangle, 4> four = {{{0, 1, 2}, {0, 2, 3}, {4, 7, 5}, {5, 7, 6}}};
        const std::span<const Triangle> faces =
            corners == 3 ? std::span<const Triangle>(three) : std::span<const Triangle>(four);
        for (const Triangle& face : faces)
            for (const std::uint32_t corner : face) mesh.indices.push_back(shift + corner);
    }
    return mesh;
}

}  // namespace sporeprint
