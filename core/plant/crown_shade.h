// The shade inside a crown: how dark leaves are between others.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "core/plant/tree.h"

namespace sporeprint {

/// How much of the light of the sky comes to places in a crown, by the twigs that lie in the way. It is a
/// function of the tree alone, so that all levels of detail have the same.
class CrownShade {
  public:
    /// tree  of any size; a crown of few twigs has no shade
    /// cost  O(twigs)
    explicit CrownShade(const Tree& tree);

    /// Returns the factor of the base colour of a leaf there, 0..1: 1 at the outside.
    ///
    /// place  metres, at the scale of the tree's skeleton
    [[nodiscard]] double at(const glm::dvec3& place) const;

  private:
    /// Cells of a side of the grid.
    static constexpr std::size_t cells = 14;

    [[nodiscard]] double open_of(std::size_t x, std::size_t y, std::size_t z) const;

    glm::dvec3 low_{0.0};
    double cell_ = 1.0;
    std::vector<double> dense_;  ///< share of light that a cell takes, as a depth
    std::vector<double> open_;   ///< factor of each cell, at its middle
};

}  // namespace sporeprint
