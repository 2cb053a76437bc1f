// Draws a mesh as a viewer far away would see it: what each pixel shows, without light.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/surface/charts.h"
#include "core/surface/paint.h"

namespace sporeprint {

/// From where, in degrees: round the axis, and up from the ground.
struct View {
    double azimuth = 0.0, elevation = 0.0;
};

/// A square of the plane that faces the viewer, through `middle`: `side` metres over `pixels` pixels.
struct Canvas {
    glm::vec3 middle{0.0F};
    double side = 1.0;
    int pixels = 256;
};

/// What a pixel shows. Texture coordinates are those of its middle.
struct Pixel {
    float depth = 0.0F;
    glm::vec2 place{0.0F};
};

/// Row by row from the top; empty where nothing is seen.
struct Drawing {
    int pixels = 0;
    std::vector<std::optional<Pixel>> seen;

    [[nodiscard]] const std::optional<Pixel>& at(int x, int y) const {
        return seen[static_cast<std::size_t>(y) * static_cast<std::size_t>(pixels) +
                    static_cast<std::size_t>(x)];
    }
};

/// The part whose rectangle of the image atlas holds a place of it.
[[nodiscard]] Part part_at(const glm::vec2& place);

/// Draws the triangles whose parts are in `parts`, by bit, nearest first.
[[nodiscard]] Drawing drawn(const Mesh& mesh, const View& view, const Canvas& canvas,
                            std::uint32_t parts = (1U << part_count) - 1U);

/// Pixels that one drawing covers and the other does not.
[[nodiscard]] int symmetric_difference(const Drawing& a, const Drawing& b);

/// Length of the border between what is covered and what is not, in pixels: by marching squares.
[[nodiscard]] double outline_length(const Drawing& drawing);

/// A colour in CIE L*a*b*, white point D65.
struct Lab {
    double l = 0.0, a = 0.0, b = 0.0;
};

/// Sums light and gives its mean as a colour.
class MeanColour {
  public:
    /// Adds the texel of `images` at a place.
    void add(const RawImages& images, const glm::vec2& place);
    [[nodiscard]] int count() const { return count_; }
    [[nodiscard]] Lab mean() const;

  private:
    double red_ = 0.0, green_ = 0.0, blue_ = 0.0;
    int count_ = 0;
};

/// CIE76 difference.
[[nodiscard]] double difference(const Lab& a, const Lab& b);

}  // namespace sporeprint
