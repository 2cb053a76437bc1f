// The branch graph of one branched individual: the merged branching of all its species, placed by
// their blended styles.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "core/model/branched.h"

namespace sporeprint {

/// One species of a branch graph.
struct BranchGraphShare {
    const Branched* shape = nullptr;
    double weight = 1.0;       ///< weights sum to 1
    std::uint32_t stream = 0;  ///< of the species in random streams
};

/// Factors by which an individual deviates from its species.
struct BranchGraphProportions {
    double size = 1.0;    ///< of the whole
    double trunk = 1.0;   ///< of the share of the height below the lowest fork
    double width = 1.0;   ///< of all radii
    double spread = 1.0;  ///< of the angles of forks
};

/// A species with at most this many tips counts as sparse: each of its segments is long.
constexpr std::size_t most_sparse_tips = 12;

/// A graph of segments before deformation, upright from the origin. Its nodes depend on the species
/// and the seed alone; weights and ages change only lengths, angles and radii, and segments that a
/// species lacks have length and radius 0.
struct BranchGraph {
    static constexpr std::uint32_t none = 0xffffffffU;

    /// How a segment deviates from an even tube, drawn by its way from the root.
    struct Gnarl {
        double bend = 0.0, swing = 0.0;  ///< directions across it, radians
        double lump = 0.0, knee = 0.0;   ///< of its thickness between forks and at its end, -1..1
        double colour = 0.0;             ///< -1..1
    };

    /// The end of a segment, and that segment.
    struct Node {
        std::uint32_t parent = none;
        std::array<std::uint32_t, 2> children = {none, none};  ///< the first continues the segment
        int tips = 1;           ///< number of tips of its subtree, whatever their presence
        double presence = 0.0;  ///< 0..1: how far the segment is grown
        double left = 0.0;      ///< sum of the presence of the tips of its subtree
        glm::dvec3 place{0.0};  ///< metres
        glm::dvec3 heading{0.0, 1.0, 0.0};  ///< unit direction of the segment at its end
        /// unit, perpendicular to `heading`, in the plane of the fork
        glm::dvec3 across{1.0, 0.0, 0.0};
        glm::dvec3 beside{0.0};  ///< start of its segment relative to the end of its parent, metres
        double radius = 0.0;     ///< metres
        bool may_end = false;    ///< some species of the set has a tip here
        double few = 0.0;        ///< 0..1: weight of sparse species among those that have the node
        double from_tip = 0.0;   ///< colour coordinate: 1 at the top of a trunk, 0 at a tip
        double eaten =
            /// 0..1: share of a terminal segment eaten by slugs, times how far it is terminal
            0.0;
        Gnarl gnarl;
    };
    std::vector<Node> nodes;           ///< parents precede their children
    std::vector<std::uint32_t> roots;  ///< tops of the trunks: from the ground to the lowest fork
    double height = 0.0;               ///< metres, of the highest tip
    double trunk = 0.0;                ///< metres, length of a trunk
    double trunk_radius = 0.0;         ///< metres
    double reach = 0.0;                ///< metres: greatest distance of its segments from the axis
    double foot = 1.0, flatness = 0.0, web = 0.0, ruffle = 0.0, bluntness = 0.0,
           gnarl = 0.0;  ///< see SegmentStyle

    [[nodiscard]] bool empty() const { return nodes.empty(); }
    [[nodiscard]] bool is_tip(std::uint32_t node) const { return nodes[node].children[0] == none; }
    /// Returns how far a segment ends at a node, 0..1: the weight of the species with a tip there
    /// among those that have the node.
    [[nodiscard]] double ends(std::uint32_t node) const {
        const Node& one = nodes[node];
        if (one.children[0] == none) return 1.0;
        return one.presence > 0.0 ? 1.0 - nodes[one.children[0]].presence / one.presence : 0.0;
    }
};

/// Merges the branching of all species (forks are matched by their path from the root) and computes
/// the blended segments.
///
/// bites   0..1, of WeatheringOf
/// weather_seed  of where tips are eaten; `seed` if there is none
/// throws  Impossible (path "/ramification/order") if a randomly sampled tree exceeds
///         most_branch_graph_tips
/// cost    O(tips of all species)
/// source  [Viennot1989] for the branching; angles, lengths and widths by order; radii by the pipe
///         model
[[nodiscard]] BranchGraph branch_graph_of(const std::vector<BranchGraphShare>& shares,
                                          const BranchGraphProportions& own, double bites,
                                          std::uint32_t seed,
                                          std::optional<std::uint32_t> weather_seed = {});

}  // namespace sporeprint
