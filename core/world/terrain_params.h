// The parameters of the shape of a world's ground.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/params/describe.h"
#include "core/params/messages.h"

namespace sporeprint {

/// Returns true if a text has the form of an id of a terrain: "t-" and 32 hexadecimal digits.
[[nodiscard]] constexpr bool is_terrain_id(std::string_view text) {
    return text.size() == 34 && text.starts_with("t-") &&
           text.find_first_not_of("0123456789abcdef", 2) == std::string_view::npos;
}

/// Heights of the ground of a world.
struct TerrainParams {
    double relief = 60.0;
    double feature = 400.0;
    double roughness = 0.47;
    double erosion = 0.5;
    double micro = 0.06;
    Text<34> id = {};

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
        visit(&T::id, Info{.name = "id",
                           .most = 34,
                           .doc = "A terrain that was sent to /v1/terrains, in place of hills that "
                                  "are grown; of the other parameters of the terrain only micro "
                                  "has a meaning then."});
    }
    void check(const std::string& path, std::vector<Problem>& problems) const {
        if (!id.empty() && !is_terrain_id(id.view()))
            report(problems, path + "/id",
                   in_quotes(id.view()) +
                       " is no id of a terrain, which is t- and 32 "
                       "hexadecimal digits");
    }
    bool operator==(const TerrainParams&) const = default;
};
static_assert(well_described<TerrainParams>());

}  // namespace sporeprint
