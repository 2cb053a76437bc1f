// The coarse mesh of quads round a skeleton, watertight by construction.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/skeleton/skeleton.h"

namespace sporeprint {

/// All faces are quads, counter-clockwise from outside; each belongs to a strip: a run of limbs between two forks or ends.
struct Scaffold {
    /// Where on its strip a corner lies: u once round (0..1), v metres along it from its first node.
    using Place = glm::dvec2;
    /// Quads of one strip follow each other: `tube_quads` along it, in rings of four, then the caps of its ends.
    struct Strip {
        std::uint32_t first = 0, quads = 0, tube_quads = 0;
        double length = 0.0;  ///< metres
        double radius = 0.0;  ///< mean
    };
    std::vector<glm::dvec3> points;
    std::vector<std::array<std::uint32_t, 4>> quads;
    std::vector<std::array<Place, 4>> places;  ///< by quad and corner
    std::vector<Strip> strips;
};

/// The control mesh whose `levels` times subdivided surface has the radii of a clean skeleton.
///
/// At a fork no face is needed: the rings of its three limbs share its two poles and three crotches. Elsewhere rings of four stand
/// across the limbs, in frames that are carried along without turning and then turned evenly to meet the next fork.
///
/// levels   0..3
/// returns  a closed two-manifold: each component of the graph with E limbs and V nodes has Euler characteristic 2 (V - E)
/// throws   Impossible with broken_limits()
/// cost     O(nodes)
[[nodiscard]] Scaffold scaffold(const Skeleton& clean, int levels);

}  // namespace sporeprint
