// The spore-bearing layer: its pattern and the dimensions of its gills, ridges, pores or teeth.
#pragma once

#include "core/params/describe.h"
#include "core/params/types.h"

namespace sporeprint {

/// The structure of the spore-bearing layer.
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

}  // namespace sporeprint
