#include "core/render/ground_shadow.h"

#include <algorithm>
#include <cstddef>
#include <functional>

namespace sporeprint::render {

namespace {

/// Returns how much of a light falls on level ground.
float falling(const Light& light) {
    const float total = light.strength.x + light.strength.y + light.strength.z;
    return std::max(light.direction.y, 0.0F) * total;
}

float falling(const std::vector<Light>& lights) {
    float sum = 0.0F;
    for (const Light& light : lights) sum += falling(light);
    return sum;
}

/// Returns the means of five cells of a square grid along its rows or its columns.
std::vector<float> means_along(const std::vector<float>& grid, int side, int step_x, int step_y) {
    constexpr int reach = 2;
    std::vector<float> means(grid.size());
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            float sum = 0.0F;
            for (int k = -reach; k <= reach; ++k) {
                const int column = std::clamp(x + k * step_x, 0, side - 1),
                          row = std::clamp(y + k * step_y, 0, side - 1);
                sum += grid[static_cast<std::size_t>(row * side + column)];
            }
            means[static_cast<std::size_t>(y * side + x)] =
                sum * (1.0F / static_cast<float>(2 * reach + 1));
        }
    return means;
}

/// Blurs a square grid.
void blur(std::vector<float>& grid, int side, std::size_t rounds) {
    for (std::size_t round = 0; round < rounds; ++round)
        grid = means_along(means_along(grid, side, 1, 0), side, 0, 1);
}

/// Returns how often shadows are blurred, more for fewer lights.
///
/// single  number of lights from which on they are blurred less than once
std::size_t rounds_of(const std::vector<Light>& lights, std::size_t single) {
    return std::min<std::size_t>((single - 1) / lights.size(), 4);
}

}  // namespace

float GroundShadow::Falling::light_at(const glm::vec3& at, bool is_sharp) const {
    float sum = 0.0F;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (lights[i].direction.y <= 0.0F) continue;
        const float share = is_sharp ? shadows[i].light_at(at, glm::vec3(0.0F))
                                     : (shadows[i].reaches(at, glm::vec3(0.0F)) ? 1.0F : 0.0F);
        sum += falling(lights[i]) * share;
    }
    return sum;
}

GroundShadow::GroundShadow(const Bounds& box, float level, const Falling& lamps, const Falling& sky,
                           const Parallel& parallel)
    : level_(level) {
    const float height = std::max(box.max.y - level, 0.0F);
    const float reach =
        1.5F * height + 0.2F * std::max(box.max.x - box.min.x, box.max.z - box.min.z);
    from_ = glm::vec2(box.min.x - reach, box.min.z - reach);
    const glm::vec2 to(box.max.x + reach, box.max.z + reach);
    step_ = (to - from_) * (1.0F / static_cast<float>(side - 1));
    const auto cells = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    std::vector<float> of_lamps(cells), of_sky(cells);
    std::vector<std::function<void()>> tasks;
    tasks.reserve(static_cast<std::size_t>(side));
    for (int row = 0; row < side; ++row)
        tasks.emplace_back([&, row] {
            for (int column = 0; column < side; ++column) {
                const auto cell = static_cast<std::size_t>(row * side + column);
                const glm::vec3 at(from_.x + step_.x * static_cast<float>(column), level,
                                   from_.y + step_.y * static_cast<float>(row));
                of_lamps[cell] = lamps.light_at(at, true);
                of_sky[cell] = sky.light_at(at, false);
            }
        });
    parallel(tasks);
    // Lights are few, and their shadows would be seen apart from each other.
    blur(of_lamps, side, rounds_of(lamps.lights, 14));
    blur(of_sky, side, rounds_of(sky.lights, 56));
    const float all = falling(lamps.lights) + falling(sky.lights);
    darkness_.resize(cells);
    for (std::size_t i = 0; i < cells; ++i)
        darkness_[i] = std::clamp(1.0F - (of_lamps[i] + of_sky[i]) / all, 0.0F, 1.0F);
}

float GroundShadow::at(const glm::vec3& point) const {
    const float x = (point.x - from_.x) / step_.x, y = (point.z - from_.y) / step_.y;
    const auto last = static_cast<float>(side - 1);
    if (!(x >= 0.0F && y >= 0.0F && x < last && y < last)) return 0.0F;
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const float part_x = x - static_cast<float>(column), part_y = y - static_cast<float>(row);
    const float* const upper = &darkness_[static_cast<std::size_t>(row * side + column)];
    const float* const lower = upper + side;
    // The grid ends where hardly any light is stopped; the rest fades out.
    const float edge = std::min({x, y, last - x, last - y}) / (0.15F * last);
    return std::min(edge, 1.0F) *
           ((upper[0] * (1.0F - part_x) + upper[1] * part_x) * (1.0F - part_y) +
            (lower[0] * (1.0F - part_x) + lower[1] * part_x) * part_y);
}

}  // namespace sporeprint::render
