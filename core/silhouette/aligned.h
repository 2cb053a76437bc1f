// Outlines of several species and ages on one common parameter: corresponding points have the same
// u in all of them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/silhouette/outline.h"

namespace sporeprint {

/// One control shape of a set: a growth stage of a species, or a custom model.
struct ControlShape {
    Silhouette silhouette;  ///< metres
    double size =
        1.0;  ///< metres, > 0; the shape is divided by it, because sizes are blended separately
    std::size_t species_index =
        /// shapes of equal index are stages of one species: their control points correspond one to
        /// one
        0;
    double age = 0.6;  ///< 0..1; the stage nearest to 0.6 represents its species
};

/// A correspondence set by the designer between the two species of a pair, in shares of arc length
/// of their outlines.
struct Arc {
    CurveName curve = CurveName::cap;
    double a = 0.5;
    double b = 0.5;

    static constexpr void fields(auto visit) {
        visit(&Arc::curve, Info{.name = "curve", .doc = "The sub-curve that it links."});
        visit(&Arc::a, Info{.name = "a",
                            .min = 0,
                            .max = 1,
                            .doc = "Share of the arc length on the first species' outline."});
        visit(&Arc::b, Info{.name = "b",
                            .min = 0,
                            .max = 1,
                            .doc = "Share of the arc length on the second species' outline."});
    }
    bool operator==(const Arc&) const = default;
};

/// The range of the stages of one species among the shapes of a set.
struct SpeciesRange {
    std::size_t first = 0, count = 0;
    std::size_t mature = 0;  ///< index of the shape whose age is nearest to 0.6
};

/// Shapes as nodes at equal steps of the common parameter.
struct AlignedShapes {
    std::vector<SpeciesRange> species;
    std::vector<double> ages;         ///< one per shape
    std::vector<OutlineNodes> nodes;  ///< one per shape, each divided by its size
};

/// Puts all shapes on the common parameter: stages correspond to the mature stage of their species
/// by control points, species to the hub (the first that has the sub-curve) by least work, and
/// smooth joins stay smooth in every mix.
///
/// throws  Impossible for arcs that cross one another or leave their curve (path "/arcs/<i>"),
///         InvalidInput for stages of one species whose sub-curves differ in their numbers of
///         control points; otherwise as Outline::unproven()
/// source  [Desbenoit2004] sec. 4; [SederbergGreenwood1992]
[[nodiscard]] AlignedShapes aligned(const std::vector<ControlShape>& shapes,
                                    std::span<const Arc> arcs, double arcs_age);

/// Returns the growth weights of the stages of one species at an age: linear between neighbours,
/// constant before the first and after the last stage.
[[nodiscard]] std::vector<double> stage_weights(std::span<const double> ages, double age);

}  // namespace sporeprint
