// Outlines of several species and ages on one common parameter: what belongs together has the same u in all of them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/silhouette/outline.h"

namespace sporeprint {

/// One control shape of a set: a growth stage of a species, or a model of somebody's own.
struct ControlShape {
    Silhouette silhouette;  ///< metres
    double size =
        1.0;  ///< metres, > 0; the shape is divided by it, because sizes mix apart from shapes
    std::size_t kin =
        0;  ///< shapes of one kin are stages of one species: their control points correspond one to one
    double age = 0.6;  ///< 0..1; the stage nearest to 0.6 speaks for its kin
};

/// The designer's own link between the two species of a pair: what belongs together, in shares of arc length of their outlines.
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

/// The stages of one species among the shapes of a set.
struct Kin {
    std::size_t first = 0, count = 0;
    std::size_t mature = 0;  ///< the shape whose age is nearest to 0.6
};

/// Shapes as nodes at equal steps of the common parameter.
struct AlignedShapes {
    std::vector<Kin> kins;
    std::vector<double> ages;         ///< of the shapes
    std::vector<OutlineNodes> nodes;  ///< of the shapes, each divided by its size
};

/// Finds what belongs together: every stage with the mature one of its kin by control points, every kin with the hub (the first that
/// has the sub-curve) by least work, joins smooth in every mix.
///
/// throws  Impossible for arcs that cross one another or leave their curve (path "/arcs/<i>"), InvalidInput for stages of one kin whose
///         sub-curves differ in their numbers of control points; otherwise as Outline::unproven()
/// source  [Desbenoit2004] sec. 4; [SederbergGreenwood1992]
[[nodiscard]] AlignedShapes aligned(const std::vector<ControlShape>& shapes,
                                    std::span<const Arc> arcs, double arcs_age);

/// Growth weights of the stages of one kin at an age: linear between neighbours, the first and last stage beyond.
[[nodiscard]] std::vector<double> stage_weights(std::span<const double> ages, double age);

}  // namespace sporeprint
