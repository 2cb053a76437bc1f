#include "core/mesh/mesh.h"

#include <cmath>
#include <glm/common.hpp>

namespace sporeprint {

float phase_of(std::size_t index) {
    constexpr double golden_fraction = 0.6180339887498949;
    const double turns = golden_fraction * static_cast<double>(index);
    return static_cast<float>(turns - std::floor(turns));
}

Bounds bounds(const Mesh& mesh) {
    Bounds box{mesh.positions.front(), mesh.positions.front()};
    for (const glm::vec3& p : mesh.positions) {
        box.min = glm::min(box.min, p);
        box.max = glm::max(box.max, p);
    }
    return box;
}

}  // namespace sporeprint
