// An individual's own proportions, applied to the outline of its species: stem longer and wider, cap higher.
#pragma once

#include <optional>

#include "core/silhouette/morph_set.h"

namespace sporeprint {

/// Factors on the template's outline; 1 leaves it as it is.
struct Proportions {
    double longer = 1.0;  ///< length of the stem
    double wider = 1.0;   ///< width of the stem, and of what hugs it
    double higher = 1.0;  ///< height of the cap over its margin
};

/// The outline in other proportions. What hugs the stem widens with it; further out the change dies away within three stem
/// radii, so that an open cap keeps its diameter; a form without a lower face (a club) widens as a whole.
///
/// nodes   of a set; wider < 2.25, so that radii keep their order
/// open    0..1: how much of the mix has a lower face
/// returns nodes whose velocities are moved by the map's Jacobian, sub-curves that were one smooth curve still are
[[nodiscard]] OutlineNodes proportioned(OutlineNodes nodes, const Proportions& by, double open);

/// The outline in another size.
[[nodiscard]] OutlineNodes scaled(OutlineNodes nodes, double by);

/// The sub-curve in which the swept polyline of one level of detail touches itself, folds back or reaches the axis between its ends;
/// none if it is simple. Places that coincide count once: a sub-curve that has shrunk to a point crosses nothing.
[[nodiscard]] std::optional<CurveName> fault_of(const Outline& outline, int lod);

/// Largest distance from the axis on a sub-curve, of 33 places.
[[nodiscard]] double greatest_radius(const SubCurve& curve);

}  // namespace sporeprint
