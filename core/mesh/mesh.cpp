#include "core/mesh/mesh.h"

#include <cmath>
#include <glm/common.hpp>

namespace sporeprint {

float phase_of(std::size_t index) {
    constexpr double golden_fraction = 0.6180339887498949;
    const double turns = golden_fraction * static_cast<double>(index);
    return static_cast<float>(turns - std::floor(turns));
}

void append(Mesh& mesh, const Mesh& part) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const auto extend = [](auto& values, const auto& more) {
        values.insert(values.end(), more.begin(), more.end());
    };
    extend(mesh.positions, part.positions);
    extend(mesh.normals, part.normals);
    extend(mesh.tangents, part.tangents);
    extend(mesh.texture_coordinates, part.texture_coordinates);
    extend(mesh.sway, part.sway);
    extend(mesh.tints, part.tints);
    for (const std::uint32_t index : part.indices) mesh.indices.push_back(first + index);
}

Bounds bounds(const Mesh& mesh) {
    Bounds box{mesh.positions.front(), mesh.positions.front()};
    for (const glm::vec3& p : mesh.positions) {
        box.min = glm::min(box.min, p);
        box.max = glm::max(box.max, p);
    }
    return box;
}

Bounds united(const Bounds& one, const Bounds& other) {
    return {glm::min(one.min, other.min), glm::max(one.max, other.max)};
}

}  // namespace sporeprint
