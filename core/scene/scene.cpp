#include "core/scene/scene.h"

namespace sporeprint {

std::size_t Scene::bytes() const {
    std::size_t names = 0;
    for (const std::string& name : materials) names += sizeof(name) + name.capacity();
    return sizeof(*this) + positions.size() * sizeof(positions[0]) +
           triangles.size() * sizeof(triangles[0]) + names;
}

}  // namespace sporeprint
