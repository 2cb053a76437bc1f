// Correspondence of two curves by dynamic programming: each point of one is mapped to a point of
// the other with least work.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/silhouette/outline.h"

namespace sporeprint {

/// A monotone map of shares of arc length, 0..1 to 0..1, with a continuous derivative.
///
/// source  [FritschCarlson1980]; derivatives are the weighted harmonic means of
///         [FritschButland1984]
class ShareMap {
  public:
    struct Value {
        double at, slope;
    };

    ShareMap() : ShareMap({0.0, 1.0}, {0.0, 1.0}) {}

    /// Builds the map through knots.
    ///
    /// from, to  knots, equally many, strictly ascending from 0 to 1. Derivatives at the knots are
    ///           limited to [1 / steepest, steepest], and always low enough for the map to be
    ///           monotone.
    ShareMap(std::vector<double> from, std::vector<double> to, double steepest = 8.0);

    [[nodiscard]] Value operator()(double share) const;

    /// Returns the inverse map, through the same knots with the axes swapped.
    [[nodiscard]] ShareMap inverse() const { return {to_, from_}; }

    [[nodiscard]] const std::vector<double>& from() const { return from_; }
    [[nodiscard]] const std::vector<double>& to() const { return to_; }

  private:
    std::vector<double> from_, to_, slopes_;
};

/// A curve as straight edges of equal length.
struct Edges {
    std::vector<glm::dvec2> directions;  ///< unit vectors
    double length = 1.0;                 ///< total length, as a share of the sub-curve
};

/// A link: vertex `a` of one curve corresponds to vertex `b` of the other. As a step: numbers of
/// edges of each curve.
struct Link {
    int a = 0, b = 0;
    bool operator==(const Link&) const = default;
};

/// The work of deforming one curve into another, both of length about 1: absolute size has no
/// influence.
///
/// A step maps some edges of one curve to some edges of the other; pieces that correspond are bent
/// from one direction to the other. The work of stretching is quadratic in the change of length, so
/// that a match that shifts by d over a length w costs about k_s d^2 / w: shifts spread out, and
/// none is made without gain. A turn by the angle phi whose positions differ by d is aligned in the
/// middle of a curve where 4 k_s d < 2 k_b (1 - cos phi): with the weights here 48 degrees for a
/// sixth of the curve, 60 for a quarter, 90 for a half.
///
/// source  [SederbergGreenwood1992] for the work of stretching; differs: steps are ratios of edges,
///         as in elastic curve matching, not collapses to a vertex; an edge is bent from its own
///         direction to its partner's in one go, so that the work of a step is independent of the
///         step before it
struct BlendWork {
    double stretch = 0.72;       ///< k_s
    double share_of_long = 0.5;  ///< c_s: W_s = k_s (L1 - L0)^2 / ((1 - c_s) min + c_s max)
    double bend = 0.72;          ///< k_b: W_b = k_b (L0 + L1)/2 |d1 - d0|^2 for unit directions d

    /// Returns the work of the step that begins at the vertices `at_a` and `at_b`.
    [[nodiscard]] double step(const Edges& a, const Edges& b, std::size_t at_a, std::size_t at_b,
                              const Link& over) const;
};

/// The admissible steps from one link to the next: ratios of at most four edges to one, in lowest
/// terms.
inline constexpr std::array<Link, 11> link_steps = {
    {{1, 1}, {1, 2}, {2, 1}, {1, 3}, {3, 1}, {2, 3}, {3, 2}, {1, 4}, {4, 1}, {3, 4}, {4, 3}}};

/// Returns the monotone chain of links from (0, 0) to the last vertices with the least work.
/// Swapping the curves swaps the links, ties included.
///
/// a, b     equally many edges, at least one
/// returns  links; consecutive ones differ by one of `link_steps`
/// cost     O(n^2)
/// source   [SederbergGreenwood1992] sec. 4, with more kinds of steps
[[nodiscard]] std::vector<Link> least_work_links(const Edges& a, const Edges& b,
                                                 const BlendWork& work = {});

/// A fixed pair of corresponding shares of arc length of two curves.
struct Landmark {
    double a = 0.0, b = 0.0;
};

/// Returns the map from shares of `a` to shares of `b` along the links of least work that
/// interpolates the landmarks.
///
/// landmarks  strictly inside (0, 1) and ascending in both
/// returns    map with slopes within [1/8, 8] between its landmarks
[[nodiscard]] ShareMap correspondence(const SubCurve& a, const SubCurve& b,
                                      std::span<const Landmark> landmarks = {});

}  // namespace sporeprint
