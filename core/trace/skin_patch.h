// A part of a mushroom's skin as a photograph shows it, laid flat: what is hidden filled, its shade taken away.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "core/math/elementary.h"
#include "core/surface/codecs.h"
#include "core/trace/hue.h"
#include "core/trace/photo.h"

namespace sporeprint::trace {

/// Sides of the images of a disc, and length of that of a strip, texels.
inline constexpr int image_side = 512;

/// A part of which less is seen has no image.
inline constexpr double least_seen = 0.4;

/// Returns the value at a place between the texels of a grid: `texel` of whole columns and rows.
template <class Texel>
glm::dvec3 between_texels(double x, double y, Texel texel) {
    const auto left = static_cast<std::size_t>(x), top = static_cast<std::size_t>(y);
    const double right = x - static_cast<double>(left), down = y - static_cast<double>(top);
    return (1.0 - down) * ((1.0 - right) * texel(left, top) + right * texel(left + 1, top)) +
           down * ((1.0 - right) * texel(left, top + 1) + right * texel(left + 1, top + 1));
}

/// Reads linear light between the pixels of a photograph, which outlives it.
class PhotoLight {
  public:
    explicit PhotoLight(const Picture& picture);

    /// Returns the pixel that contains a place, which is on the photograph.
    [[nodiscard]] Pixel pixel(const glm::dvec2& place) const;

    /// Returns the light at a place; beyond the border that of the border.
    [[nodiscard]] glm::dvec3 at(const glm::dvec2& place) const;

  private:
    const Picture& picture_;
    std::array<double, 256> linear_{};

    [[nodiscard]] std::size_t first_of(std::size_t x, std::size_t y) const {
        return 3 * (y * static_cast<std::size_t>(picture_.width) + x);
    }
};

/// Returns true well inside a mask: pixels at its border have some of the background.
[[nodiscard]] bool is_well_inside(const Mask& mask, const glm::dvec2& place);

/// A part of a skin: rows along the part and columns by the angle from the front where it is seen from the side, a
/// square with a disc in it where it is seen from above or below.
struct SkinPatch {
    std::size_t rows = 0, columns = 0;
    double reach = 0.0;  ///< the first and the last column are at -reach and reach, radians
    std::vector<glm::dvec3> light;  ///< linear light
    std::vector<bool> is_seen;

    [[nodiscard]] double angle(std::size_t column) const {
        return reach *
               (2.0 * (static_cast<double>(column) + 0.5) / static_cast<double>(columns) - 1.0);
    }
};

/// Returns true if enough of a patch is seen for an image.
///
/// texels  of the part; a disc has fewer than its square
[[nodiscard]] bool shows_enough(const SkinPatch& patch, std::size_t texels);

/// Fills what is not seen from what is round it, by pyramids of ever smaller copies (push-pull).
void fill(SkinPatch& patch);

/// Where a texel is, as its shade depends on it.
struct ShadePlace {
    static constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();

    std::size_t row =
        nowhere;  ///< those of one row have one colour; of no part, or hidden, where nowhere
    std::array<double, 2> normal{};  ///< two parts of the normal that the light is compared by
};

/// Divides a patch by its shade: light b0 + b * normal, fitted to the luminance of each row over its own mean by
/// least squares with weights that fall with the distance.
///
/// places  of all texels
/// rows    how many there are
void unshade(SkinPatch& patch, const std::vector<ShadePlace>& places, std::size_t rows);

/// Divides a patch seen from the side by its shade, row by row.
///
/// has_depth  also by the part of the normal towards the camera; without it only from left to right
void unshade(SkinPatch& patch, bool has_depth);

/// Returns a picture: `at` of the middle of each texel, as shares of width and height, in linear light.
template <class At>
Picture picture_of(int width, int height, At at) {
    Picture picture{width, height, {}};
    picture.rgb.reserve(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 light = at((x + 0.5) / width, (y + 0.5) / height);
            for (int c = 0; c < 3; ++c)
                picture.rgb.push_back(static_cast<std::uint8_t>(
                    255.0 * linear_to_srgb(std::clamp(light[c], 0.0, 1.0)) + 0.5));
        }
    return picture;
}

}  // namespace sporeprint::trace
