// The limbs of one branched individual: the branching that its species have in common, and where blended styles put it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/model/branched.h"

namespace sporeprint {

/// One species of a bush.
struct BushShare {
    const Branched* shape = nullptr;
    double weight = 1.0;  ///< weights sum to 1
};

/// How an individual departs from its species: factors.
struct BushProportions {
    double size = 1.0;    ///< of the whole
    double trunk = 1.0;   ///< of the share of the height below the lowest fork
    double width = 1.0;   ///< of all radii
    double spread = 1.0;  ///< of the angles of forks
};

/// Tips of a species of few limbs, at most: each of them is long.
constexpr std::size_t few_tips = 12;

/// A graph of limbs at rest: straight up from the origin. Which nodes there are follows from the species and the seed alone; weights and
/// ages move only lengths, angles and radii, and what a species lacks has length and radius 0.
struct Bush {
    static constexpr std::uint32_t none = 0xffffffffU;

    /// The end of a limb, and that limb.
    struct Node {
        std::uint32_t parent = none;
        std::array<std::uint32_t, 2> children = {none, none};  ///< the first goes on as its bearer
        int tips = 1;                       ///< that it bears, whatever is there of them
        double presence = 0.0;              ///< 0..1: how much of it there is
        double left = 0.0;                  ///< tips that it bears, each as far as it is there
        glm::dvec3 place{0.0};              ///< metres
        glm::dvec3 heading{0.0, 1.0, 0.0};  ///< unit, of the limb before it ends
        glm::dvec3 across{1.0, 0.0, 0.0};   ///< unit, square to it: the plane in which it forks
        glm::dvec3 beside{0.0};  ///< where its limb begins, from the end of its bearer, metres
        double radius = 0.0;     ///< metres
        bool may_end = false;    ///< whether some species of the set has a tip there
        double few = 0.0;        ///< 0..1: share of species of few limbs among those that have it
        double from_tip = 0.0;   ///< 1 at the top of a trunk, 0 at a tip: where its colours are
        double eaten =
            0.0;  ///< 0..1: how much of a last branch slugs have eaten, as far as it is one
    };
    std::vector<Node> nodes;           ///< bearers come before what they bear
    std::vector<std::uint32_t> roots;  ///< trunks, from the ground to their lowest fork
    double height = 0.0;               ///< metres, of the highest tip
    double trunk = 0.0;                ///< metres, length of a trunk
    double trunk_radius = 0.0;         ///< metres
    double reach = 0.0;                ///< metres: how far from the axis its limbs reach
    double foot = 1.0, flatness = 0.0, web = 0.0, bluntness = 0.0;  ///< see LimbStyle

    [[nodiscard]] bool empty() const { return nodes.empty(); }
    [[nodiscard]] bool is_tip(std::uint32_t node) const { return nodes[node].children[0] == none; }
    /// How far a limb ends there, 0..1: where one species has a tip and another a fork, the share of the first.
    [[nodiscard]] double ends(std::uint32_t node) const {
        const Node& one = nodes[node];
        if (one.children[0] == none) return 1.0;
        return one.presence > 0.0 ? 1.0 - nodes[one.children[0]].presence / one.presence : 0.0;
    }
};

/// Lays the ramifications of all species over each other, fork on fork from the ground up, and grows the limbs of what they come to.
///
/// bites   0..1, of WeatheringOf
/// throws  Impossible (path "/ramification/order") if a tree that is drawn freely comes to more than most_bush_tips
/// cost    O(tips of all species)
/// source  [Viennot1989] for the branching; angles, lengths and widths by order; widths as pipes
[[nodiscard]] Bush bush_of(const std::vector<BushShare>& shares, const BushProportions& own,
                           double bites, std::uint32_t seed);

}  // namespace sporeprint
