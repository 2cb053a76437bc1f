// Images of a material as the renderer samples them: decoded, with smaller copies for distance.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/bytes.h"
#include "core/surface/codecs.h"

namespace sporeprint::render {

/// What the bytes of an image encode.
enum class Encoding { srgb, linear, alpha };  ///< alpha: of a PNG file, as a grey image

/// A square image with copies of half, quarter, ... its side.
class Texture {
  public:
    Texture() = default;

    /// Decodes a JPEG, WebP or PNG file.
    ///
    /// repeats_u   coordinates beyond 0..1 repeat the image in u; in v they take its border
    /// least_side  texels that are needed at least: larger images may be made smaller
    /// throws      GenerationError for an image that is not square
    Texture(std::span<const std::uint8_t> file, Encoding encoding, bool repeats_u,
            int least_side = largest_upload_side);

    /// Returns the colour at a texture coordinate, interpolated between four texels; linear, 0..1.
    ///
    /// texels  distance of two samples in texels of the whole image: the copy is chosen where it is
    ///         about one
    [[nodiscard]] glm::vec3 at(const glm::vec2& coordinate, float texels) const;

    /// Returns the first component of the colour.
    [[nodiscard]] float grey_at(const glm::vec2& coordinate, float texels) const;

    [[nodiscard]] bool empty() const { return levels_.empty(); }
    [[nodiscard]] int side() const { return levels_.empty() ? 0 : levels_.front().side; }

  private:
    struct Level {
        int side = 0;
        Bytes rgb;
    };
    template <class T, class Texel>
    [[nodiscard]] T interpolated(const glm::vec2& coordinate, float texels,
                                 const Texel& texel) const;

    std::vector<Level> levels_;
    std::array<float, 256> light_{};  ///< linear light of each byte
    bool repeats_u_ = false;
};

/// Returns the distance of two samples of a triangle in texels of an image: the root of the ratio of areas.
///
/// image  its corners, texture coordinates
/// seen   its corners in samples
/// side   of the image, texels
[[nodiscard]] float texels_between_samples(const std::array<glm::vec2, 3>& image,
                                           const std::array<glm::vec2, 3>& seen, int side);

}  // namespace sporeprint::render
