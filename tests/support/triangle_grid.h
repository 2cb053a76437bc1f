// Distances of points from the triangles of a mesh.
#pragma once

#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "core/mesh/mesh.h"

namespace sporeprint {

/// Returns the squared length of a vector.
[[nodiscard]] inline double squared(const glm::dvec3& v) { return glm::dot(v, v); }

/// Returns the distance from a point to a triangle, metres; degenerate triangles count as segments
/// or points.
///
/// source [Ericson2005] sec. 5.1.5: the closest point by Voronoi regions
[[nodiscard]] double distance_to_triangle(const glm::dvec3& point, const glm::dvec3& a,
                                          const glm::dvec3& b, const glm::dvec3& c);

/// Returns the corners of a triangle.
[[nodiscard]] std::array<glm::dvec3, 3> corners_of(const Mesh& mesh, std::size_t triangle);

/// The triangles of a mesh, indexed by the cells of a grid that their boxes touch.
class TriangleGrid {
  public:
    /// pre     mesh outlives this object
    /// throws  std::invalid_argument for a mesh without triangles
    explicit TriangleGrid(const Mesh& mesh);

    /// Returns the squared distance from a point to the nearest triangle, or to any triangle within
    /// `enough`, square metres. Consecutive points are neighbours, so the last result is tried
    /// first.
    ///
    /// reach  metres; triangles farther than that may be left out, and without others the result is
    ///        infinite
    [[nodiscard]] double squared_distance(const glm::dvec3& p, double enough = 0.0,
                                          double reach = std::numeric_limits<double>::infinity());

  private:
    using Cell = std::array<int, 3>;

    [[nodiscard]] Cell cell_of(const glm::dvec3& p) const;
    [[nodiscard]] std::vector<std::size_t>& cell(int x, int y, int z);
    /// Returns the distance of p from the nearest cell outside the block of `reach` cells round
    /// `home`; 0 or less if p may be in one.
    [[nodiscard]] double wall_distance(const glm::dvec3& p, const Cell& home, int reach) const;
    template <class Visit>
    void shell(const Cell& home, int reach, const Visit& visit) const;

    const Mesh& mesh_;
    glm::dvec3 low_{0.0};
    double cell_ = 0.0;
    Cell count_{};
    std::vector<std::vector<std::size_t>> cells_;
    std::size_t last_ = 0;
};

}  // namespace sporeprint
