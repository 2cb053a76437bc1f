// The mushroom as plain data: the paper's tuple (skeleton, silhouette, deformation, images), plus ornaments and weathering.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "core/model/branched.h"
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

/// How two sub-curves meet.
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

/// The paper's curve C: three sub-curves of spline control points, from the base of the stem to the apex of the cap.
/// Each sub-curve begins where the one before it ends. A form that has no lower face (a club) leaves `hymenium` empty.
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
    void check(const std::string& path,
               std::vector<Problem>& problems) const;  // core/silhouette/outline.cpp
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

/// How the radius depends on the angle; all amounts 0 is a figure of revolution. The front is +z. "Widest radius" is that of the outline.
struct Azimuth {
    double lateral = 0.0;
    double fan_deg = 90.0;
    double width = 1.0;
    double core = 0.1;
    int lobes = 0;
    double lobe_depth = 0.0;
    double lobe_sharpness = 0.0;
    double lobe_uneven = 0.3;
    double lobe_from = 0.3;
    double lobe_pull = 0.0;
    double lobe_root = 0.5;

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
    }
    bool operator==(const Azimuth&) const = default;
};

/// Relief of the upper face, added to the outline along its normal: crests lie on the outline, the rest below. Depths are shares of
/// the face's meridian. Places are drawn once per individual; depths only scale them.
struct ReliefStyle {
    double folds = 0.0;
    int fold_count = 5;
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
    /// Whether any of it is there.
    [[nodiscard]] constexpr bool any() const { return folds > 0.0 || pits > 0.0 || tiers > 0.0; }
    bool operator==(const ReliefStyle&) const = default;
};

/// Shape family "swept": an outline turned round an axis.
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

/// The paper's deformation D. `Maybe` is Plain in a Model and std::optional in a request.
template <template <class> class M>
struct DeformationOf {
    M<double> bend_deg{};
    M<double> twist_deg{};
    M<double> lean_deg{};
    M<double> taper{};
    M<double> zone_from{};
    M<double> zone_to = preset<M>(1.0);
    M<double> imperfection{};

    static constexpr void fields(auto visit) {
        using D = DeformationOf;
        visit(&D::bend_deg, Info{.name = "bend_deg",
                                 .unit = "deg",
                                 .min = 0,
                                 .max = 90,
                                 .doc = "How far the stem turns over its bending zone; the "
                                        "direction is the individual's own."});
        visit(&D::twist_deg, Info{.name = "twist_deg",
                                  .unit = "deg",
                                  .min = -180,
                                  .max = 180,
                                  .doc = "Twist of the stem's surface over its bending zone."});
        visit(&D::lean_deg, Info{.name = "lean_deg",
                                 .unit = "deg",
                                 .min = 0,
                                 .max = 45,
                                 .doc = "Lean of the whole mushroom from the vertical."});
        visit(&D::taper, Info{.name = "taper",
                              .min = -1,
                              .max = 1,
                              .doc = "Stem wider (positive) or narrower (negative) at the start of "
                                     "the bending zone."});
        visit(&D::zone_from, Info{.name = "zone_from",
                                  .min = 0,
                                  .max = 0.9,
                                  .doc = "Where the zone of influence of bend, twist and taper "
                                         "begins; 0 is the ground, 1 the stem top."});
        visit(&D::zone_to, Info{.name = "zone_to",
                                .min = 0.1,
                                .max = 1,
                                .doc = "Where the zone of influence ends; 1 is the stem top."});
        visit(&D::imperfection, Info{.name = "imperfection",
                                     .min = 0,
                                     .max = 1,
                                     .doc = "Dents and bulges by local free-form deformation."});
    }
    void check(const std::string& path, std::vector<Problem>& problems) const {
        const std::optional<double> from = zone_from, to = zone_to;
        // 1 - 0.9 is a little less than 0.1 in binary.
        if (from && to && *to - *from < 0.1 - 1e-9)
            problems.push_back({path + "/zone_to", "must exceed zone_from by at least 0.1"});
    }
    bool operator==(const DeformationOf&) const = default;
};

