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

/// Vertex `a` of one curve is vertex `b` of the other; as a step, so many edges of each.
struct Link {
    int a = 0, b = 0;
    bool operator==(const Link&) const = default;
};

/// What it costs to turn one curve into another, both of length 1 or so: size plays no role.
///
/// A step takes so many edges of one curve for so many of the other; pieces that meet are bent from one direction to the other.
/// Stretching goes by the square of what is stretched, so that a match that shifts by d over a way w costs about k_s d^2 / w: shifts
/// spread out, and none is made for nothing. A turn by the angle phi that stands at places d apart is brought together in the middle of a curve where 4 k_s d < 2 k_b (1 - cos phi): with the weights here 48 degrees a sixth of the curve
/// apart, 60 a quarter, 90 a half.
/// source [SederbergGreenwood1992] for the work of stretching; differs: steps are ratios of edges, as in the matching of elastic
///        curves, not collapses to a vertex; an edge is bent from its own direction to its partner's, all in one, so that the work
///        of a step does not depend on the step before it
struct BlendWork {
    double stretch = 0.72;       ///< k_s
    double share_of_long = 0.5;  ///< c_s: W_s = k_s (L1 - L0)^2 / ((1 - c_s) min + c_s max)
    double bend = 0.72;          ///< k_b: W_b = k_b (L0 + L1)/2 |d1 - d0|^2 for unit directions d

    /// Work of the step that begins at the vertices `at_a` and `at_b`.
    [[nodiscard]] double step(const Edges& a, const Edges& b, std::size_t at_a, std::size_t at_b,
                              const Link& over) const;
};

/// The steps from one link to the next: ratios of at most four edges to one, in lowest terms.
inline constexpr std::array<Link, 11> link_steps = {
    {{1, 1}, {1, 2}, {2, 1}, {1, 3}, {3, 1}, {2, 3}, {3, 2}, {1, 4}, {4, 1}, {3, 4}, {4, 3}}};

/// The monotone chain of links from (0, 0) to the last vertices with the least work. Swapping the curves swaps the links, ties included.
///
/// a, b     equally many edges, at least one
/// returns  links, each one of `link_steps` from the one before it
/// cost     O(n^2)
/// source   [SederbergGreenwood1992] sec. 4, with more kinds of steps
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
