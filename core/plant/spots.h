// Foliage at a distance: spots instead of leaves, fewer and larger, with the same total area.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/plant/tree.h"

namespace sporeprint {

/// A spot that represents the leaves near a position.
/// source  [Viennot1989] section 6.2
struct Spot {
    glm::dvec3 place{0.0};
    glm::dvec3 normal{0.0, 1.0, 0.0};  ///< unit, of the upper face of its leaf
    double area = 0.0;                 ///< square metres
    std::uint32_t id = 0;              ///< of its leaf
};

/// Returns at most `count` spots at the centres of as many leaves. Their total area is that of all
/// leaves. With a smaller count, the spots are those at the beginning of the longer list, each with
/// a greater area.
///
/// leaves     as placed_leaves() returns them
/// leaf_area  of a leaf of size 1, square metres
/// middle     distance from the base of a leaf of size 1 to its centre, metres
[[nodiscard]] std::vector<Spot> spots_of(std::span<const PlacedLeaf> leaves, double leaf_area,
                                         double middle, std::size_t count);

/// Spots as points, for a renderer of points: the square of each has a side of 2 half_sides.
struct PointCloud {
    std::vector<glm::vec3> positions, normals;
    std::vector<float> half_sides;
    std::vector<std::uint32_t> ids;
};
/// Returns one point per spot; its square has the spot's area.
[[nodiscard]] PointCloud point_cloud(std::span<const Spot> spots);

/// Returns spots as flat regular polygons of their areas. Each is a closed mesh of a front and a
/// back face in the same plane, with opposite normals: two triangles for 3 corners, four for 4. It
/// is rotated about the spot's normal by a random angle.
///
/// corners  3 or 4
/// seed     determines the angles
/// throws   InvalidInput for other corners
[[nodiscard]] Mesh polygonal_spots(std::span<const Spot> spots, int corners, std::uint32_t seed);

}  // namespace sporeprint
