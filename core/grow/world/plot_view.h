// Where the camera of a picture of a plot stands.
#pragma once

#include "core/grow/world/plot.h"
#include "core/render/render.h"

namespace sporeprint {

/// Who looks at a plot: somebody who stands at its edge, somebody who kneels there, a camera on a mast beside it, or one
/// straight above it.
enum class PlotView { standing, kneeling, aslant, top };

constexpr const char* name(PlotView view) {
    switch (view) {
        case PlotView::standing:
            return "standing";
        case PlotView::kneeling:
            return "kneeling";
        case PlotView::aslant:
            return "aslant";
        case PlotView::top:
            return "top";
    }
    return nullptr;
}

/// What is behind a plot: the sky of its day, with the world round it where somebody stands or kneels on it; or nothing,
/// or a colour.
enum class PlotBackground { sky, transparent, white, grey, black };

constexpr const char* name(PlotBackground background) {
    switch (background) {
        case PlotBackground::sky:
            return "sky";
        case PlotBackground::transparent:
            return "transparent";
        case PlotBackground::white:
            return "white";
        case PlotBackground::grey:
            return "grey";
        case PlotBackground::black:
            return "black";
    }
    return nullptr;
}

/// Returns the camera of a view of a plot. Somebody who kneels looks at the most fruit bodies that stand together, if
/// there are any. Who stands or kneels steps aside where a trunk would be in the way.
///
/// turn_deg  from where it looks: 0 from the south, 90 from the east
[[nodiscard]] StandingCamera camera_of(const PlotContent& content, PlotView view, double turn_deg);

}  // namespace sporeprint
