#include "core/render/cutout.h"

#include <algorithm>

namespace sporeprint::render {

Cutout::Cutout(const Mesh& mesh, const DrawMaterial& material, std::size_t first_corner,
               const std::array<glm::vec3, 3>& corners, const SampleRays& rays) {
    if (material.alpha.empty() || mesh.texture_coordinates.empty()) return;
    alpha_ = &material.alpha;
    cutoff_ = material.alpha_cutoff;
    for (std::size_t i = 0; i < 3; ++i)
        corners_[i] = mesh.texture_coordinates[mesh.indices[first_corner + i]];
    // The weight of a corner is the volume between the ray and the other two.
    for (int i = 0; i < 3; ++i) {
        const glm::vec3 side = glm::cross(corners[static_cast<std::size_t>((i + 1) % 3)],
                                          corners[static_cast<std::size_t>((i + 2) % 3)]);
        origin_[i] = glm::dot(side, glm::vec3(rays.first, 1.0F));
        along_[i] = side.x * rays.step.x;
        down_[i] = side.y * rays.step.y;
    }
    // A corner may be behind the camera.
    const float near = 0.1F * std::max({corners[0].z, corners[1].z, corners[2].z});
    const auto seen = [&](std::size_t i) {
        return glm::vec2(corners[i]) / (rays.step * std::max(corners[i].z, near));
    };
    texels_ = texels_between_samples(corners_, {seen(0), seen(1), seen(2)}, alpha_->side());
}

}  // namespace sporeprint::render
