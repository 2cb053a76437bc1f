// A graph of segments with radii, and its cleaning for skinning.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/problems.h"

namespace sporeprint {

/// Nodes in space, metres, connected by segments. Along a segment the radius is linear between
/// those of its nodes.
struct Skeleton {
    struct Node {
        glm::dvec3 place{0.0};
        double radius = 0.0;
    };
    struct Segment {
        std::uint32_t from = 0, to = 0;
        std::uint32_t label = 0;  ///< of the caller, for what is made of the segment
        bool operator==(const Segment&) const = default;
    };
    std::vector<Node> nodes;
    std::vector<Segment> segments;
};

inline constexpr std::size_t most_skeleton_nodes = 200'000;

/// Returns the errors of a skeleton that cannot be cleaned: more than most_skeleton_nodes nodes, a
/// coordinate that is not finite or beyond 1e4 m, a radius outside 1e-6..1e3 m, a segment to a
/// missing node. Paths contain the index of the node or segment.
[[nodiscard]] std::vector<Problem> validation_errors(const Skeleton& skeleton);

/// The limits that a skeleton must meet to be skinned without folds.
struct SkinLimits {
    /// Least angle between two segments at a node, degrees.
    double fork_deg = 50.0;
    /// Greatest bend at a node of two segments, degrees.
    double bend_deg = 100.0;
    /// Greatest slope of a fork. The three segments at a fork make equal angles with the plane
    /// through the tips of their unit vectors, shifted to the node; this is the sine of that angle,
    /// 0 if they are coplanar.
    double cone = 0.58;
    /// Least length of a segment that is not covered by the forks at its ends, as a multiple of the
    /// sum of the radii of its two nodes.
    double clear = 1.0;
    /// Nodes of a segment are merged if their distance is less than this multiple of the sum of
    /// their radii.
    double merge = 0.5;
    /// Greatest ratio of thicknesses at a fork. The thinnest of three segments starts at a node of
    /// its own inside the others if its radius is less than this share of theirs. A segment does so
    /// too if the radius of the fork's node is less than this share of the segment's.
    double slender = 0.55;
};

/// A skeleton that meets its limits, with at most three segments per node. Segments that make no
/// smooth fork (a fourth segment, a twig on a trunk, segments at a sharp angle, a segment that the
/// forks at its ends cover) are detached: they start at a node of their own inside the others, and
/// their surface is closed separately.
struct CleanSkeleton {
    Skeleton skeleton;
    /// The new index of each original node.
    std::vector<std::uint32_t> node_of;
};

/// Returns a skeleton that meets the limits of skinned(). Nodes that are too near are merged at
/// their mean, and of several segments between the same two nodes only the first remains. Of two
/// conflicting segments the thinner is detached, of equal ones the later.
///
/// throws  InvalidInput with validation_errors()
/// cost    O(nodes + segments), times the length of the longest run of coincident nodes
[[nodiscard]] CleanSkeleton cleaned(const Skeleton& skeleton, const SkinLimits& limits = {});

/// Returns the limits that a skeleton breaks, by node and segment; empty for the result of
/// cleaned().
[[nodiscard]] std::vector<Problem> broken_limits(const Skeleton& skeleton,
                                                 const SkinLimits& limits = {});

}  // namespace sporeprint
