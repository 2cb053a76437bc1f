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
        bool operator==(const Segment&) const = default;
    };
    std::vector<Node> nodes;
    std::vector<Segment> segments;
};

inline constexpr std::size_t most_skeleton_nodes = 200'000;

/// Returns the errors of a skeleton that cannot be cleaned: too many nodes, a position or radius
/// that is not finite or out of bounds, a segment to a missing node. Paths contain the index of the
/// node or segment.
[[nodiscard]] std::vector<Problem> validation_errors(const Skeleton& skeleton);

/// The limits that a skeleton must meet to be skinned without folds.
struct SkinLimits {
    /// Least angle between two segments at a node, degrees.
    double fork_deg = 50.0;
    /// Greatest bend at a node of two segments, degrees.
    double bend_deg = 100.0;
    /// Greatest sine of the angle between three segments at a node and their common plane.
    double cone = 0.58;
    /// Least free length of a segment between its forks on both sides, in sums of its radii.
    double clear = 1.0;
    /// Nodes nearer than this are merged, in sums of their radii.
    double merge = 0.5;
    /// At a fork, a third segment thinner than this share of the others starts at a node of its own
    /// inside them, and so does a segment of which the node's radius is less than this share.
    double slender = 0.55;
};

/// A skeleton that meets its limits, with at most three segments per node. Segments that make no
/// smooth fork (a fourth segment, a twig on a trunk, segments at a sharp angle, a segment too short
/// to leave its forks) start at a node of their own inside the others and are closed separately.
struct CleanSkeleton {
    Skeleton skeleton;
    /// The new index of each original node.
    std::vector<std::uint32_t> node_of;
};

/// Returns a skeleton that meets the limits of skinned(). Of two conflicting segments the thinner
/// is detached, of equal ones the later.
///
/// throws  InvalidInput with validation_errors()
/// cost    O(nodes + segments), times the length of the longest run of coincident nodes
[[nodiscard]] CleanSkeleton cleaned(const Skeleton& skeleton, const SkinLimits& limits = {});

/// Returns the limits that a skeleton breaks, by node and segment; empty for the result of
/// cleaned().
[[nodiscard]] std::vector<Problem> broken_limits(const Skeleton& skeleton,
                                                 const SkinLimits& limits = {});

}  // namespace sporeprint
