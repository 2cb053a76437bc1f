// Catmull-Clark subdivision of closed meshes of quads.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace sporeprint {

/// A mesh of quads, counter-clockwise from outside.
struct QuadMesh {
    std::vector<glm::dvec3> points;
    std::vector<std::array<std::uint32_t, 4>> quads;
};

/// A subdivided mesh. The quads of its last level are stored as those of the level before, each of
/// which has four children.
struct Subdivided {
    std::vector<glm::dvec3> points;
    std::vector<std::array<std::uint32_t, 4>> parents;  ///< their corners
    std::vector<std::uint32_t> edges;                   ///< index of the edge by parent and side
    std::uint32_t first_face_point = 0,
                  first_edge_point = 0;  ///< points: one per parent, one per edge

    /// Returns the points of a parent's children. Child k keeps the parent's corner k as its own
    /// corner k: the children are {0, 1, 2, 3}, {1, 4, 5, 2}, {2, 5, 6, 7} and {3, 2, 7, 8} of
    /// these.
    [[nodiscard]] std::array<std::uint32_t, 9> patch(std::size_t parent) const {
        const std::array<std::uint32_t, 4>& corner = parents[parent];
        const std::uint32_t* edge = &edges[4 * parent];
        return {corner[0],
                first_edge_point + edge[0],
                first_face_point + static_cast<std::uint32_t>(parent),
                first_edge_point + edge[3],
                corner[1],
                first_edge_point + edge[1],
                corner[2],
                first_edge_point + edge[2],
                corner[3]};
    }
};

/// Subdivides a closed mesh: each quad is split into four, each of which keeps one corner and
/// continues around the face point.
///
/// coarse   a closed two-manifold in which every point is a corner
/// levels   at least 1
/// returns  quad q of `coarse` becomes 4^(levels - 1) contiguous parents; points are the smoothed
///          ones of the level before, then its face points, then its edge points. Every sum goes
///          counter-clockwise from a half-edge that topology determines, so that rounding is the
///          same everywhere
/// throws   GenerationError if an edge does not have two faces in opposite directions along it
/// cost     O(quads 4^levels)
/// source   [CatmullClark1978]
[[nodiscard]] Subdivided subdivided(QuadMesh coarse, int levels);

}  // namespace sporeprint
