// The coarse control mesh of quads around a skeleton, watertight by construction.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/skeleton/skeleton.h"

namespace sporeprint {

/// A mesh of quads, counter-clockwise from outside; each quad belongs to a strip: a run of segments
/// between two forks or ends.
struct Scaffold {
    /// The position of a corner on its strip: u around it (0..1), v in metres along it from its
    /// first node.
    using Place = glm::dvec2;
    /// The quads of one strip are contiguous: `tube_quads` along it, in rings of four, then the
    /// caps of its ends.
    struct Strip {
        std::uint32_t first = 0, quads = 0, tube_quads = 0;
        double length = 0.0;  ///< metres
        double radius = 0.0;  ///< mean, metres
    };
    std::vector<glm::dvec3> points;
    std::vector<std::array<std::uint32_t, 4>> quads;
    std::vector<std::array<Place, 4>> places;  ///< by quad and corner
    std::vector<std::uint32_t> labels;         ///< by quad: of its segment
    std::vector<Strip> strips;
};

/// Returns the control mesh whose surface after `levels` subdivisions has the radii of a clean
/// skeleton.
///
/// A fork needs no face of its own: the rings of its three segments share its two poles and three
/// crotches. Elsewhere rings of four lie across the segments, in frames that are
/// parallel-transported and then rotated evenly to meet the next fork.
///
/// levels   0..3
/// returns  a closed two-manifold: each component of the graph with E segments and V nodes has
///          Euler characteristic 2 (V - E)
/// throws   Impossible with broken_limits()
/// cost     O(nodes)
[[nodiscard]] Scaffold scaffold(const Skeleton& clean, int levels);

}  // namespace sporeprint
