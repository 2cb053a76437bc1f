// Penetration depth of one closed mesh in another.
#pragma once

#include <vector>

#include "core/mesh/mesh.h"

namespace sporeprint {

/// A closed mesh of any number of components with point-in-solid queries.
class Solid {
  public:
    /// pre  mesh outlives this object
    explicit Solid(const Mesh& mesh);

    /// Returns true for a point inside, by the winding number.
    [[nodiscard]] bool contains(const glm::dvec3& point) const;

    /// Returns the depth of a point inside, metres: its distance to the surface; 0 outside.
    [[nodiscard]] double depth(const glm::dvec3& point) const;

    [[nodiscard]] const Bounds& box() const { return box_; }

  private:
    const Mesh& mesh_;
    Bounds box_;
    double cell_x_ = 1.0, cell_z_ = 1.0;
    std::vector<std::vector<std::uint32_t>> columns_;  ///< triangles by cells of a grid in x and z
};

/// Returns the vertices of a mesh and the midpoints of its triangles and edges.
[[nodiscard]] std::vector<glm::dvec3> samples_of(const Mesh& mesh);

}  // namespace sporeprint
