// Where the parts of a mushroom meet on its contour: margin, junction and apex.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "core/trace/axis.h"
#include "core/trace/contour.h"
#include "core/trace/form.h"

namespace sporeprint::trace {

/// One side of a contour, from the foot up to the apex.
struct ContourSide {
    std::vector<glm::dvec2> points;  ///< pixels
    /// Distance outwards from the axis and arc length along it from the foot, pixels.
    std::vector<glm::dvec2> local;
    std::size_t junction = 0;  ///< where the stem meets the lower face or the head
    std::size_t margin = 0;    ///< the edge of the cap, junction <= margin; equal for a head
};

/// The marks of both sides, and how the cap stands on the stem.
struct Marks {
    Form form = Form::capped;          ///< never Form::automatic
    std::array<ContourSide, 2> sides;  ///< to the left and to the right of the axis
    double stem_top = 0.0;             ///< arc length of the axis where the stem ends, pixels
    double cap_turn_deg = 0.0;  ///< of the cap against the stem's top, to the right where positive
    double rim =
        0.0;  ///< of a cup: mean height of its edge above the stem's top, in its frame, pixels
    /// Whether the stem ends at an angle on both sides; where it does not, the junction is where the outline
    /// turns outwards most, or where it begins to widen.
    bool has_corner = true;
};

/// The frame of a cap: its origin is the top of the stem, and its upward direction turns with the cap.
struct CapFrame {
    glm::dvec2 origin, right, up;

    /// turn_deg  of the cap against the axis, to the right where positive
    CapFrame(const TracedAxis& axis, double stem_top, double turn_deg);

    /// Returns how far a point is to the right of the origin and above it, pixels.
    [[nodiscard]] glm::dvec2 local(const glm::dvec2& point) const;
};

/// Returns the form that a mushroom is most like; never Form::automatic or Form::morel, whose outline a capped
/// mushroom may have too.
[[nodiscard]] Form likely_form(const Contour& contour, const TracedAxis& axis, double height);

/// Finds the parts of a mushroom of a form.
///
/// capped    the margin is the sharpest convex place far from the axis; the junction is the first place
///           below it that is nearly as near to the axis as the stem, moved to the most concave one
///           nearby
/// funnel    the margin as of a cap; the stem ends where it begins to widen
/// cup       the margin is where the top begins; the stem ends where it begins to widen
/// morel     the head begins at the most concave place below its widest one
/// puffball  the head begins where the stem begins to widen
/// club      the head begins at a fixed share of the height
///
/// height   of the mushroom, pixels
/// form     not Form::automatic
/// throws   InvalidInput (path "/form") if no cap stands out from the stem, or there is no stem
[[nodiscard]] Marks marks_of(const Contour& contour, const TracedAxis& axis, double height,
                             Form form);

/// Returns the marks of a mushroom on whose sides junction and margin are known.
///
/// sides         with points from the foot to the apex, and the indices of both marks
/// cap_turn_deg  none: that at which both halves of the cap are most alike
[[nodiscard]] Marks marks_at(std::array<ContourSide, 2> sides, const TracedAxis& axis,
                             double height, Form form, std::optional<double> cap_turn_deg);

}  // namespace sporeprint::trace
