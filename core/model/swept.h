// Shape family "swept": an outline of three sub-curves, rotated about an axis.
#pragma once

#include <string>
#include <vector>

#include "core/params/describe.h"
#include "core/params/types.h"

namespace sporeprint {

/// A control point of an outline in the half-plane of the axis.
struct OutlinePoint {
    double r = 0.0;
    double y = 0.0;

    static constexpr void fields(auto visit) {
        visit(&OutlinePoint::r, Info{.name = "r",
                                     .unit = "m",
                                     .min = 0.0,
                                     .max = 1.0,
                                     .doc = "Distance from the axis."});
        visit(&OutlinePoint::y, Info{.name = "y",
                                     .unit = "m",
                                     .min = -0.5,
                                     .max = 2.0,
                                     .doc = "Height above the ground, with a straight axis."});
    }
    bool operator==(const OutlinePoint&) const = default;
};

/// The kind of join between two sub-curves.
enum class Join { corner, smooth };

constexpr const char* name(Join join) {
    switch (join) {
        case Join::corner:
            return "corner";
        case Join::smooth:
            return "smooth";
    }
    return nullptr;
}

/// The curve C of [Desbenoit2004]: three sub-curves of spline control points, from the base of the
/// stem to the apex of the cap. Each sub-curve begins where the one before it ends. `hymenium` is
/// empty for a form without a lower face (a club).
struct Silhouette {
    std::vector<OutlinePoint> stem;
    std::vector<OutlinePoint> hymenium;
    std::vector<OutlinePoint> cap;
    Join junction = Join::corner;
    Join margin = Join::smooth;

    static constexpr void fields(auto visit) {
        visit(&Silhouette::stem,
              Info{.name = "stem",
                   .most = 32,
                   .doc = "Stem, from the centre of its base up to the hymenium."});
        visit(
            &Silhouette::hymenium,
            Info{
                .name = "hymenium",
                .most = 32,
                .doc =
                    "Lower face, from the stem out to the margin; starts at the last stem point."});
        visit(&Silhouette::cap, Info{.name = "cap",
                                     .most = 32,
                                     .doc = "Upper face, from the margin in to the apex on the "
                                            "axis; starts at the last point before it."});
        visit(&Silhouette::junction,
              Info{.name = "junction",
                   .doc = "How stem and hymenium meet: a corner, or one smooth curve."});
        visit(&Silhouette::margin,
              Info{.name = "margin",
                   .doc = "How hymenium and cap meet: a sharp edge, or one smooth curve."});
    }
    /// Reports sub-curves with too few points, with equal successive points or that do not begin
    /// where the one before them ends, and an outline that does not begin and end on the axis.
    /// Defined in core/silhouette/outline.cpp.
    void check(const std::string& path, std::vector<Problem>& problems) const;
    bool operator==(const Silhouette&) const = default;
};

/// A control point of the axis, in units of the stem's height.
struct AxisPoint {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;

    static constexpr void fields(auto visit) {
        visit(&AxisPoint::x,
              Info{.name = "x", .min = -2.0, .max = 2.0, .doc = "Sideways, in stem heights."});
        visit(&AxisPoint::y,
              Info{.name = "y", .min = -2.0, .max = 2.0, .doc = "Upwards, in stem heights."});
        visit(&AxisPoint::z,
              Info{.name = "z", .min = -2.0, .max = 2.0, .doc = "Forwards, in stem heights."});
    }
    bool operator==(const AxisPoint&) const = default;
};

/// The dependence of the radius on the angle; with all amounts 0 the shape is a surface of
/// revolution. The front is +z. "Widest radius" is that of the outline.
struct Azimuth {
    /// How lateral is what begins to grow from a wall.
    static constexpr double wall_from = 0.25;

    double lateral = 0.0;
    double fan_deg = 90.0;
    double width = 1.0;
    double core = 0.1;
    double base = 0.0;
    int lobes = 0;
    double lobe_depth = 0.0;
    double lobe_sharpness = 0.0;
    double lobe_uneven = 0.3;
    double lobe_from = 0.3;
    double lobe_pull = 0.0;
    double lobe_root = 0.5;
    int lobe_spread = 0;
    double lobe_lift = 0.0;

