#include "core/impostor/frames.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace sporeprint {

namespace {

glm::vec3 unit(const glm::vec3& v) { return v * (1.0F / std::sqrt(glm::dot(v, v))); }

}  // namespace

glm::vec3 FrameAxes::seen(const glm::vec3& vector) const {
    return {glm::dot(vector, right), glm::dot(vector, up), glm::dot(vector, toward)};
}

glm::vec3 direction_at(const glm::vec2& place) {
    const float a = 2.0F * place.x - 1.0F, b = 2.0F * place.y - 1.0F;
    return unit({0.5F * (a + b), 1.0F - std::max(std::abs(a), std::abs(b)), 0.5F * (b - a)});
}

glm::vec2 place_of(const glm::vec3& direction) {
    const float height = std::max(direction.y, 0.0F);
    const float sum = std::abs(direction.x) + height + std::abs(direction.z);
    if (!(sum > 0.0F)) return glm::vec2(0.5F);
    const float x = direction.x / sum, z = direction.z / sum;
    return {0.5F * (x - z) + 0.5F, 0.5F * (x + z) + 0.5F};
}

FrameAxes axes_of(const glm::vec3& toward) {
    const glm::vec3 level = glm::vec3(0.0F, 1.0F, 0.0F) - toward * toward.y;
    FrameAxes axes;
    axes.toward = toward;
    axes.up = glm::dot(level, level) > 1e-12F ? unit(level) : glm::vec3(0.0F, 0.0F, -1.0F);
    axes.right = glm::cross(axes.up, toward);
    return axes;
}

FrameAxes axes_of(FrameCell cell) {
    constexpr float step = 1.0F / static_cast<float>(frame_grid - 1);
    return axes_of(direction_at(
        {static_cast<float>(cell.column) * step, static_cast<float>(cell.row) * step}));
}

}  // namespace sporeprint
