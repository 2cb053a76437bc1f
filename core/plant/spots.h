// Foliage from afar: spots instead of leaves, fewer and larger, with the same area in all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/plant/tree.h"

namespace sporeprint {

/// A spot that stands for leaves about a place.
/// source [Viennot1989] section 6.2
struct Spot {
    glm::dvec3 place{0.0};
    glm::dvec3 normal{0.0, 1.0, 0.0};  ///< unit: the upper face of its leaf
    double area = 0.0;                 ///< square metres
    std::uint32_t id = 0;              ///< that of its leaf
};

/// At most `count` spots in the middles of as many leaves, of which those of fewer are the first; their areas together are those of
/// all leaves.
///
/// leaves     as placed_leaves() returns them
/// leaf_area  of a leaf of size 1, square metres
/// middle     how far from a leaf's root its middle lies, metres for size 1
[[nodiscard]] std::vector<Spot> spots_of(std::span<const PlacedLeaf> leaves, double leaf_area,
                                         double middle, std::size_t count);

/// Spots as points, for a renderer of points: a square of each one's area is 2 half_sides wide.
struct PointCloud {
    std::vector<glm::vec3> positions, normals;
    std::vector<float> half_sides;
    std::vector<std::uint32_t> ids;
};
[[nodiscard]] PointCloud point_cloud(std::span<const Spot> spots);

/// Spots as thin polygons, each a closed piece seen from both sides: two triangles for 3 corners, four for 4. Each is turned about
/// its normal at random.
///
/// corners  3 or 4
/// throws   InvalidInput for other corners
[[nodiscard]] Mesh polygonal_spots(std::span<const Spot> spots, int corners, std::uint32_t seed);

}  // namespace sporeprint
