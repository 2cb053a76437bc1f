// The shortest ways from strokes through a photograph: what a mushroom hangs together by.
#pragma once

#include <cstdint>
#include <vector>

#include "core/trace/photo.h"

namespace sporeprint::trace {

/// How far each pixel is from strokes, and the way there.
struct Geodesics {
    static constexpr std::uint8_t none = 8;
    std::vector<double> distance;  ///< pixels; longer across edges
    std::vector<std::uint8_t>
        towards;  ///< the first step of the way, of grid_steps; none on a stroke
};

/// Returns twice the inverse mean square of the difference of neighbouring colours, halved: the
/// contrast that counts as an edge.
///
/// returns  0 for a photograph of one colour
/// source   [Rother2004] eq. 5
[[nodiscard]] double contrast_scale(const Picture& photo);

/// Returns the shortest ways from all strokes. A step of length l between colours that differ by d costs
/// l sqrt(0.3 + 0.7 min(50, 2 beta d^2)).
///
/// strokes  at least one pixel
/// beta     contrast_scale()
/// source   [Gulshan2010] sec. 3, geodesic star convexity
[[nodiscard]] Geodesics geodesics_from(const Mask& strokes, const Picture& photo, double beta);

/// Returns the square of the distance of two colours of a photograph.
[[nodiscard]] double colour_difference(const Picture& photo, std::size_t a, std::size_t b);

}  // namespace sporeprint::trace
