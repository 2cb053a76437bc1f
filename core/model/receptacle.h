// What stomach fungi form inside: the peridioles of bird's nests and the receptacle of cages.
#pragma once

#include "core/params/describe.h"

namespace sporeprint {

/// Peridioles: lens-shaped packets of spores that lie in the cup of a bird's nest fungus. They have
/// the colour of the flesh.
struct PeridioleStyle {
    int count = 0;
    double size = 0.0015;
    double thickness = 0.4;
    double reach = 0.4;

    static constexpr void fields(auto visit) {
        using P = PeridioleStyle;
        visit(&P::count,
              Info{.name = "count", .min = 0, .max = 60, .doc = "Peridioles in a full cup."});
        visit(&P::size, Info{.name = "size",
                             .unit = "m",
                             .min = 0.0001,
                             .max = 0.02,
                             .doc = "Diameter of a peridiole."});
        visit(&P::thickness, Info{.name = "thickness",
                                  .min = 0.1,
                                  .max = 1,
                                  .doc = "Thickness of a peridiole over its diameter."});
        visit(&P::reach, Info{.name = "reach",
                              .min = 0.05,
                              .max = 0.9,
                              .doc = "Share of the inner face's meridian, from the bottom of the "
                                     "cup, on which they lie."});
    }
    bool operator==(const PeridioleStyle&) const = default;
};

/// A receptacle: the hollow net of spongy arms that a cage fungus unfolds out of its egg. The arms
/// have the colour of the veil, and their inner sides, which bear the gleba, that of its tips.
struct ReceptacleStyle {
    int meshes = 0;
    double height = 0.1;
    double width = 0.08;
    double base = -0.002;
    double widest = 0.55;
    double neck = 0.3;
    double arm = 0.01;
    double flatness = 0.3;
    double stretch = 0.3;

    static constexpr void fields(auto visit) {
        using R = ReceptacleStyle;
        visit(&R::meshes, Info{.name = "meshes",
                               .min = 0,
                               .max = 40,
                               .doc = "Meshes of the net; 0 is no receptacle, otherwise at least 4 "
                                      "are formed. Coarse levels of detail have fewer."});
        visit(&R::height, Info{.name = "height",
                               .unit = "m",
                               .min = 0.001,
                               .max = 0.5,
                               .doc = "From its base to its top."});
        visit(&R::width, Info{.name = "width",
                              .unit = "m",
                              .min = 0.001,
                              .max = 0.5,
                              .doc = "Diameter where it is widest."});
        visit(&R::base, Info{.name = "base",
                             .unit = "m",
                             .min = -0.1,
                             .max = 0.5,
                             .doc = "Height of its base above the middle of the upper face, in "
                                    "which it is rooted."});
        visit(&R::widest, Info{.name = "widest",
                               .min = 0.2,
                               .max = 0.9,
                               .doc = "Share of its height at which it is widest."});
        visit(&R::neck, Info{.name = "neck",
                             .min = 0.05,
                             .max = 1,
                             .doc = "Its radius at the base over that where it is widest."});
        visit(&R::arm, Info{.name = "arm",
                            .unit = "m",
                            .min = 0.0002,
                            .max = 0.1,
                            .doc = "Width of an arm between two meshes."});
        visit(&R::flatness, Info{.name = "flatness",
                                 .min = 0,
                                 .max = 0.9,
                                 .doc = "How much thinner than wide an arm is."});
        visit(&R::stretch, Info{.name = "stretch",
                                .min = 0,
                                .max = 1,
                                .doc = "How much longer the meshes of its base are than those of "
                                       "its top."});
    }
    bool operator==(const ReceptacleStyle&) const = default;
};

}  // namespace sporeprint
