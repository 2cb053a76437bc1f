// A frame of an impostor whose empty texels continue what is beside them, so that filters and lossy
// images have no foreign colour at outlines.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace sporeprint {

/// A texel of a frame; the colour is linear.
struct FilledTexel {
    glm::vec3 colour{0.0F}, normal{0.0F};
    float roughness = 0.0F, depth = 0.0F;
    float coverage = 0.0F;  ///< 0..1; with 0, the others are those of neighbours once it is filled
};

/// A square image of texels.
class FilledFrame {
  public:
    explicit FilledFrame(int side)
        : side_(side), texels_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side)) {}

    [[nodiscard]] int side() const { return side_; }
    [[nodiscard]] FilledTexel& texel(int x, int y) { return texels_[index(x, y)]; }
    [[nodiscard]] const FilledTexel& texel(int x, int y) const { return texels_[index(x, y)]; }

    /// Gives texels without coverage the mean of those around them, from smaller copies of the frame.
    /// Their coverage stays 0. A frame without any coverage stays as it is.
    void fill();

  private:
    int side_;
    std::vector<FilledTexel> texels_;

    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) +
               static_cast<std::size_t>(x);
    }
};

}  // namespace sporeprint
