// Simple solids that stand for parts of a mesh in a physics engine.
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/mesh/mesh.h"

namespace sporeprint {

/// All points within `radius` of the segment between two points, metres.
struct Capsule {
    glm::dvec3 from{0.0}, to{0.0};
    double radius = 0.0;

    /// Returns the length of the whole solid, its round ends included, metres.
    [[nodiscard]] double height() const;
    [[nodiscard]] double volume() const;
    [[nodiscard]] bool contains(const glm::dvec3& point) const;
};

/// Returns the rotation that takes +y to the direction from `from` to `to`, as a unit quaternion
/// x, y, z, w; none for a sphere.
[[nodiscard]] glm::dvec4 rotation_of(const Capsule& capsule);

/// Returns a convex mesh of at most 50 corners, all on the surface of a capsule.
[[nodiscard]] Mesh hull_of(const Capsule& capsule);

/// A solid that stands for a part of an individual.
struct CollisionShape {
    std::string part;                   ///< "cap", "stem", "body" or "trunk"
    std::variant<Capsule, Mesh> solid;  ///< a capsule, or a convex mesh
};

/// The least volume that the solids of a part share with it, its hollows filled, of that of both
/// together, unless the most solids have less; and the least that a capsule shares with the convex
/// hull which it replaces.
inline constexpr double least_shared = 0.9, least_overlap = 0.9;

/// The most corners of a convex solid.
inline constexpr int most_hull_corners = 114;

/// Returns the volume that a capsule and a convex mesh share, of that of both together, 0..1: by
/// counting points of a grid.
[[nodiscard]] double overlap(const Capsule& capsule, const Mesh& convex);

/// Returns solids that stand for triangles: as few slices of equal height, at most eight, as share
/// least_shared with the convex hulls of sixteen, or else those that share most; each a capsule if
/// one fits its convex hull within least_overlap, or else that hull with at most most_hull_corners
/// corners.
///
/// positions, indices  of a mesh, or of a part of it
/// returns             nothing for triangles in one plane
/// cost                some ten milliseconds for 3,000 triangles
[[nodiscard]] std::vector<CollisionShape> fitted_shapes(const std::string& part,
                                                        std::span<const glm::vec3> positions,
                                                        std::span<const std::uint32_t> indices);

/// Returns a capsule around each piece of a chain of points, at most `most` pieces of equal length.
///
/// points, radii  as many, at least two
[[nodiscard]] std::vector<CollisionShape> capsules_along(const std::string& part,
                                                         std::span<const glm::dvec3> points,
                                                         std::span<const double> radii, int most);

}  // namespace sporeprint
