// What a person draws on a photograph to say where the mushroom is.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "core/trace/photo.h"

namespace sporeprint::trace {

/// A stroke through points in pixels of the photograph, from its upper left corner.
using Stroke = std::vector<glm::dvec2>;

/// A rectangle in pixels of the photograph.
struct PhotoFrame {
    glm::dvec2 from{0.0}, to{0.0};  ///< upper left and lower right corner
};

/// The T gesture: a line from the foot to the top and one across the cap, and what corrects them.
struct Gesture {
    Stroke axis;                      ///< from the foot to the top, at least two points
    Stroke cap;                       ///< across the cap; may be empty
    std::vector<Stroke> keep, drop;   ///< on the mushroom; on what is none of it
    std::optional<PhotoFrame> frame;  ///< what is outside is background

    /// Returns the same gesture on a photograph of another size.
    [[nodiscard]] Gesture scaled(double factor) const;
};

/// Returns the line from the foot of an upright mask to its top: the middle of its lowest twentieth on the lowest
/// row, and that of its upper quarter on the highest one; none of an empty mask.
[[nodiscard]] Stroke upright_line(const Mask& mask);

/// Returns true if a line goes down on the photograph, and what it is on is not clearly wider where it ends: it was
/// drawn from the top to the foot. One that goes down towards the wider half is that of a mushroom on its
/// head.
///
/// axis  at least two points, in pixels of the mask
[[nodiscard]] bool is_reversed(const Stroke& axis, const Mask& mask);

/// Returns a stroke without those ends at which a mask is hardly wider than the stroke itself: it was drawn beyond what
/// it is on, and the mask has it there for no other reason. Narrow is also what is less than three tenths of how wide
/// the mask is at half of the stroke's points. An end of more than a fifth of the stroke stays, since it
/// may be a thin stem.
///
/// width  of the stroke in the mask, pixels
[[nodiscard]] Stroke without_overshoot(const Stroke& stroke, const Mask& mask, double width);

/// Returns the pixels within half a width of strokes; what lies beyond the border is left out.
///
/// width  of the strokes, pixels
[[nodiscard]] Mask drawn(const std::vector<Stroke>& strokes, int columns, int rows, double width);

}  // namespace sporeprint::trace
