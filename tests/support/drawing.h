// A software rasterizer with orthographic projection and without lighting.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/model/spines.h"
#include "core/surface/charts.h"
#include "core/surface/paint.h"

namespace sporeprint {

/// A direction of view, degrees: azimuth round the axis, elevation above the ground.
struct ViewDirection {
    double azimuth = 0.0, elevation = 0.0;
};

/// A square of the image plane through `middle`: `side` metres over `pixels` pixels.
struct ImagePlane {
    glm::vec3 middle{0.0F};
    double side = 1.0;
    int pixels = 256;
};

/// A covered pixel, with the texture coordinates of its centre.
struct Pixel {
    float depth = 0.0F;
    glm::vec2 place{0.0F};
};

/// A raster image, row by row from the top; uncovered pixels are empty.
struct Drawing {
    int pixels = 0;
    std::vector<std::optional<Pixel>> seen;

    [[nodiscard]] const std::optional<Pixel>& at(int x, int y) const {
        return seen[static_cast<std::size_t>(y) * static_cast<std::size_t>(pixels) +
                    static_cast<std::size_t>(x)];
    }
};

/// Draws the triangles of the parts in the bit set `parts` with a depth buffer.
///
/// images  whose alpha leaves holes, if they have any
[[nodiscard]] Drawing drawn(const Mesh& mesh, const ViewDirection& view, const ImagePlane& canvas,
                            std::uint32_t parts = (1U << part_count) - 1U,
                            const RawImages* images = nullptr);

/// Returns the number of pixels covered by exactly one of two drawings.
[[nodiscard]] int symmetric_difference(const Drawing& a, const Drawing& b);

/// Returns the length of the border of the covered area in pixels, by marching squares.
[[nodiscard]] double outline_length(const Drawing& drawing);

/// Returns by how many pixels along the outline silhouettes of neighbouring levels of a species may
/// differ: one; but a cushion whose outline is upright folds alone has few triangles for each, and the
/// tips of a beard are only thinned out.
///
/// spines  of the species
[[nodiscard]] constexpr double silhouette_tolerance(const SpineStyle& spines) {
    return spines.is_folded() ? 2.3 : spines.count > 2000 ? 1.45 : 1.0;
}

/// A colour in CIE L*a*b*, white point D65.
struct Lab {
    double l = 0.0, a = 0.0, b = 0.0;
};

/// The mean of colours in linear light.
class MeanColour {
  public:
    /// Adds the texel of `images` at a texture coordinate.
    void add(const RawImages& images, const glm::vec2& place);
    [[nodiscard]] int count() const { return count_; }
    [[nodiscard]] Lab mean() const;

  private:
    double red_ = 0.0, green_ = 0.0, blue_ = 0.0;
    int count_ = 0;
};

/// Returns the CIE76 colour difference.
[[nodiscard]] double difference(const Lab& a, const Lab& b);

}  // namespace sporeprint
