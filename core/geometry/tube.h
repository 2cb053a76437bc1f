// The cross-sections of a tube of a branch graph.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace sporeprint {

/// A cross-section of a tube: an ellipse, or a circle if `wide` equals `thin`.
struct Station {
    glm::dvec3 at{0.0}, along{0.0, 1.0, 0.0};
    glm::dmat3 flat{0.0};  ///< flattening: sum of outer squares of unit vectors
    double radius = 0.0, wide = 1.0, thin = 1.0;  ///< factors along the flattening and across it
    double at_fork = 0.0;                         ///< 0..1: closeness to a fork
    double colour = 0.0;  ///< see BranchGraph::Node::from_tip; for a trunk the share of its length
    double few = 0.0;     ///< see BranchGraph::Node::few
    glm::dvec3 side{1.0, 0.0, 0.0};  ///< unit, direction of the first column
    double turn = 0.0;               ///< radians: where the texture begins on the chart
    double phase = 0.0;              ///< place of the first column in the texture, in girths

    /// Returns the factors on the radius: they map a direction from the middle to the surface.
    [[nodiscard]] glm::dmat3 shape() const { return glm::dmat3(thin) + (wide - thin) * flat; }
};

/// Rows of a mesh, one after another, that belong to successive stations.
struct TubeRows {
    std::uint32_t first_vertex = 0;
    std::uint32_t sides = 0;
    bool strip = false;     ///< rows of a trunk, which repeat their first vertex
    std::size_t from = 0;   ///< index of the station of the first row
    std::size_t count = 0;  ///< number of rows

    /// Returns the number of vertices of a row.
    [[nodiscard]] std::uint32_t width() const { return sides + (strip ? 1 : 0); }
};

/// A tube: its stations from its beginning to the last before its tip, and its rows in a mesh.
struct Tube {
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    std::vector<Station> stations;
    std::vector<TubeRows> rows;
    std::size_t parent = none;  ///< index of the tube in which it begins
    std::size_t trunk = 0;      ///< number of its first stations that belong to a trunk
    std::size_t shown = 0;      ///< index of its first station that is not inside the parent
};

}  // namespace sporeprint