/// Amounts of what stands on the surface. Where it stands is drawn once per individual; amounts only scale it.
template <template <class> class M>
struct OrnamentsOf {
    M<double> warts{};
    M<double> scales{};
    M<double> ring{};
    M<double> volva = preset<M>(1.0);
    M<double> glow{};

    static constexpr void fields(auto visit) {
        using O = OrnamentsOf;
        visit(&O::warts, Info{.name = "warts",
                              .min = 0,
                              .max = 1,
                              .doc = "How much of the universal veil is left as warts on the cap; "
                                     "rain washes them off."});
        visit(&O::scales, Info{.name = "scales",
                               .min = 0,
                               .max = 1,
                               .doc = "How far the torn skin of the cap stands out as scales."});
        visit(&O::ring, Info{.name = "ring",
                             .min = 0,
                             .max = 1,
                             .doc = "How much of the partial veil is left as a ring on the stem."});
        visit(&O::volva,
              Info{.name = "volva",
                   .min = 0,
                   .max = 1,
                   .doc = "How much of the universal veil is left at the base of the stem: a sac "
                          "round it, or scales on the bulb."});
        visit(&O::glow, Info{.name = "glow",
                             .min = 0,
                             .max = 1,
                             .doc = "Light of its own, as some species give at night."});
    }
    bool operator==(const OrnamentsOf&) const = default;
};

/// What carries the spores.
enum class HymeniumPattern { smooth, gills, ridges, pores, teeth };

constexpr const char* name(HymeniumPattern pattern) {
    switch (pattern) {
        case HymeniumPattern::smooth:
            return "smooth";
        case HymeniumPattern::gills:
            return "gills";
        case HymeniumPattern::ridges:
            return "ridges";
        case HymeniumPattern::pores:
            return "pores";
        case HymeniumPattern::teeth:
            return "teeth";
    }
    return nullptr;
}

template <template <class> class M>
struct HymeniumOf {
    M<int> blades = preset<M>(60);
    M<int> tiers = preset<M>(2);
    M<double> forking{};
    M<double> pores_per_mm = preset<M>(1.5);
    M<double> relief = preset<M>(0.7);
    M<double> depth = preset<M>(0.16);
    M<double> thickness = preset<M>(0.26);
    M<double> inner_gap{};
    M<double> inner_depth = preset<M>(0.8);
    M<double> notch{};
    M<double> decurrent{};
    M<double> edge_waves = preset<M>(0.15);
    M<double> elongation = preset<M>(1.0);

    static constexpr void fields(auto visit) {
        using H = HymeniumOf;
        visit(&H::blades, Info{.name = "blades",
                               .min = 8,
                               .max = 400,
                               .doc = "Gills or ridges that reach the stem."});
        visit(
            &H::tiers,
            Info{.name = "tiers",
                 .min = 0,
                 .max = 3,
                 .doc =
                     "Tiers of shorter gills (lamellulae) that fill the gaps towards the margin."});
        visit(&H::forking, Info{.name = "forking",
                                .min = 0,
                                .max = 1,
                                .doc = "How often ridges fork and are joined by cross veins."});
        visit(&H::pores_per_mm, Info{.name = "pores_per_mm",
                                     .unit = "1/mm",
                                     .min = 0.2,
                                     .max = 6,
                                     .doc = "Pores or spines along a millimetre."});
        visit(&H::relief, Info{.name = "relief",
                               .min = 0,
                               .max = 1,
                               .doc = "How deep gills, ridges or pores look."});
        visit(&H::depth,
              Info{.name = "depth",
                   .min = 0,
                   .max = 0.6,
                   .doc = "How deep gills, ridges and tubes are and how long spines are, in "
                          "lengths of the lower face from stem to margin."});
        visit(&H::thickness, Info{.name = "thickness",
                                  .min = 0.05,
                                  .max = 1,
                                  .doc = "Thickness of a blade or spine, in gaps between two."});
        visit(&H::inner_gap, Info{.name = "inner_gap",
                                  .min = 0,
                                  .max = 0.5,
                                  .doc = "Share of the lower face by which gills, tubes or spines "
                                         "keep away from the stem (free)."});
        visit(&H::inner_depth, Info{.name = "inner_depth",
                                    .min = 0,
                                    .max = 1,
                                    .doc = "Depth where they end at the stem: 0 free, a little "
                                           "adnexed, all of it adnate."});
        visit(&H::notch,
              Info{.name = "notch",
                   .min = 0,
                   .max = 1,
                   .doc = "How deeply their edge is notched before the stem (sinuate)."});
        visit(&H::decurrent, Info{.name = "decurrent",
                                  .min = 0,
                                  .max = 1,
                                  .doc = "Share of the stem that they run down, from its top."});
        visit(&H::edge_waves,
              Info{.name = "edge_waves", .min = 0, .max = 1, .doc = "Waves of the blades."});
        visit(&H::elongation, Info{.name = "elongation",
                                   .min = 0.5,
                                   .max = 4,
                                   .doc = "Length of a pore along the meridian over its width."});
    }
    bool operator==(const HymeniumOf&) const = default;
};

