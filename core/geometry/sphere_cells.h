// The Voronoi cells of points on a sphere: meshes of a net that closes round the whole.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace sporeprint {

/// Voronoi cells on the unit sphere. Three cells meet at every corner.
struct SphereCells {
    struct Cell {
        glm::dvec3 centre;                 ///< unit vector
        std::vector<std::size_t> corners;  ///< indices, counter-clockwise seen from outside
    };
    std::vector<glm::dvec3> corners;  ///< unit vectors; 2 n - 4 of them for n cells
    std::vector<Cell> cells;
};

/// The fewest cells of which three meet at every corner.
inline constexpr int least_cells = 4;

/// Returns cells of about equal size at places of the seed's own; one corner is the lowest point. The cells of another seed have
/// other neighbours, but the number of corners and edges is the same: 2 n - 4 and 3 n - 6 (Euler).
///
/// count  number of cells, at least least_cells
[[nodiscard]] SphereCells sphere_cells(int count, std::uint32_t seed);

}  // namespace sporeprint
