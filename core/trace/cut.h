// Which pixels of a photograph are the mushroom: a graph cut led by a gesture.
#pragma once

#include "core/trace/gesture.h"
#include "core/trace/photo.h"

namespace sporeprint::trace {

/// Returns the mushroom on the large working copy of a photograph.
///
/// The energy is that of [Rother2004]: how well each pixel suits the colours of the mushroom and those of
/// the rest, plus the contrast along the border. Every pixel of the mushroom is reached from a stroke
/// through the mushroom alone, on the way that crosses the fewest edges [Gulshan2010], so that
/// neither grass nor neighbours join it. In the first round the colours of the mushroom are those of
/// the strokes, and those of the rest are beyond the frame. The border is then found again on
/// the large copy, two small pixels to either side of it.
///
/// photo    at least 2 x 2 pixels; the large copy is reduced(photo, large_side)
/// gesture  in pixels of the photograph
/// throws   InvalidInput (path below "/gesture") if a stroke of the axis is not on the photograph, or
///          nothing hangs together with it
/// cost     about 0.15 s
[[nodiscard]] Mask cut_out(const Picture& photo, const Gesture& gesture);

/// Returns the mushroom on a large working copy, as above.
///
/// large    a photograph whose long side is at most large_side
/// gesture  in pixels of the copy, with an axis of at least two points
[[nodiscard]] Mask cut_out_of_copy(const Picture& large, const Gesture& gesture);

/// Requires that a gesture has an axis, and that all its strokes are on a photograph.
///
/// throws   InvalidInput (paths below "/gesture")
void require_on(const PictureSize& photo, const Gesture& gesture);

}  // namespace sporeprint::trace