/// What time, weather and others did. Where it happened is drawn once per individual; amounts only open, deepen and spread it.
template <template <class> class M>
struct WeatheringOf {
    M<double> cracks{};
    M<double> creases{};
    M<double> peel{};
    M<double> splits{};
    M<double> bites{};
    M<double> bumps{};
    M<double> waves{};
    M<double> deliquescence{};
    M<double> fade{};
    M<double> bruise{};
    M<double> dust{};
    M<double> dew{};
    M<double> wetness{};

    static constexpr void fields(auto visit) {
        using W = WeatheringOf;
        visit(&W::cracks, Info{.name = "cracks",
                               .min = 0,
                               .max = 1,
                               .doc = "Dry skin torn open down to the flesh: a net of islands, or "
                                      "splits from the margin inwards where the cap has spread."});
        visit(&W::creases, Info{.name = "creases",
                                .min = 0,
                                .max = 1,
                                .doc = "Lengthwise furrows of a drying stem; the deepest split."});
        visit(&W::peel, Info{.name = "peel",
                             .min = 0,
                             .max = 1,
                             .doc = "Skin come off from the margin inwards, its border rolled up "
                                    "over the flesh."});
        visit(&W::splits,
              Info{.name = "splits",
                   .min = 0,
                   .max = 1,
                   .doc = "Tears of the margin through cap and lower face, towards the stem."});
        visit(&W::bites, Info{.name = "bites",
                              .min = 0,
                              .max = 1,
                              .doc = "What slugs have eaten: arcs out of the margin, shallow pits "
                                     "in cap and stem."});
        visit(&W::bumps,
              Info{.name = "bumps", .min = 0, .max = 1, .doc = "Lumps and hollows of the skin."});
        visit(&W::waves,
              Info{.name = "waves",
                   .min = 0,
                   .max = 1,
                   .doc = "Waves of the margin, which has grown longer than its circle."});
        visit(&W::deliquescence,
              Info{.name = "deliquescence",
                   .min = 0,
                   .max = 1,
                   .doc = "How far the cap of an inkcap has melted from the margin into black "
                          "ink, on top of its age."});
        visit(&W::fade,
              Info{.name = "fade", .min = 0, .max = 1, .doc = "Bleaching by sun and rain."});
        visit(&W::bruise, Info{.name = "bruise",
                               .min = 0,
                               .max = 1,
                               .doc = "Stains where it was handled, in the species' own colour."});
        visit(&W::dust, Info{.name = "dust",
                             .min = 0,
                             .max = 1,
                             .doc = "Spores that have settled on stem, ring and cap, in the colour "
                                    "of the spore print."});
        visit(&W::dew, Info{.name = "dew", .min = 0, .max = 1, .doc = "Drops of water."});
        visit(&W::wetness, Info{.name = "wetness",
                                .min = 0,
                                .max = 1,
                                .doc = "A film of water: darker and glossier."});
    }
    bool operator==(const WeatheringOf&) const = default;
};

/// What of the weathering is painted: all but the waves of the margin.
template <template <class> class M>
struct PaintedWeathering {
    M<double> cracks{}, creases{}, peel{}, splits{}, bites{}, bumps{}, deliquescence{}, fade{},
        bruise{}, dust{}, dew{}, wetness{};

