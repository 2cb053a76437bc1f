// Individual proportions applied to the outline of a species: a longer and wider stem, a higher
// cap.
#pragma once

#include <optional>

#include "core/silhouette/morph_set.h"

namespace sporeprint {

/// Factors on the template's outline; 1 leaves it unchanged.
struct Proportions {
    double longer = 1.0;  ///< length of the stem
    double wider = 1.0;   ///< width of the stem, and of the surfaces next to it
    double higher = 1.0;  ///< height of the cap above its margin
};

/// Returns the outline in other proportions. Surfaces next to the stem widen with it; the widening
/// fades to nothing from one to four stem radii from the axis, so that an open cap keeps its
/// diameter; a form without a lower face (a club) widens as a whole.
///
/// nodes    nodes of an outline of a MorphSet
/// open     0..1: total weight of the species with a lower face
/// pre      proportions.wider < 2.25, so that radii keep their order
/// returns  nodes whose velocities are transformed by the Jacobian of the map, so that smooth joins
///          of sub-curves stay smooth
[[nodiscard]] OutlineNodes proportioned(OutlineNodes nodes, const Proportions& proportions,
                                        double open);

/// Returns the outline scaled by a factor.
[[nodiscard]] OutlineNodes scaled(OutlineNodes nodes, double factor);

/// Returns the sub-curve in which the swept polyline of one level of detail touches itself, folds
/// back or reaches the axis between its ends; none if it is simple. Coincident vertices count once:
/// a sub-curve that has shrunk to a point crosses nothing.
[[nodiscard]] std::optional<CurveName> self_intersecting_curve(const Outline& outline,
                                                               DetailLevel level);

/// What sub-curves reach at 33 evenly spaced points of each, metres.
struct Extent {
    double low, high;     ///< heights
    double radius = 0.0;  ///< largest distance from the axis

    /// Includes a sub-curve; an empty one changes nothing.
    void include(const SubCurve& curve);
};

/// Returns the largest distance from the axis at 33 evenly spaced points of a sub-curve, metres.
[[nodiscard]] double greatest_radius(const SubCurve& curve);

}  // namespace sporeprint
