// An outline with its marks as it is reported to a person, who may change it and send it back.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "core/trace/axis.h"
#include "core/trace/contour.h"
#include "core/trace/form.h"
#include "core/trace/marks.h"

namespace sporeprint::trace {

/// An outline on a photograph, in its pixels.
struct MarkedOutline {
    static constexpr std::size_t most_points = 256;  ///< of a line

    /// Both sides from the foot to the apex, and the axis from the foot upwards.
    std::vector<glm::dvec2> left, right, axis;
    /// Where stem and lower face or head meet, and the margin: on the left and on the right.
    std::array<glm::dvec2, 2> junctions{}, margins{};
    /// How the cap stands against the stem's top, degrees to the right; none: so that its halves are most alike.
    std::optional<double> cap_turn_deg;

    bool operator==(const MarkedOutline&) const = default;
};

/// What a profile is measured from.
struct MeasuredOutline {
    Contour contour;
    TracedAxis axis;
    Marks marks;
    double height = 0.0;  ///< pixels
};

/// Returns marks as they are reported: few points of each line with the marks among them, and places rounded to
/// hundredths of a pixel. What is measured on these is what is measured when they are sent back.
[[nodiscard]] MarkedOutline reported(const Marks& marks, const TracedAxis& axis);

/// Returns an outline on another copy of the photograph.
[[nodiscard]] MarkedOutline scaled(MarkedOutline outline, double factor);

/// Returns an outline whose places are rounded to hundredths of a pixel, so that the way to another copy of the
/// photograph and back changes none.
[[nodiscard]] MarkedOutline rounded(MarkedOutline outline);

/// Requires that an outline which a person has marked can be measured.
///
/// throws  InvalidInput (paths below "/outline" and "/marks") if a side has too few points, the sides do not
///         begin or end together or are exchanged, the axis leads elsewhere, or a mark is not on its side, not
///         below the apex, or not in order with the other one
void require_measurable(const MarkedOutline& outline, Form form);

/// Returns an outline with the lines between its points and the parts that its marks divide it into.
///
/// form  not Form::automatic
[[nodiscard]] MeasuredOutline measured(const MarkedOutline& outline, Form form);

}  // namespace sporeprint::trace