    static constexpr void fields(auto visit) {
        using P = PaintedWeathering;
        using W = WeatheringOf<M>;
        visit(&P::cracks, info_of<W>("cracks"));
        visit(&P::creases, info_of<W>("creases"));
        visit(&P::peel, info_of<W>("peel"));
        visit(&P::splits, info_of<W>("splits"));
        visit(&P::bites, info_of<W>("bites"));
        visit(&P::bumps, info_of<W>("bumps"));
        visit(&P::deliquescence, info_of<W>("deliquescence"));
        visit(&P::fade, info_of<W>("fade"));
        visit(&P::bruise, info_of<W>("bruise"));
        visit(&P::dust, info_of<W>("dust"));
        visit(&P::dew, info_of<W>("dew"));
        visit(&P::wetness, info_of<W>("wetness"));
    }
    bool operator==(const PaintedWeathering&) const = default;
};

template <template <class> class M>
[[nodiscard]] PaintedWeathering<M> painted_of(const WeatheringOf<M>& w) {
    return {w.cracks,        w.creases, w.peel,   w.splits, w.bites, w.bumps,
            w.deliquescence, w.fade,    w.bruise, w.dust,   w.dew,   w.wetness};
}

/// The same amounts, with nothing said of waves.
template <template <class> class M>
[[nodiscard]] WeatheringOf<M> as_weathering(const PaintedWeathering<M>& p) {
    WeatheringOf<M> w;
    w.cracks = p.cracks;
    w.creases = p.creases;
    w.peel = p.peel;
    w.splits = p.splits;
    w.bites = p.bites;
    w.bumps = p.bumps;
    w.deliquescence = p.deliquescence;
    w.fade = p.fade;
    w.bruise = p.bruise;
    w.dust = p.dust;
    w.dew = p.dew;
    w.wetness = p.wetness;
    return w;
}

/// Upper face: colours run from the apex (first) to the margin (last).
struct CapSurface {
    std::vector<Colour> ramp = {{200, 160, 120}, {180, 140, 100}};
    double ramp_noise = 0.3;
    double fibrils = 0.0;
    int fibril_count = 90;
    double zones = 0.0;
    int zone_count = 6;
    double patches = 0.0;
    double patch_size = 0.01;
    Colour patch_colour = {230, 210, 180};
    double streaks = 0.0;
    double veins = 0.0;
    double striae = 0.0;
    double bumps = 0.2;
    double roughness = 0.6;
    Colour hollow = {120, 90, 60};
    double hollow_tint = 0.0;
    Upload image;

    static constexpr void fields(auto visit) {
        using C = CapSurface;
        visit(&C::ramp, Info{.name = "ramp",
                             .most = 6,
                             .doc = "Colours along the meridian, apex to margin, evenly spaced."});
        visit(&C::ramp_noise, Info{.name = "ramp_noise",
                                   .min = 0,
                                   .max = 1,
                                   .doc = "How unevenly the ramp's borders run."});
        visit(&C::fibrils,
              Info{.name = "fibrils", .min = 0, .max = 1, .doc = "Strength of radial fibres."});
        visit(&C::fibril_count, Info{.name = "fibril_count",
                                     .min = 8,
                                     .max = 400,
                                     .doc = "Radial fibres round the cap."});
        visit(&C::zones,
              Info{.name = "zones", .min = 0, .max = 1, .doc = "Strength of concentric bands."});
        visit(&C::zone_count, Info{.name = "zone_count",
                                   .min = 1,
                                   .max = 30,
                                   .doc = "Concentric bands between apex and margin."});
        visit(&C::patches, Info{.name = "patches",
                                .min = 0,
                                .max = 1,
                                .doc = "Share of the face that wears the patch colour."});
        visit(&C::patch_size, Info{.name = "patch_size",
                                   .unit = "m",
                                   .min = 0.0005,
                                   .max = 0.1,
                                   .doc = "Size of a patch."});
        visit(&C::patch_colour, Info{.name = "patch_colour", .doc = "Colour of the patches."});
        visit(&C::streaks, Info{.name = "streaks",
                                .min = 0,
                                .max = 1,
                                .doc = "Strength of irregular radial streaks of darker colour."});
        visit(&C::veins, Info{.name = "veins",
                              .min = 0,
                              .max = 1,
                              .doc = "Raised net of veins, strongest at the centre (cups)."});
        visit(&C::striae,
              Info{.name = "striae",
                   .min = 0,
                   .max = 1,
                   .doc = "Share of the radius that is grooved from the margin inwards."});
        visit(&C::bumps,
              Info{.name = "bumps", .min = 0, .max = 1, .doc = "Fine unevenness of the skin."});
        visit(&C::roughness,
              Info{.name = "roughness", .min = 0.05, .max = 1, .doc = "0 is polished, 1 is matt."});
        visit(&C::hollow, Info{.name = "hollow",
                               .doc = "Colour in the hollows of the relief: pits, creases, "
                                      "grooves."});
        visit(&C::hollow_tint, Info{.name = "hollow_tint",
                                    .min = 0,
                                    .max = 1,
                                    .doc = "How much of that colour the hollows show."});
        visit(&C::image,
              Info{.name = "image",
                   .most = 3000000,
                   .doc = "The paper's own way: a PNG, JPEG or WebP of the cap seen from above, up "
                          "to 2048 x 2048, used instead of the painting."});
    }
    bool operator==(const CapSurface&) const = default;
};

