#include "core/scene/scene.h"

namespace sporeprint {

std::size_t Scene::bytes() const {
    std::size_t names = 0;
    for (const std::string& name : materials) names += sizeof(std::string) + name.capacity();
    return sizeof(*this) + positions.size() * sizeof(glm::vec3) +
           triangles.size() * sizeof(SceneTriangle) + names;
}

}  // namespace sporeprint
