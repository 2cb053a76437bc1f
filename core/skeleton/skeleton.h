// A graph with radii, and what makes it fit to be skinned.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/problems.h"

namespace sporeprint {

/// Nodes in space, metres, joined by limbs. Along a limb the radius goes linearly from that of one node to that of the other.
struct Skeleton {
    struct Node {
        glm::dvec3 place{0.0};
        double radius = 0.0;
    };
    struct Limb {
        std::uint32_t from = 0, to = 0;
        bool operator==(const Limb&) const = default;
    };
    std::vector<Node> nodes;
    std::vector<Limb> limbs;
};

inline constexpr std::size_t most_skeleton_nodes = 200'000;

/// What cannot be cleaned: too many nodes, a place or radius that is no number or out of all bounds, a limb to a node that there is
/// not. Paths are /nodes/i and /limbs/i.
[[nodiscard]] std::vector<Problem> faults_of(const Skeleton& skeleton);

/// What a skeleton must keep to be skinned without a fold.
struct SkinLimits {
    /// Two limbs at a node stand at least this far apart, degrees.
    double fork_deg = 50.0;
    /// Two limbs that are all there is at a node bend by no more than this, degrees.
    double bend_deg = 100.0;
    /// Three limbs at a node stand off the plane that they turn about by no more than this share (the sine of that angle).
    double cone = 0.58;
    /// Where a limb leaves its forks on both sides, this much is left of it at least, in sums of its radii.
    double clear = 1.0;
    /// Nodes nearer than this become one, in sums of their radii.
    double merge = 0.5;
    /// At a fork a third limb thinner than this share of the others begins inside of them, and so does a limb that is thicker than
    /// its node by more.
    double slender = 0.55;
};

/// A skeleton that meets its limits: at most three limbs to a node. What would not go into a smooth fork (a fourth limb, a twig on
/// a trunk, limbs at a sharp angle, a limb too short to leave its forks) begins at a node of its own inside the others, closed by
/// itself.
struct CleanSkeleton {
    Skeleton skeleton;
    /// Which node each of the original ones became.
    std::vector<std::uint32_t> node_of;
};

/// Makes a skeleton fit for skinned(). The thinner limb gives way; of equals the later.
///
/// throws  InvalidInput with faults_of()
/// cost    O(nodes + limbs), times the length of the longest run of nodes that lie on each other
[[nodiscard]] CleanSkeleton cleaned(const Skeleton& skeleton, const SkinLimits& limits = {});

/// Which of the limits a skeleton breaks, by node and limb; empty for what cleaned() returns.
[[nodiscard]] std::vector<Problem> broken_limits(const Skeleton& skeleton,
                                                 const SkinLimits& limits = {});

}  // namespace sporeprint
