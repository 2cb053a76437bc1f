// The lamina of a leaf as a flat mesh with the relief of its veins. Private to core/plant.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "core/plant/venation.h"

namespace sporeprint {

/// A place of the lamina in its plane, and its relief.
struct Flat {
    glm::dvec2 place{0.0};
    double affinity = 0.0;
    bool rim = false;
    double groove = 0.0;  ///< 0..1: how deep a vein lies here
    double rib = 0.0;     ///< 0..1: how far it stands out below
    double swell = 0.0;   ///< 0..1: how far the lamina rises between veins
};

/// A lamina as triangles.
struct FlatLamina {
    std::vector<Flat> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise from above
};

/// Lays a grid of feet and affinities over each half and closes the gaps between grids: along the main vein and along the rays
/// between lobes both sides share the places of either.
///
/// rows     affinities of the grid's rows, ascending from 0 to 1
/// fill     parts of the way from one vein's foot to the next, at whose ends feet are put; 0 for those of the border alone
/// returns  the root first; each place once, so that the lamina is one piece
[[nodiscard]] FlatLamina flat_lamina(const Lamina& lamina, std::vector<double> rows,
                                     std::size_t fill);

}  // namespace sporeprint
