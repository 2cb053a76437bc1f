// Which point of one curve becomes which point of another: the way of least work between two curves, found by dynamic programming.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/silhouette/outline.h"

namespace sporeprint {

/// A rising map of shares of arc length, 0..1 to 0..1, with a continuous derivative.
/// source [FritschCarlson1980]; derivatives are the weighted harmonic means of [FritschButland1984]
class ShareMap {
  public:
    struct Value {
        double at, slope;
    };

    ShareMap() : ShareMap({0.0, 1.0}, {0.0, 1.0}) {}

    /// from, to  knots, equally many, strictly rising from 0 to 1. Derivatives at the knots are kept within
    ///           [1 / steepest, steepest], and always low enough for the map to rise everywhere.
    ShareMap(std::vector<double> from, std::vector<double> to, double steepest = 8.0);

    [[nodiscard]] Value operator()(double share) const;

    /// The map back: the same knots, read the other way.
    [[nodiscard]] ShareMap inverse() const { return {to_, from_}; }

    [[nodiscard]] const std::vector<double>& from() const { return from_; }
    [[nodiscard]] const std::vector<double>& to() const { return to_; }

  private:
    std::vector<double> from_, to_, slopes_;
};

/// A curve as straight edges of equal length.
struct Edges {
    std::vector<glm::dvec2> directions;  ///< unit vectors
    double length = 1.0;                 ///< of the whole, as a share of the sub-curve
};

/// What it costs to turn one curve into another; lengths are shares of the sub-curve, so that size plays no role.
/// source [SederbergGreenwood1992]; differs: an edge is bent from its own direction to its partner's, all in one, so that the work
///        of a step does not depend on the step before it
struct BlendWork {
    double stretch = 3.0;        ///< k_s
    double exponent = 2.0;       ///< e_s
    double share_of_long = 0.5;  ///< c_s: W_s = k_s |L1 - L0|^e_s / ((1 - c_s) min + c_s max)
    double bend = 0.72;          ///< k_b: W_b = k_b (L0 + L1)/2 |d1 - d0|^2 for unit directions d
    double collapse = 0.01;      ///< added for an edge that shrinks to a point
    int longest_run = 4;         ///< so many edges in a row may shrink to the same point

    /// Work of the step from vertices (a, b): `moves_a`, `moves_b` tell which edges it takes, at least one.
    [[nodiscard]] double step(const Edges& a, const Edges& b, std::size_t at_a, std::size_t at_b,
                              bool moves_a, bool moves_b) const;
};

/// Vertex `a` of one curve is vertex `b` of the other.
struct Link {
    int a = 0, b = 0;
    bool operator==(const Link&) const = default;
};

/// The monotone chain of links from (0, 0) to the last vertices with the least work. Swapping the curves swaps the links, ties included.
///
/// a, b     equally many edges, at least one
/// returns  links, each one step from the one before it: in a, in b or in both
/// cost     O(n^2 longest_run)
/// source   [SederbergGreenwood1992]; algorithms of the runs: the length of a run is part of the state
[[nodiscard]] std::vector<Link> least_work_links(const Edges& a, const Edges& b,
                                                 const BlendWork& work = {});

/// Shares of arc length of two curves that belong together.
struct Landmark {
    double a = 0.0, b = 0.0;
};

/// The map from shares of `a` to shares of `b` along the links of least work, with landmarks kept.
///
/// landmarks  strictly inside (0, 1) and rising in both
/// returns    map with slopes within [1/8, 8] between its landmarks
[[nodiscard]] ShareMap correspondence(const SubCurve& a, const SubCurve& b,
                                      std::span<const Landmark> landmarks = {});

}  // namespace sporeprint
