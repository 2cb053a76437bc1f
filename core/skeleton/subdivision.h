// Smooth surfaces from closed meshes of quads.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace sporeprint {

/// Faces of four corners, counter-clockwise from outside.
struct QuadMesh {
    std::vector<glm::dvec3> points;
    std::vector<std::array<std::uint32_t, 4>> quads;
};

/// A subdivided mesh. The quads of its last level are told by those that they come of, four to each.
struct Subdivided {
    std::vector<glm::dvec3> points;
    std::vector<std::array<std::uint32_t, 4>> parents;  ///< their corners
    std::vector<std::uint32_t> edges;                   ///< by parent and side: number of the edge
    std::uint32_t first_middle = 0,
                  first_edge = 0;  ///< points: one to each parent, one to each edge

    /// The points of a parent's children. Child k keeps the parent's corner k as its own corner k: the children are {0, 1, 2, 3},
    /// {1, 4, 5, 2}, {2, 5, 6, 7} and {3, 2, 7, 8} of these.
    [[nodiscard]] std::array<std::uint32_t, 9> patch(std::size_t parent) const {
        const std::array<std::uint32_t, 4>& corner = parents[parent];
        const std::uint32_t* edge = &edges[4 * parent];
        return {corner[0],
                first_edge + edge[0],
                first_middle + static_cast<std::uint32_t>(parent),
                first_edge + edge[3],
                corner[1],
                first_edge + edge[1],
                corner[2],
                first_edge + edge[2],
                corner[3]};
    }
};

/// Subdivides a closed mesh: each quad into four, each of which keeps a corner and goes on round the middle.
///
/// coarse   a closed two-manifold, every point a corner
/// levels   at least 1
/// returns  quad q of `coarse` becomes 4^(levels - 1) parents that follow each other; points are those of the level before, drawn in,
///          middles of its quads, then of its edges. Every sum goes counter-clockwise from a half-edge that is told by topology, so
///          that rounding is the same everywhere
/// throws   GenerationError if an edge has no two faces that go opposite ways along it
/// cost     O(quads 4^levels)
/// source   [CatmullClark1978]
[[nodiscard]] Subdivided subdivided(QuadMesh coarse, int levels);

}  // namespace sporeprint
