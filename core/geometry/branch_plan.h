// Selects the tubes of a branch graph that a level of detail builds, and their resolution.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/individual/individual.h"
#include "core/mesh/detail.h"

namespace sporeprint {

/// Resolution of the tubes.
struct TubeDetail {
    int trunk_sides;  ///< of a trunk and its continuation
    int thick_sides;  ///< of other tubes with many tips
    int sides;        ///< of the remaining tubes
    int twig_sides;   ///< of last branches
    int steps;        ///< rings from fork to fork
    int tip_rings;    ///< rings of a last branch before its end
    int trunk_rings;  ///< of a trunk below its lowest fork, at least 2
    /// Increase of the exponent of tip colours when all other tubes are dropped.
    double tips_shown;
    /// 0..1: how far a segment turns to the centre of the tips that it represents.
    double lean;
    // For segments of a mix that belong to a species of few, long segments: factor on sides, and
    // numbers of rings; 0: as for all other segments.
    int few_sides = 1, few_steps = 0, few_tip_rings = 0, few_trunk_rings = 0;
    /// Rings from fork to fork of segments with many tips; 0: as of all other segments.
    int thick_steps = 0;
};

/// A segment and its continuation through first children, up to a tip: one tube.
struct TubeChain {
    std::vector<std::uint32_t> nodes;
    /// Indices in `nodes` of forks where other drawn tubes begin; each has its rings.
    std::vector<std::size_t> forks;
    int tips = 1;
    int fork_tips = 1;  ///< tips of the fork where it begins
    bool root = false;

    /// Returns true when it passes forks without a ring.
    [[nodiscard]] bool skips_forks() const { return forks.size() + (root ? 2 : 1) < nodes.size(); }
};

/// The tubes of a branch graph that are drawn at a level of detail.
struct BranchPlan {
    TubeDetail detail{};
    std::vector<TubeChain> chains;
    MeshCount count;
};

/// Returns the tubes that are built at a level of detail: the finest resolution within the
/// triangle limit that keeps enough of them; those with fewest tips are dropped first.
///
/// individual  of whose spines and ground the triangles are within the limit too
/// cost        O(nodes log nodes)
[[nodiscard]] BranchPlan branch_plan(const Individual& individual, const BranchGraph& graph,
                                     DetailLevel level);

/// Returns the sides of a tube as species of many segments draw it.
[[nodiscard]] int tube_sides(const TubeChain& chain, const TubeDetail& detail);

/// Returns the sides of a tube as it is drawn.
[[nodiscard]] int tube_columns(const BranchGraph& graph, const TubeChain& chain,
                               const TubeDetail& detail);

/// Returns the rings of a segment that forks at its end, of a species of many segments.
[[nodiscard]] int own_steps(const BranchGraph::Node& end, const TubeDetail& detail);

/// Returns the rings of a segment, whatever its end. Where only some species of a mix have a tip it
/// has as many rings as a tip needs, so that weight 1 reproduces the single-species mesh.
[[nodiscard]] int segment_rings(const BranchGraph::Node& end, const TubeDetail& detail);

/// Returns the rings of a trunk below its lowest fork.
[[nodiscard]] int trunk_ring_count(const BranchGraph::Node& top, const TubeDetail& detail);

/// Segments with less presence have no triangles.
inline constexpr double least_presence = 0.004;

/// Returns true when a tube has triangles: its first segment has begun to exist.
[[nodiscard]] bool is_present(const BranchGraph& graph, const TubeChain& chain);

}  // namespace sporeprint
