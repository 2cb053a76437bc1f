// The parameters of the soil of a world.
#pragma once

#include "core/params/describe.h"

namespace sporeprint {

/// What the soil of a world is like.
struct SoilParams {
    double acidity = 0.5;

    static constexpr void fields(auto visit) {
        visit(&SoilParams::acidity,
              Info{.name = "acidity",
                   .min = 0,
                   .max = 1,
                   .doc = "How acid the soil is: 0 on chalk, 1 on sand and raw humus. Species and "
                          "kinds of trees differ in what they tolerate.",
                   .step = 0.02});
    }
    bool operator==(const SoilParams&) const = default;
};
static_assert(well_described<SoilParams>());

}  // namespace sporeprint