/// Lower face.
struct HymeniumSurface {
    HymeniumPattern pattern = HymeniumPattern::gills;
    Colour colour = {240, 230, 210};
    Colour edge = {240, 230, 210};
    Colour depth = {190, 170, 140};
    double mottle = 0.2;
    double roughness = 0.8;
    Upload image;

    static constexpr void fields(auto visit) {
        using H = HymeniumSurface;
        visit(&H::pattern,
              Info{.name = "pattern", .doc = "Gills, ridges, pores, teeth or a smooth face."});
        visit(&H::colour,
              Info{.name = "colour", .doc = "Colour of the faces of the gills, or between pores."});
        visit(&H::edge,
              Info{.name = "edge", .doc = "Colour of the edges of gills or the rims of pores."});
        visit(&H::depth,
              Info{.name = "depth", .doc = "Colour deep between the gills or inside the pores."});
        visit(
            &H::mottle,
            Info{.name = "mottle", .min = 0, .max = 1, .doc = "Cloudy unevenness of the colour."});
        visit(&H::roughness,
              Info{.name = "roughness", .min = 0.05, .max = 1, .doc = "0 is polished, 1 is matt."});
        visit(&H::image, Info{.name = "image",
                              .most = 3000000,
                              .doc = "A PNG, JPEG or WebP of the lower face, up to 2048 x 2048, "
                                     "used instead of the painting."});
    }
    bool operator==(const HymeniumSurface&) const = default;
};

/// Stem: `base` is the ground end.
struct StemSurface {
    Colour top = {240, 230, 210};
    Colour base = {220, 200, 170};
    double base_stain = 0.2;
    Colour stain = {120, 90, 60};
    double fibrils = 0.3;
    double bands = 0.0;
    Colour band_colour = {160, 130, 100};
    double net = 0.0;
    Colour net_colour = {242, 234, 219};
    double bumps = 0.2;
    double roughness = 0.75;
    Upload image;

