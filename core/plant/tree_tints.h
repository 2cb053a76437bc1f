// Hue and brightness of each branch of a tree: factors of the base colour for the vertices of bark and
// leaves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/plant/tree.h"

namespace sporeprint {

/// The tints of a tree's surface as functions of place and edge. Each branch departs from its parent
/// by a draw of its own, so that a bough has one hue and its branches vary about it; twigs and leaves
/// differ least. They do not depend on the level of detail.
class TreeTints {
  public:
    /// spread  LeafStyle::hue_spread
    /// cost    O(edges)
    TreeTints(const Tree& tree, double spread, std::uint32_t seed);

    /// Returns the factor of a point of the bark, linear, 0..1. It passes from that of the parent to
    /// that of the branch along the first edge of a branch, so that no step is at a fork.
    ///
    /// place  metres, at the scale of the tree's skeleton
    /// edge   node of the ramification that its edge enters
    [[nodiscard]] glm::vec3 of_bark(const glm::dvec3& place, std::uint32_t edge) const;

    /// Returns the factor of a leaf, linear, 0..1.
    ///
    /// share  of its departure that it shows: less of what stands for leaves of many branches
    [[nodiscard]] glm::vec3 of_leaf(const PlacedLeaf& leaf, double share = 1.0) const;

  private:
    /// How yellow and how bright an edge is at its end, about -1..1 each.
    using Departure = glm::dvec2;

    struct Edge {
        glm::dvec3 from{0.0}, way{0.0};
        Departure begin{0.0}, end{0.0};
    };
    double spread_;
    std::uint32_t seed_;
    std::vector<Edge> edges_;
};

/// Returns the tints of bark.
[[nodiscard]] std::vector<glm::vec3> tints_of(const Bark& bark, const TreeTints& tree);

/// Returns the tints of merged leaves.
///
/// vertices  of each leaf
/// share     as of_leaf()
[[nodiscard]] std::vector<glm::vec3> tints_of(std::span<const PlacedLeaf> leaves,
                                              std::size_t vertices, const TreeTints& tree,
                                              double share = 1.0);

}  // namespace sporeprint
