// A photograph as it is traced: pixels of a size at which every step is fast.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/surface/codecs.h"

namespace sporeprint::trace {

/// Long sides of the working copies, pixels: the cut is found on the small one and refined on the large
/// one.
inline constexpr int small_side = 320, large_side = 1024;

/// A size of a picture, pixels.
struct PictureSize {
    int width = 0, height = 0;
};

/// Returns the size of a copy of the shape of the original whose long side is at most a given one: that of the
/// original if it is no longer.
///
/// side  at least 1
[[nodiscard]] PictureSize reduced_size(int width, int height, int side);

/// Returns a copy by the mean of the area that each of its pixels covers, of the shape of the original; the
/// original if its long side is no longer.
///
/// side  of the long side of the copy, pixels, at least 1
[[nodiscard]] Picture reduced(const Picture& photo, int side);

/// The pixels of a photograph that belong to the mushroom: rows from top to bottom.
struct Mask {
    int width = 0, height = 0;
    std::vector<std::uint8_t> inside;  ///< 1 or 0 for each pixel

    Mask() = default;
    Mask(int columns, int rows, bool value = false)
        : width(columns),
          height(rows),
          inside(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
                 value ? 1 : 0) {}

    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
    /// Returns false beyond the borders.
    [[nodiscard]] bool at(int x, int y) const {
        return x >= 0 && y >= 0 && x < width && y < height && inside[index(x, y)] != 0;
    }
    /// Returns the pixel that contains a place; false beyond the borders.
    [[nodiscard]] bool at(const glm::dvec2& place) const {
        return at(static_cast<int>(std::floor(place.x)), static_cast<int>(std::floor(place.y)));
    }
    [[nodiscard]] std::size_t area() const;
    bool operator==(const Mask&) const = default;
};

/// Calls `visit` with each pixel of a mask, row by row: x, y, and its middle.
template <class Visit>
void each_pixel(const Mask& mask, Visit visit) {
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x)
            if (mask.at(x, y)) visit(x, y, glm::dvec2(x + 0.5, y + 0.5));
}

/// Returns the part of a mask that hangs together, by edges of pixels, with any pixel of another one.
[[nodiscard]] Mask connected_with(const Mask& mask, const Mask& seeds);

/// Returns a mask whose holes are filled: what does not hang together with the border is inside.
[[nodiscard]] Mask without_holes(const Mask& mask);

/// Returns the largest part of a mask that hangs together by edges of pixels; of two as large, the upper one.
[[nodiscard]] Mask largest_part(const Mask& mask);

/// Returns the pixels that are not in a mask.
[[nodiscard]] Mask inverted(const Mask& mask);

/// Returns the union of all squares inside a mask: spurs that are narrower are gone.
///
/// reach  pixels of a square to each side of its middle, 1 for three by three
[[nodiscard]] Mask opened(const Mask& mask, int reach = 1);

/// Returns a mask of another size, by the pixels in which the middles of its own lie.
[[nodiscard]] Mask resized(const Mask& mask, int width, int height);

}  // namespace sporeprint::trace