    static constexpr void fields(auto visit) {
        using S = StemSurface;
        visit(&S::top, Info{.name = "top", .doc = "Colour at the hymenium."});
        visit(&S::base, Info{.name = "base", .doc = "Colour at the ground."});
        visit(&S::base_stain, Info{.name = "base_stain",
                                   .min = 0,
                                   .max = 1,
                                   .doc = "Share of the stem that is stained from the ground up."});
        visit(&S::stain, Info{.name = "stain", .doc = "Colour of the stain."});
        visit(&S::fibrils,
              Info{.name = "fibrils", .min = 0, .max = 1, .doc = "Strength of lengthwise fibres."});
        visit(&S::bands, Info{.name = "bands",
                              .min = 0,
                              .max = 1,
                              .doc = "Strength of zig-zag bands (snake skin)."});
        visit(&S::band_colour, Info{.name = "band_colour", .doc = "Colour of the bands."});
        visit(&S::net, Info{.name = "net",
                            .min = 0,
                            .max = 1,
                            .doc = "Raised net, strongest in the upper third (boletes)."});
        visit(&S::net_colour, Info{.name = "net_colour", .doc = "Colour of the net."});
        visit(&S::bumps,
              Info{.name = "bumps", .min = 0, .max = 1, .doc = "Fine unevenness of the skin."});
        visit(&S::roughness,
              Info{.name = "roughness", .min = 0.05, .max = 1, .doc = "0 is polished, 1 is matt."});
        visit(
            &S::image,
            Info{.name = "image",
                 .most = 3000000,
                 .doc = "A PNG, JPEG or WebP of the stem unrolled (ground at the left, once round "
                        "from top to bottom), up to 2048 x 2048, used instead of the painting."});
    }
    bool operator==(const StemSurface&) const = default;
};

/// Veil: ring, warts, scales.
struct VeilSurface {
    Colour colour = {248, 244, 230};
    Colour tip = {240, 226, 190};
    double roughness = 0.85;

    static constexpr void fields(auto visit) {
        visit(&VeilSurface::colour,
              Info{.name = "colour", .doc = "Colour of ring, warts and the base of scales."});
        visit(&VeilSurface::tip,
              Info{.name = "tip",
                   .doc = "Colour of the edge of the ring and the tips of warts and scales."});
        visit(&VeilSurface::roughness,
              Info{.name = "roughness", .min = 0.05, .max = 1, .doc = "0 is polished, 1 is matt."});
    }
    bool operator==(const VeilSurface&) const = default;
};

/// What a tear, a bite or a crack lays open.
struct FleshSurface {
    Colour colour = {244, 238, 222};
    double roughness = 0.9;

    static constexpr void fields(auto visit) {
        visit(&FleshSurface::colour,
              Info{.name = "colour", .doc = "Colour of the flesh under the skin."});
        visit(&FleshSurface::roughness,
              Info{.name = "roughness", .min = 0.05, .max = 1, .doc = "0 is polished, 1 is matt."});
    }
    bool operator==(const FleshSurface&) const = default;
};

/// What weathering shows of a species: its colours, and how its skin gives way.
struct ScarSurface {
    Colour faded = {226, 204, 160};
    Colour bruise = {132, 92, 58};
    Colour dust = {246, 240, 226};
    double cracking = 0.0;
    double peel_reach = 0.4;

    static constexpr void fields(auto visit) {
        using S = ScarSurface;
        visit(&S::faded,
              Info{.name = "faded", .doc = "Colour that sun and rain leave of the cap."});
        visit(&S::bruise, Info{.name = "bruise", .doc = "Colour where it was handled."});
        visit(&S::dust, Info{.name = "dust", .doc = "Colour of the spore print."});
        visit(&S::cracking,
              Info{.name = "cracking",
                   .min = -1,
                   .max = 1,
                   .doc = "0: the cap cracks as its growth has strained it; towards -1 into a net "
                          "of islands, towards 1 from the margin inwards."});
        visit(&S::peel_reach,
              Info{.name = "peel_reach",
                   .min = 0,
                   .max = 1,
                   .doc = "How far the skin can be peeled off, in shares of the cap's meridian "
                          "from the margin."});
    }
    bool operator==(const ScarSurface&) const = default;
};

/// The paper's images I, as what to paint.
struct Surface {
    CapSurface cap;
    HymeniumSurface hymenium;
    StemSurface stem;
    VeilSurface veil;
    FleshSurface flesh;
    ScarSurface scars;

    static constexpr void fields(auto visit) {
        visit(&Surface::cap, Info{.name = "cap", .doc = "Upper face."});
        visit(&Surface::hymenium, Info{.name = "hymenium", .doc = "Lower face."});
        visit(&Surface::stem, Info{.name = "stem", .doc = "Stem."});
        visit(&Surface::veil, Info{.name = "veil", .doc = "Ring, warts and scales."});
        visit(&Surface::flesh, Info{.name = "flesh", .doc = "What tears lay open."});
        visit(&Surface::scars, Info{.name = "scars", .doc = "What weathering shows."});
    }
    bool operator==(const Surface&) const = default;
};

