// The border of a mask as a smooth closed polygon.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "core/trace/photo.h"

namespace sporeprint::trace {

/// Points in pixels from the upper left corner, x to the right and y down; the last is joined with the first.
/// The mask is on the right of each edge as it is seen on the photograph.
using Contour = std::vector<glm::dvec2>;

/// Returns the border of a mask: evenly spaced points on the midpoints of the edges of its pixels, smoothed
/// by a Gaussian along the border.
///
/// mask   one part without holes, at least one pixel
/// sigma  of the Gaussian, pixels; 0 for none
/// cost   O(border * sigma)
[[nodiscard]] Contour contour_of(const Mask& mask, double sigma);

/// Returns the pixels whose middles are inside a contour: those with an odd number of its edges to their left.
///
/// cost   O(pixels + rows * points)
[[nodiscard]] Mask inside_of(const Contour& contour, const PictureSize& size);

/// Returns how far each point of an open line is along it: 0 for the first.
[[nodiscard]] std::vector<double> arc_lengths(const std::vector<glm::dvec2>& line);

/// Returns the distance of a point from the line between two others.
[[nodiscard]] double distance_from_segment(const glm::dvec2& point, const glm::dvec2& from,
                                           const glm::dvec2& to);

/// Returns the area within a contour, square pixels.
[[nodiscard]] double area_of(const Contour& contour);

/// Returns the distance at which a ray first meets a contour; none if it misses it.
///
/// direction  unit vector
[[nodiscard]] std::optional<double> first_hit(const Contour& contour, const glm::dvec2& from,
                                              const glm::dvec2& direction);

}  // namespace sporeprint::trace
