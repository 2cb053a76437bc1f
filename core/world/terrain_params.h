// The parameters of the shape of a world's ground.
#pragma once

#include "core/params/describe.h"

namespace sporeprint {

/// Heights of the ground of a world.
struct TerrainParams {
    double relief = 60.0;
    double feature = 400.0;
    double roughness = 0.47;
    double erosion = 0.5;
    double micro = 0.06;

    static constexpr void fields(auto visit) {
        using T = TerrainParams;
        visit(&T::relief,
              Info{.name = "relief",
                   .unit = "m",
                   .min = 0,
                   .max = 600,
                   .doc = "Difference of height between high and low ground before erosion: 19 of "
                          "20 places of an endless world lie within it.",
                   .step = 5});
        visit(&T::feature, Info{.name = "feature",
                                .unit = "m",
                                .min = 50,
                                .max = 2000,
                                .doc = "Size of the largest hills and valleys.",
                                .step = 10});
        visit(&T::roughness,
              Info{.name = "roughness",
                   .min = 0.3,
                   .max = 0.7,
                   .doc = "How high details are compared with those twice their size.",
                   .step = 0.01});
        visit(&T::erosion, Info{.name = "erosion",
                                .min = 0,
                                .max = 1,
                                .doc = "How long running water has cut valleys into the hills.",
                                .step = 0.02});
        visit(&T::micro, Info{.name = "micro",
                              .unit = "m",
                              .min = 0,
                              .max = 0.3,
                              .doc = "Height of the smallest bumps, of 4 m and less, which plots "
                                     "show and maps do not.",
                              .step = 0.01});
    }
    bool operator==(const TerrainParams&) const = default;
};
static_assert(well_described<TerrainParams>());

}  // namespace sporeprint
