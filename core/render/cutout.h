// Which samples of a triangle are drawn, where the alpha of its material leaves holes.
#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/render/draw_list.h"

namespace sporeprint::render {

/// The direction in which a sample looks: (x, y, 1), both linear in its column and its row.
struct SampleRays {
    glm::vec2 first{0.0F};  ///< of the sample in the upper left corner
    glm::vec2 step{1.0F};   ///< from a column, and a row, to the next
};

/// The part of a triangle that is drawn.
class Cutout {
  public:
    /// All of it is drawn.
    Cutout() = default;

    /// mesh          with texture coordinates, or all of the triangle is drawn
    /// first_corner  of the triangle, as an index into those of the mesh
    /// corners       of the triangle, along the axes of the rays; for parallel rays with a third component of 1
    Cutout(const Mesh& mesh, const DrawMaterial& material, std::size_t first_corner,
           const std::array<glm::vec3, 3>& corners, const SampleRays& rays);

    [[nodiscard]] bool shows(int x, int y) const {
        if (alpha_ == nullptr) return true;
        const glm::vec3 at =
            origin_ + static_cast<float>(x) * along_ + static_cast<float>(y) * down_;
        const float sum = at.x + at.y + at.z;
        if (!(sum * sum > 0.0F)) return true;
        const glm::vec3 w = at / sum;
        return alpha_->grey_at(corners_[0] * w.x + corners_[1] * w.y + corners_[2] * w.z,
                               texels_) >= cutoff_;
    }

  private:
    const Texture* alpha_ = nullptr;
    float cutoff_ = 0.0F;
    float texels_ = 1.0F;                 ///< between two samples
    std::array<glm::vec2, 3> corners_{};  ///< in the image
    /// Weights of the corners, times their sum, at the first sample, and their steps.
    glm::vec3 origin_{0.0F}, along_{0.0F}, down_{0.0F};
};

}  // namespace sporeprint::render
