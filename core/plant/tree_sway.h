// How wind moves a tree: weights for the vertices of bark and leaves.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/plant/tree.h"

namespace sporeprint {

/// The weights of a tree's surface as functions of place and main branch. They do not depend on the
/// level of detail, and surfaces that touch have equal weights, so that nothing tears. A main branch
/// is a subtree that leaves the trunk: the axis of the root.
///
/// Half of `bend` grows with the square of the distance from the foot, the other half with that of
/// the distance from the base of the main branch; `phase` grows along a main branch to its own.
class TreeSway {
  public:
    /// cost  O(edges)
    explicit TreeSway(const Tree& tree);

    /// Returns the weights of a point of the bark; its flutter is 0.
    ///
    /// place  metres, at the scale of the tree's skeleton
    /// edge   node of the ramification that its edge enters
    [[nodiscard]] Sway at(const glm::dvec3& place, std::uint32_t edge) const;

    /// Returns the distance of the farthest node from the foot, metres.
    [[nodiscard]] double reach() const { return reach_; }

  private:
    struct Branch {
        glm::dvec3 base{0.0};
        double clear = 0.0;   ///< distance from the base that is inside the trunk, metres
        double length = 0.0;  ///< from there to the farthest node, metres
        double phase = 0.0;   ///< at its end
    };

    double clear_ = 0.0;  ///< distance from the foot up to which the trunk is rigid, metres
    double reach_ = 0.0;  ///< metres
    std::vector<Branch> branches_;
    std::vector<std::uint32_t> branch_of_;  ///< by edge: 0 for the trunk, otherwise 1 + its index
};

/// Returns the share of its largest flutter of each vertex of a leaf: the square of the distance from
/// the base, 1 at the farthest vertex.
///
/// pre  at least one vertex
[[nodiscard]] std::vector<float> flutter_of(const Mesh& leaf);

/// Returns the sway of bark.
[[nodiscard]] std::vector<Sway> sway_of(const Bark& bark, const TreeSway& tree);

/// Returns the sway of merged leaves: each moves as its base does, and flutters.
///
/// leaf  the mesh of which `leaves` are copies
[[nodiscard]] std::vector<Sway> sway_of(std::span<const PlacedLeaf> leaves, const Mesh& leaf,
                                        const TreeSway& tree);

}  // namespace sporeprint
