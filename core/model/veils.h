// Veils and skin that tear with growth: warts and scales, volva and sac, ring, and the amounts that
// remain of them.
#pragma once

#include "core/params/describe.h"
#include "core/params/types.h"

namespace sporeprint {

/// Patches of torn veil or skin: warts (pyramids) and scales (flaps). Sizes are in shares of the
/// young cap's meridian.
struct PatchStyle {
    int count = 0;
    double size = 0.05;
    double unevenness = 0.0;
    double height = 0.5;
    double elongation = 1.0;
    double lift = 0.0;
    double fray = 0.0;
    double from = 0.0;
    double to = 1.0;

    static constexpr void fields(auto visit) {
        using P = PatchStyle;
        visit(&P::count,
              Info{.name = "count", .min = 0, .max = 1600, .doc = "Pieces on the whole cap."});
        visit(&P::size, Info{.name = "size",
                             .min = 0.005,
                             .max = 0.3,
                             .doc = "Radius of a piece, in lengths of the young cap's meridian."});
        visit(&P::unevenness, Info{.name = "unevenness",
                                   .min = 0,
                                   .max = 1,
                                   .doc = "How unlike the pieces are in size: 0 nearly alike, 1 a "
                                          "few large ones among many granules."});
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
        visit(&P::fray,
              Info{.name = "fray",
                   .min = 0,
                   .max = 1,
                   .doc = "How ragged the rims of warts are; how far scales are frayed into "
                          "tufts of hairs, which are painted alone."});
        visit(&P::from, Info{.name = "from",
                             .min = 0,
                             .max = 1,
                             .doc = "Where on the meridian the pieces begin; 0 is the apex."});
        visit(&P::to, Info{.name = "to",
                           .min = 0,
                           .max = 1,
                           .doc = "Where on the meridian the pieces end; 1 is the margin."});
    }
    /// Returns true if another style has its patches at the same places, in the same kind of
    /// outline and in the same order of size; sizes may differ.
    [[nodiscard]] constexpr bool has_places_of(const PatchStyle& other) const {
        return count == other.count && from == other.from && to == other.to &&
               elongation == other.elongation && fray == other.fray &&
               unevenness == other.unevenness;
    }
    bool operator==(const PatchStyle&) const = default;
};

/// A ring on the stem: the remnant of the partial veil.
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

/// Amounts of the ornaments on the surface. Their places are drawn once per individual; amounts
/// only scale them.
template <template <class> class M>
struct OrnamentsOf {
    M<double> warts{};
    M<double> scales{};
    M<double> ring{};
    M<double> volva = preset<M>(1.0);
    M<double> peridioles = preset<M>(1.0);
    M<double> receptacle = preset<M>(1.0);
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
        visit(&O::peridioles, Info{.name = "peridioles",
                                   .min = 0,
                                   .max = 1,
                                   .doc = "How many peridioles are left in a bird's nest; rain "
                                          "splashes them out."});
        visit(&O::receptacle, Info{.name = "receptacle",
                                   .min = 0,
                                   .max = 1,
                                   .doc = "How far the net of a cage fungus has unfolded out of "
                                          "its egg."});
        visit(&O::glow, Info{.name = "glow",
                             .min = 0,
                             .max = 1,
                             .doc = "Light of its own, as some species give at night."});
    }
    bool operator==(const OrnamentsOf&) const = default;
};

}  // namespace sporeprint
