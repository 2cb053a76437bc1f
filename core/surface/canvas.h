// Where an atlas is painted before it is encoded, and what all that paint on it share. Private to core/surface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/surface/paint.h"
#include "core/surface/plan.h"

namespace sporeprint {

/// Rows that one piece of work paints.
inline constexpr int rows_per_piece = 128;

/// Three RGB images of an atlas. Their memory is lent again: fresh pages cost as much as painting them.
class Canvas {
  public:
    explicit Canvas(int side);
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;
    ~Canvas();

    [[nodiscard]] int side() const { return side_; }
    /// Bytes of one image.
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

/// The three images as JPEG files, by the qualities of paint().
[[nodiscard]] ImageSet encoded(const Canvas& canvas, const Parallel& parallel);

/// The three images as they are.
[[nodiscard]] RawImages raw(const Canvas& canvas);

/// The charts' rectangles on an atlas of `side` texels.
[[nodiscard]] std::array<Frame, part_count> chart_frames(int side);

/// Linear light of each sRGB byte.
[[nodiscard]] const std::array<float, 256>& linear_table();

/// Whether `side` is one of an atlas: a power of two from 16 to 2048.
[[nodiscard]] constexpr bool proper_side(int side) {
    return side >= 16 && side <= 2048 && (side & (side - 1)) == 0;
}

}  // namespace sporeprint
