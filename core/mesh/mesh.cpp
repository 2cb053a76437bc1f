#include "core/mesh/mesh.h"

#include <glm/common.hpp>

namespace sporeprint {

Bounds bounds(const Mesh& mesh) {
    Bounds box{mesh.positions.front(), mesh.positions.front()};
    for (const glm::vec3& p : mesh.positions) {
        box.min = glm::min(box.min, p);
        box.max = glm::max(box.max, p);
    }
    return box;
}

}  // namespace sporeprint
