// The lamina of a leaf as a flat mesh with the relief of its veins. Private to core/plant.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "core/plant/venation.h"

namespace sporeprint {

/// A vertex of the lamina in its plane, with its relief.
struct LaminaVertex {
    glm::dvec2 place{0.0};
    double affinity = 0.0;
    bool rim = false;
    double groove = 0.0;   ///< 0..1: depth of a vein in the upper face
    double rib = 0.0;      ///< 0..1: height of the vein on the lower face
    double swell = 0.0;    ///< 0..1: height of the lamina between veins
    double breadth = 0.0;  ///< half the breadth of the half here, which limits how thick it is
};

/// The lamina as triangles.
struct LaminaMesh {
    std::vector<LaminaVertex> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise from above
};

/// Returns a mesh of the lamina: a grid of abscissas and affinities over each half. Gaps between
/// grids are closed: along the main vein and along the rays between lobes both sides share the
/// vertices of either.
///
/// rows     affinities of the grid's rows, ascending from 0 to 1
/// fill     number of parts into which the interval between the abscissas of neighbouring veins is
///          divided; 0 for the abscissas of the border alone
/// returns  the root first; each position once, so that the lamina is one piece
[[nodiscard]] LaminaMesh lamina_mesh(const Lamina& lamina, std::vector<double> rows,
                                     std::size_t fill);

}  // namespace sporeprint
