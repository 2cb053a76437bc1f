// From a photograph and a gesture to the shape of a model.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "core/model/swept.h"
#include "core/trace/contour.h"
#include "core/trace/gesture.h"
#include "core/trace/photo.h"

namespace sporeprint::trace {

/// How the shape came about. fitted: as measured; straightened: the axis bends less than on the photograph,
/// because the stem would fold.
enum class TraceMethod { fitted, straightened };

constexpr const char* name(TraceMethod method) {
    switch (method) {
        case TraceMethod::fitted:
            return "fitted";
        case TraceMethod::straightened:
            return "straightened";
    }
    return nullptr;
}

/// A ring on the stem.
struct RingMeasure {
    double height_m = 0.0;  ///< above the foot
    double width_m = 0.0;   ///< how far it stands out from the stem
};

/// A mushroom as it was traced.
struct Traced {
    Swept shape;  ///< an outline and an axis; all else is zero
    TraceMethod method = TraceMethod::fitted;
    double error = 0.0;      ///< greatest distance of the outline from the profile, of the height
    double asymmetry = 0.0;  ///< half the mean distance between both sides, of the height
    double lean_deg = 0.0;   ///< of the line from the foot to the top of the stem, to the right
    double bend_deg = 0.0;   ///< between the directions of the axis at the foot and at the cap
    std::optional<RingMeasure> ring;
    /// On the photograph, in its pixels: both sides from the foot to the apex, and the axis.
    std::vector<glm::dvec2> left, right, axis;
    /// Where stem and lower face meet, and the margin: on the left and on the right.
    std::array<glm::dvec2, 2> junctions{}, margins{};
};

/// Traces a mushroom with a stem and a cap, seen from the side.
///
/// height_m  from the foot to the top, metres, more than 0
/// throws    InvalidInput (paths below "/gesture", "/form") if nothing hangs together on the line, no
///           cap stands out, or the mushroom is smaller than 120 pixels or cut off by a border of the
///           photograph (path "/photo"); Impossible (path below "/silhouette") if the outline
///           crosses itself
/// cost      about 0.25 s, nearly all of it for the cut
[[nodiscard]] Traced traced(const Picture& photo, const Gesture& gesture, double height_m);

/// Traces a mask that is known, such as the alpha channel of a picture.
///
/// gesture  in pixels of the mask
[[nodiscard]] Traced traced(const Mask& mask, const Gesture& gesture, double height_m);

}  // namespace sporeprint::trace
