// From a photograph and a gesture to the shape of a model.
#pragma once

#include <optional>

#include "core/model/swept.h"
#include "core/params/describe.h"
#include "core/trace/form.h"
#include "core/trace/gesture.h"
#include "core/trace/marked_outline.h"
#include "core/trace/photo.h"

namespace sporeprint::trace {

/// How deep a hollow may be.
inline constexpr double least_hollow = 0.02, most_hollow = 0.95;

/// What a photograph does not tell.
struct TraceParams {
    double height_m = 0.1;
    Form form = Form::automatic;
    double hollow = 0.7;

    static constexpr void fields(auto visit) {
        visit(&TraceParams::height_m, Info{.name = "height_m",
                                           .unit = "m",
                                           .min = 0.001,
                                           .max = 2,
                                           .doc = "Height of the mushroom from foot to top."});
        visit(&TraceParams::form,
              Info{.name = "form",
                   .doc = "What is looked for: capped (stem and cap), funnel (hollow above, "
                          "without an angle below), morel (a head on a stem), club, puffball or "
                          "cup; auto is the form that fits the outline."});
        visit(&TraceParams::hollow,
              Info{.name = "hollow",
                   .min = least_hollow,
                   .max = most_hollow,
                   .doc = "How deep a funnel or cup is, of the height of its edge above its stem: "
                          "from the side its inside is hidden."});
    }
    bool operator==(const TraceParams&) const = default;
};
static_assert(well_described<TraceParams>());

/// How the shape came about. refined: what grows has the contour of the photograph, by comparing both; fitted: as
/// measured; straightened: the axis bends less than on the photograph, because the stem would fold; simplified: the
/// stem is a plain one, because the outline as measured would cross itself; stretched: the outline is that of
/// another mushroom, stretched to the same heights and widths, because neither can be grown.
enum class TraceMethod { refined, fitted, straightened, simplified, stretched };

constexpr const char* name(TraceMethod method) {
    switch (method) {
        case TraceMethod::refined:
            return "refined";
        case TraceMethod::fitted:
            return "fitted";
        case TraceMethod::straightened:
            return "straightened";
        case TraceMethod::simplified:
            return "simplified";
        case TraceMethod::stretched:
            return "template";
    }
    return nullptr;
}

/// A ring on the stem.
struct RingMeasure {
    double height_m = 0.0;  ///< above the foot
    double width_m = 0.0;   ///< how far it stands out from the stem
};

/// A mushroom as it was traced. On the photograph, in its pixels, it is the marked outline that all else was
/// measured on.
struct Traced : MarkedOutline {
    Swept shape;               ///< an outline and an axis; all else is zero
    Form form = Form::capped;  ///< the one that was traced, never Form::automatic
    TraceMethod method = TraceMethod::fitted;
    double error = 0.0;      ///< greatest distance of the outline from the profile, of the height
    double asymmetry = 0.0;  ///< half the mean distance between both sides, of the height
    double lean_deg = 0.0;   ///< of the line from the foot to the top of the stem, to the right
    double bend_deg = 0.0;   ///< between the directions of the axis at the foot and at the cap
    /// How high the camera was above the horizon; none where that cannot be seen, because the lower face is.
    std::optional<double> pitch_deg;
    std::optional<RingMeasure> ring;
};

/// Returns a trace in pixels of another copy of the photograph.
[[nodiscard]] Traced on_copy(Traced traced, double factor);

/// Traces a mushroom seen from the side.
///
/// throws    InvalidInput (paths "/height_m", "/form", "/hollow", below "/gesture") if a parameter is out
///           of range, nothing hangs together on the line, or no cap or stem is found that the form
///           needs; path "/photo" if the mushroom is smaller than 120 pixels or cut off by a
///           border of the photograph; Impossible (path below "/silhouette") if the outline
///           crosses itself
/// cost      about 0.25 s, nearly all of it for the cut
[[nodiscard]] Traced traced(const Picture& photo, const Gesture& gesture,
                            const TraceParams& params);

/// Traces a mask that is known, such as the alpha channel of a picture.
///
/// gesture  in pixels of the mask
[[nodiscard]] Traced traced(const Mask& mask, const Gesture& gesture, const TraceParams& params);

/// An outline as it was found, and the form that it was taken for.
struct FoundOutline {
    MarkedOutline outline;
    Form form = Form::capped;  ///< never Form::automatic
};

/// Returns the outline of a mask with its marks, as the trace above measures it.
///
/// throws    as above, but not Impossible
/// cost      about 20 ms
[[nodiscard]] FoundOutline outline_on(const Mask& mask, const Gesture& gesture, Form form);

/// Traces an outline that was found.
///
/// params    whose form does not count
/// throws    Impossible as above
/// cost      about 25 ms, 10 ms for what has no cap
[[nodiscard]] Traced traced(const FoundOutline& found, const TraceParams& params);

/// Returns another mushroom with the heights and widths of an outline that cannot be grown as it was found.
///
/// other    an outline that can be grown, with the parts of the form that was found
/// params   whose form does not count
/// share    how far it has them at most, 0..1; at 0 it is the other one in another size
[[nodiscard]] Traced stretched(const FoundOutline& found, const TraceParams& params,
                               const Silhouette& other, double share = 1.0);

/// Traces an outline whose marks are known: those of another trace, or as a person has moved them. A trace of
/// the outline that a trace has gives the same shape.
///
/// params   its form is not Form::automatic
/// throws   InvalidInput (paths below "/outline" and "/marks", or "/hollow", "/height_m") if the outline or its
///          marks cannot be measured, or the mushroom is smaller than 120 pixels; Impossible as above
/// cost     about 25 ms
[[nodiscard]] Traced traced(const MarkedOutline& outline, const TraceParams& params);

}  // namespace sporeprint::trace
