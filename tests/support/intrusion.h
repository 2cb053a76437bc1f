// How deep one closed mesh reaches into another.
#pragma once

#include <vector>

#include "core/mesh/mesh.h"

namespace sporeprint {

/// A closed mesh of any number of pieces that can be asked what lies in it.
class Solid {
  public:
    /// What is referred to must outlive this.
    explicit Solid(const Mesh& mesh);

    /// How far inside a point lies, metres: its distance to the surface; 0 outside. In by the number of times the surface winds round it.
    [[nodiscard]] double depth(const glm::dvec3& point) const;

    [[nodiscard]] const Bounds& box() const { return box_; }

  private:
    const Mesh& mesh_;
    Bounds box_;
    double cell_x_ = 1.0, cell_z_ = 1.0;
    std::vector<std::vector<std::uint32_t>> columns_;  // triangles by the cells of a grid across y
};

/// Vertices of a mesh, and the middles of its triangles and edges: what is asked of a surface.
[[nodiscard]] std::vector<glm::dvec3> samples_of(const Mesh& mesh);

}  // namespace sporeprint