/// Pieces of torn veil or skin: warts (pyramids) and scales (flaps). Sizes in shares of the young cap's meridian.
struct PatchStyle {
    int count = 0;
    double size = 0.05;
    double height = 0.5;
    double elongation = 1.0;
    double lift = 0.0;
    double from = 0.0;
    double to = 1.0;

    static constexpr void fields(auto visit) {
        using P = PatchStyle;
        visit(&P::count,
              Info{.name = "count", .min = 0, .max = 400, .doc = "Pieces on the whole cap."});
        visit(&P::size, Info{.name = "size",
                             .min = 0.005,
                             .max = 0.3,
                             .doc = "Radius of a piece, in lengths of the young cap's meridian."});
        visit(&P::height, Info{.name = "height",
                               .min = 0,
                               .max = 2,
                               .doc = "Height of a piece, in its own radii."});
        visit(&P::elongation, Info{.name = "elongation",
                                   .min = 0.3,
                                   .max = 4,
                                   .doc = "Length along the meridian over width."});
        visit(
            &P::lift,
            Info{.name = "lift",
                 .min = -1,
                 .max = 1,
                 .doc =
                     "How far the tip points to the apex (negative) or to the margin (positive)."});
        visit(&P::from, Info{.name = "from",
                             .min = 0,
                             .max = 1,
                             .doc = "Where on the meridian the pieces begin; 0 is the apex."});
        visit(&P::to, Info{.name = "to",
                           .min = 0,
                           .max = 1,
                           .doc = "Where on the meridian the pieces end; 1 is the margin."});
    }
    bool operator==(const PatchStyle&) const = default;
};

/// A ring on the stem: what is left of the partial veil.
struct RingStyle {
    double height = 0.7;
    double width = 0.0;
    double flare_deg = 60.0;
    double thickness = 0.0006;
    double ruffle = 0.3;
    double hang = 0.45;
    double edge = 0.0;
    double gap = 0.0;
    double grooves = 0.0;
    double tear = 0.0;

    static constexpr void fields(auto visit) {
        using R = RingStyle;
        visit(&R::height, Info{.name = "height",
                               .min = 0,
                               .max = 1,
                               .doc = "Where it is attached; 0 is the ground, 1 the stem top."});
        visit(&R::width, Info{.name = "width",
                              .unit = "m",
                              .min = 0,
                              .max = 0.1,
                              .doc = "From the stem to its edge; 0 is no ring."});
        visit(&R::flare_deg, Info{.name = "flare_deg",
                                  .unit = "deg",
                                  .min = 0,
                                  .max = 120,
                                  .doc = "0 hangs down along the stem, 90 stands out flat."});
        visit(&R::hang, Info{.name = "hang",
                             .min = 0,
                             .max = 1,
                             .doc = "How far it bends down towards its edge; 1 is a skirt whose "
                                    "edge hangs along the stem."});
        visit(&R::thickness, Info{.name = "thickness",
                                  .unit = "m",
                                  .min = 0.0001,
                                  .max = 0.01,
                                  .doc = "Thickness of the veil."});
        visit(&R::edge, Info{.name = "edge",
                             .min = 0,
                             .max = 1,
                             .doc = "How far its edge swells into a double one."});
        visit(&R::gap, Info{.name = "gap",
                            .min = 0,
                            .max = 1,
                            .doc = "Clearance from the stem, in its radii but at most the ring's "
                                   "own width: a ring that has come loose and can be moved."});
        visit(&R::ruffle, Info{.name = "ruffle", .min = 0, .max = 1, .doc = "Waves of its edge."});
        visit(&R::grooves, Info{.name = "grooves",
                                .min = 0,
                                .max = 1,
                                .doc = "Grooves that the gills pressed into it."});
        visit(&R::tear, Info{.name = "tear",
                             .min = 0,
                             .max = 1,
                             .doc = "How far its edge is torn into fibrils; 1 with a low flare is "
                                    "what is left of a cobweb (cortina)."});
    }
    bool operator==(const RingStyle&) const = default;
};

