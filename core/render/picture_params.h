// The parameters of a picture of a product: its size, the view and the background.
#pragma once

#include "core/params/describe.h"

namespace sporeprint {

/// Where the camera is. A turntable is a sheet of eight views from all sides; margin, underside and base
/// are close-ups.
enum class View { three_quarter, front, top, below, turntable, margin, underside, base };

constexpr const char* name(View view) {
    switch (view) {
        case View::three_quarter:
            return "three_quarter";
        case View::front:
            return "front";
        case View::top:
            return "top";
        case View::below:
            return "below";
        case View::turntable:
            return "turntable";
        case View::margin:
            return "margin";
        case View::underside:
            return "underside";
        case View::base:
            return "base";
    }
    return nullptr;
}

enum class Background { transparent, white, grey, black };

constexpr const char* name(Background background) {
    switch (background) {
        case Background::transparent:
            return "transparent";
        case Background::white:
            return "white";
        case Background::grey:
            return "grey";
        case Background::black:
            return "black";
    }
    return nullptr;
}

/// Columns and rows of the sheet of a turntable.
inline constexpr int turntable_columns = 4, turntable_rows = 2;

/// The query parameters of a picture beside those of the product that it shows.
struct PictureParams {
    int width = 256;
    int height = 256;
    View view = View::three_quarter;
    double turn_deg = 0.0;
    Background background = Background::transparent;

    static constexpr void fields(auto visit) {
        using P = PictureParams;
        visit(&P::width, Info{.name = "width",
                              .unit = "pixels",
                              .min = 16,
                              .max = 1024,
                              .doc = "Width of the picture; of one view of a turntable.",
                              .group = "picture"});
        visit(&P::height, Info{.name = "height",
                               .unit = "pixels",
                               .min = 16,
                               .max = 1024,
                               .doc = "Height of the picture; of one view of a turntable.",
                               .group = "picture"});
        visit(&P::view,
              Info{.name = "view",
                   .doc = "From above and one side, from the front, straight from above, from "
                          "below to show the hymenium, or a sheet of four by two views from all "
                          "sides, where the camera comes as near as the picture allows; or a "
                          "close-up: 5 cm at the margin, 6 cm of the underside, 8 cm at the base, "
                          "more of the base of what is taller than 64 cm.",
                   .group = "picture"});
        visit(&P::turn_deg, Info{.name = "turn_deg",
                                 .unit = "deg",
                                 .min = -180,
                                 .max = 180,
                                 .doc = "How far the camera goes round the product, to its right.",
                                 .group = "picture"});
        visit(&P::background,
              Info{.name = "background",
                   .doc = "Transparent, with the shadow on the ground as translucent black; or a "
                          "colour behind product and shadow.",
                   .group = "picture"});
    }
    /// Refuses sheets of more than four million pixels.
    void check(const std::string& path, std::vector<Problem>& problems) const {
        constexpr int most = 512;
        if (view != View::turntable) return;
        for (const auto& [name, side] : {std::pair{"/width", width}, {"/height", height}})
            if (side > most)
                report(problems, path + name,
                       std::to_string(side) + " is outside 16.." + std::to_string(most) +
                           " for each view of a turntable");
    }
    bool operator==(const PictureParams&) const = default;
};

}  // namespace sporeprint
