// The pixel buffers of an atlas, and helpers shared by everything that paints into them. Private to
// core/surface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/surface/paint.h"
#include "core/surface/plan.h"

namespace sporeprint {

/// Number of rows that one task paints.
inline constexpr int rows_per_piece = 128;

/// Three RGB images of an atlas. Their memory comes from a pool, because touching fresh memory
/// costs as much as painting.
class Canvas {
  public:
    explicit Canvas(int side);
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;
    ~Canvas();

    [[nodiscard]] int side() const { return side_; }
    /// Returns the size of one image in bytes.
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] const std::uint8_t* image(std::size_t i) const {
        return bytes_.data() + i * size_;
    }
    [[nodiscard]] PaintTarget target() {
        return {bytes_.data(), bytes_.data() + size_, bytes_.data() + 2 * size_};
    }

  private:
    int side_;
    std::size_t size_;
    Bytes bytes_;
};

/// Encodes the three images with the qualities stated at paint().
[[nodiscard]] ImageSet encoded(const Canvas& canvas, ImageFormat format, const Parallel& parallel);

/// Encodes three images of any size in the same way.
///
/// rgb  3 * width * height bytes each, indexed by ImageKind
[[nodiscard]] ImageSet encoded(const std::array<std::span<const std::uint8_t>, 3>& rgb, int width,
                               int height, ImageFormat format, const Parallel& parallel);

/// Returns a copy of the three images.
[[nodiscard]] RawImages raw(const Canvas& canvas);

/// Returns the rectangles of the charts on an atlas of `side` texels.
[[nodiscard]] std::array<Frame, part_count> chart_frames(int side);

/// Returns the linear light of each sRGB byte.
[[nodiscard]] const std::array<float, 256>& linear_table();

/// Returns true when `side` is a valid size of an atlas: a power of two from 16 to 2048.
[[nodiscard]] constexpr bool proper_side(int side) {
    return side >= 16 && side <= 2048 && (side & (side - 1)) == 0;
}

}  // namespace sporeprint
