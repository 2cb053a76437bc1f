// A tree as it is seen from far away: a few triangles for trunk and boughs, and a few for its crown.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/plant/foliage.h"
#include "core/plant/tree.h"

namespace sporeprint {

/// The number of far levels of detail, which follow the impostor: about 400, 96 and 24 triangles.
inline constexpr int far_lods = 3;

/// Bark and foliage of a tree at a far level.
struct FarTree {
    Bark bark;
    Foliage foliage;  ///< without leaves for a bare tree
};

/// The parts of a far level: spikes for trunk and boughs, and leaves or clumps of foliage.
struct FarCount {
    static constexpr std::size_t spike_vertices = 10, spike_triangles = 4;

    std::size_t spikes = 0, leaves = 0;
    std::size_t leaf_vertices = 0, leaf_triangles = 0;  ///< of each

    [[nodiscard]] std::size_t triangles() const {
        return spikes * spike_triangles + leaves * leaf_triangles;
    }
};

/// Returns the most parts of a far level, by the number of all leaves of the tree.
///
/// level  0..far_lods - 1
[[nodiscard]] FarCount far_count(int level, std::size_t leaves);

/// Returns a tree at a far level. Trunk and thickest branches are spikes of three sides. At the first
/// level flat leaves stand for groups of those of the last common level, at the others clumps: closed
/// double pyramids, because what is flat vanishes from its side, and few of them would change the
/// outline from view to view. All are of such a size that the silhouette covers as much as that of the
/// last common level, on average of three sides.
///
/// shape   of each leaf
/// level   0..far_lods - 1
/// returns closed pieces; an unclosed seam of the image is along each spike
/// throws  Impossible (path "/per_tip") for more than most_leaves
/// cost    that of the last common level
[[nodiscard]] FarTree far_tree(const Tree& tree, const LeafStyle& style, const LeafShape& shape,
                               std::uint32_t seed, int level);

}  // namespace sporeprint
