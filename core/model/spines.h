// The hanging spines of tooth fungi.
#pragma once

#include "core/params/describe.h"

namespace sporeprint {

/// Long spines that hang from a cushion or from branches (Hericium), or upright folds that wind over a
/// cushion (jellies): solids at every level of detail, painted as the hymenium that they are. The
/// short teeth of a hedgehog's lower face are a pattern of the hymenium instead.
struct SpineStyle {
    int count = 0;
    double length = 0.01;
    double width = 0.0008;
    double from = 0.0;
    double to = 1.0;
    double droop = 0.8;
    double unevenness = 0.4;
    double shortening = 0.0;
    double shag = 0.0;
    double stand = 0.15;
    double breadth = 0.0;
    double meander = 0.5;

    static constexpr void fields(auto visit) {
        using S = SpineStyle;
        visit(&S::count, Info{.name = "count",
                              .min = 0,
                              .max = 6000,
                              .doc = "Spines at level of detail 0; coarser ones have fewer and "
                                     "thicker ones."});
        visit(&S::length, Info{.name = "length",
                               .unit = "m",
                               .min = 0,
                               .max = 0.2,
                               .doc = "Length of the longest spines."});
        visit(&S::width, Info{.name = "width",
                              .unit = "m",
                              .min = 0.00002,
                              .max = 0.02,
                              .doc = "Diameter of a spine at its base."});
        visit(&S::from, Info{.name = "from",
                             .min = 0,
                             .max = 2,
                             .doc = "Where on the meridian spines begin: 0 at the stem, 1 at the "
                                    "margin, 2 at the apex; without a lower face 0 where the cap "
                                    "begins, 2 at the apex. Of corals: 0 at the lowest fork, 1 at "
                                    "the tips."});
        visit(&S::to, Info{.name = "to",
                           .min = 0,
                           .max = 2,
                           .doc = "Where on the meridian spines end, in the same measure."});
        visit(&S::droop, Info{.name = "droop",
                              .min = 0,
                              .max = 1,
                              .doc = "0 stands square to the surface, 1 hangs straight down."});
        visit(&S::unevenness, Info{.name = "unevenness",
                                   .min = 0,
                                   .max = 1,
                                   .doc = "How unlike spines are in length."});
        visit(&S::shortening,
              Info{.name = "shortening",
                   .min = 0,
                   .max = 1,
                   .doc = "How much shorter spines become towards `to`, as the felt "
                          "on top of a cushion is."});
        visit(&S::shag, Info{.name = "shag",
                             .min = 0,
                             .max = 1,
                             .doc = "0 spines of one kind, 1 shaggy hair: bent, each its own way, "
                                    "and gathered in tufts."});
        visit(&S::stand, Info{.name = "stand",
                              .min = 0,
                              .max = 0.5,
                              .doc = "How far a spine stands out before it hangs, in its own "
                                     "lengths; spines that droop less stand out farther."});
        visit(&S::breadth,
              Info{.name = "breadth",
                   .min = 0,
                   .max = 20,
                   .doc = "0: round spines. Otherwise upright folds that run along the surface for "
                          "so many of their widths; `length` is their height."});
        visit(&S::meander, Info{.name = "meander",
                                .min = 0,
                                .max = 1,
                                .doc = "How much such a fold winds, and how uneven its crest is."});
    }
    /// Returns true for upright folds in place of round spines.
    [[nodiscard]] constexpr bool is_folded() const { return breadth > 0.0; }
    bool operator==(const SpineStyle&) const = default;
};

}  // namespace sporeprint