    static constexpr void fields(auto visit) {
        using A = Azimuth;
        visit(&A::lateral, Info{.name = "lateral",
                                .min = 0,
                                .max = 1,
                                .doc = "0 round, 1 a fan that grows forwards from a wall behind it "
                                       "(brackets, oysters); the axis then stands at the wall."});
        visit(&A::fan_deg, Info{.name = "fan_deg",
                                .unit = "deg",
                                .min = 20,
                                .max = 130,
                                .doc = "How far a fan opens to each side of its front: 40 is a "
                                       "wedge, 90 half a disc, 120 a kidney."});
        visit(&A::width, Info{.name = "width",
                              .min = 0.3,
                              .max = 2.5,
                              .doc = "Reach of a fan to each side, over that to its front: below 1 "
                                     "a tongue, above 1 a shelf."});
        visit(&A::core, Info{.name = "core",
                             .min = 0.02,
                             .max = 0.6,
                             .doc = "Share of the widest radius that a fan leaves round: its stem, "
                                    "or how far it reaches into the wall."});
        visit(&A::base,
              Info{.name = "base",
                   .min = 0,
                   .max = 8,
                   .doc = "How much thicker a bracket becomes where it meets its wood: its "
                          "lower face runs down the bark there; 0 not at all."});
        visit(&A::lobes,
              Info{.name = "lobes", .min = 0, .max = 24, .doc = "Lobes or rays round the margin."});
        visit(&A::lobe_depth, Info{.name = "lobe_depth",
                                   .min = 0,
                                   .max = 0.9,
                                   .doc = "How far the notches between lobes go in; 0 is none."});
        visit(&A::lobe_sharpness, Info{.name = "lobe_sharpness",
                                       .min = -1,
                                       .max = 1,
                                       .doc = "1 pointed rays, 0 waves, -1 scallops: round lobes "
                                              "with sharp notches."});
        visit(&A::lobe_uneven, Info{.name = "lobe_uneven",
                                    .min = 0,
                                    .max = 1,
                                    .doc = "How unlike the lobes are in width and reach."});
        visit(&A::lobe_from,
              Info{.name = "lobe_from",
                   .min = 0.05,
                   .max = 0.9,
                   .doc = "Share of the widest radius that has no lobes; they begin there."});
        visit(&A::lobe_pull, Info{.name = "lobe_pull",
                                  .min = 0,
                                  .max = 1,
                                  .doc = "How far notches draw back in height too, as between rays "
                                         "that stand up or bend down."});
        visit(&A::lobe_root, Info{.name = "lobe_root",
                                  .min = 0,
                                  .max = 1,
                                  .doc = "Height that notches draw back to; 0 is the lowest point "
                                         "of the outline, 1 the highest."});
        visit(&A::lobe_spread, Info{.name = "lobe_spread",
                                    .min = 0,
                                    .max = 3,
                                    .doc = "Individuals have up to so many lobes more or fewer."});
        visit(&A::lobe_lift,
              Info{.name = "lobe_lift",
                   .min = 0,
                   .max = 0.5,
                   .doc = "How far some lobes stand above others, in widest radii."});
    }
    bool operator==(const Azimuth&) const = default;
};

/// Relief of the upper face, displaced from the outline along its normal: crests lie on the
/// outline, the rest below. Depths are shares of the length of the face's meridian. The positions
/// of creases and pits depend on the seed and on the counts, not on the depths.
struct ReliefStyle {
    double folds = 0.0;
    int fold_count = 5;
    double crests = 0.0;
    double pits = 0.0;
    int pit_columns = 14;
    int pit_rows = 8;
    double rib = 0.3;
    double tiers = 0.0;
    int tier_count = 5;

    static constexpr void fields(auto visit) {
        using R = ReliefStyle;
        visit(&R::folds, Info{.name = "folds",
                              .min = 0,
                              .max = 0.3,
                              .doc = "Depth of winding creases between folds, as of a brain "
                                     "(jellies), in lengths of the meridian."});
        visit(&R::fold_count, Info{.name = "fold_count",
                                   .min = 2,
                                   .max = 16,
                                   .doc = "About how many folds lie across the face."});
        visit(&R::crests, Info{.name = "crests",
                               .min = 0,
                               .max = 1,
                               .doc = "0 swollen folds with narrow creases between them, 1 thin "
                                      "crests with wide hollows between them."});
        visit(&R::pits, Info{.name = "pits",
                             .min = 0,
                             .max = 0.2,
                             .doc = "Depth of the pits of a honeycomb (morels, stinkhorns), in "
                                    "lengths of the meridian."});
        visit(&R::pit_columns, Info{.name = "pit_columns",
                                    .min = 3,
                                    .max = 40,
                                    .doc = "Pits round the face where it is widest."});
        visit(&R::pit_rows, Info{.name = "pit_rows",
                                 .min = 2,
                                 .max = 30,
                                 .doc = "Rows of pits from the apex to the margin."});
        visit(&R::rib, Info{.name = "rib",
                            .min = 0,
                            .max = 1,
                            .doc = "Width of the ribs between pits: 0 sharp, 1 as wide as the "
                                   "pits."});
        visit(&R::tiers, Info{.name = "tiers",
                              .min = 0,
                              .max = 0.1,
                              .doc = "Depth of the grooves between concentric tiers (perennial "
                                     "brackets), in lengths of the meridian."});
        visit(&R::tier_count, Info{.name = "tier_count",
                                   .min = 1,
                                   .max = 20,
                                   .doc = "Tiers from the apex to the margin."});
    }
    /// Returns true if any depth is positive.
    [[nodiscard]] constexpr bool any() const { return folds > 0.0 || pits > 0.0 || tiers > 0.0; }
    bool operator==(const ReliefStyle&) const = default;
};

/// Shape family "swept": an outline rotated about an axis.
struct Swept {
    static constexpr const char* form = "swept";
    Silhouette silhouette;
    std::vector<AxisPoint> axis;
    Azimuth azimuth{};
    ReliefStyle relief{};

    static constexpr void fields(auto visit) {
        visit(&Swept::silhouette, Info{.name = "silhouette", .doc = "The outline."});
        visit(&Swept::axis, Info{.name = "axis",
                                 .most = 16,
                                 .doc = "Spline control points of the axis, ground to stem top; "
                                        "empty for a straight stem."});
        visit(&Swept::azimuth,
              Info{.name = "azimuth", .doc = "How the radius depends on the angle."});
        visit(&Swept::relief, Info{.name = "relief", .doc = "Relief of the upper face."});
    }
    bool operator==(const Swept&) const = default;
};

}  // namespace sporeprint