/// A sac-like volva: the universal veil as a cup of skin round the base of the stem.
struct SacStyle {
    double height = 0.0;
    double gap = 0.1;
    double hold = 0.7;
    double tear = 0.5;
    double thickness = 0.0012;

    static constexpr void fields(auto visit) {
        using S = SacStyle;
        visit(&S::height, Info{.name = "height",
                               .unit = "m",
                               .min = 0,
                               .max = 0.15,
                               .doc = "From the ground to its highest lobe; 0 is no sac."});
        visit(&S::gap, Info{.name = "gap",
                            .min = 0,
                            .max = 0.6,
                            .doc = "How far its edge stands off, in its own heights."});
        visit(&S::hold, Info{.name = "hold",
                             .min = 0,
                             .max = 1,
                             .doc = "0 follows the stem as it narrows above the bulb, 1 keeps the "
                                    "bulb's width."});
        visit(&S::tear,
              Info{.name = "tear", .min = 0, .max = 1, .doc = "Depth of the rents between lobes."});
        visit(&S::thickness, Info{.name = "thickness",
                                  .unit = "m",
                                  .min = 0.0001,
                                  .max = 0.01,
                                  .doc = "Thickness of the skin."});
    }
    bool operator==(const SacStyle&) const = default;
};

/// What light does beyond colour and roughness: optional material extensions of the file.
struct Material {
    double slime = 0.0;
    double velvet = 0.0;
    Colour glow_colour = {150, 255, 190};

    static constexpr void fields(auto visit) {
        using S = Material;
        visit(
            &S::slime,
            Info{.name = "slime", .min = 0, .max = 1, .doc = "A clear coat of slime on the cap."});
        visit(&S::velvet, Info{.name = "velvet",
                               .min = 0,
                               .max = 1,
                               .doc = "Sheen of fine hairs against the light."});
        visit(&S::glow_colour,
              Info{.name = "glow_colour",
                   .doc = "Light from inside, where it glows; the skin's own colour filters it."});
    }
    bool operator==(const Material&) const = default;
};

/// Everything that makes one mushroom. Plain data, no behaviour.
struct Model {
    std::variant<Swept, Branched> shape;
    DeformationOf<Plain> deformation;
    HymeniumOf<Plain> hymenium;
    PatchStyle warts;
    PatchStyle scales;
    PatchStyle volva;
    SacStyle sac;
    RingStyle ring;
    OrnamentsOf<Plain> ornaments;
    WeatheringOf<Plain> weathering;
    Surface surface;
    Material material;

    static constexpr void fields(auto visit) {
        visit(&Model::shape, Info{.name = "", .doc = "Shape family."});
        visit(&Model::deformation,
              Info{.name = "deformation", .doc = "Axial and free-form deformation."});
        visit(&Model::hymenium, Info{.name = "hymenium", .doc = "Gills, ridges, pores or teeth."});
        visit(&Model::warts,
              Info{.name = "warts", .doc = "Remnants of the universal veil on the cap."});
        visit(&Model::scales, Info{.name = "scales", .doc = "Scales of the cap's torn skin."});
        visit(
            &Model::volva,
            Info{.name = "volva",
                 .doc =
                     "Scales on the bulb; positions run from the ground (0) to the stem top (1) of "
                     "the mature stem, and stay on the skin where it grows."});
        visit(&Model::sac, Info{.name = "sac", .doc = "A sac round the base of the stem."});
        visit(&Model::ring, Info{.name = "ring", .doc = "Ring on the stem."});
        visit(&Model::ornaments,
              Info{.name = "ornaments", .doc = "How much is left of the veils; glow."});
        visit(&Model::weathering, Info{.name = "weathering", .doc = "What time and weather did."});
        visit(&Model::surface, Info{.name = "surface", .doc = "What is painted."});
        visit(&Model::material, Info{.name = "material", .doc = "Slime, velvet and glow."});
    }
    bool operator==(const Model&) const = default;
};

}  // namespace sporeprint
