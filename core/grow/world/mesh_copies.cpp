#include "core/grow/world/mesh_copies.h"

#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>

#include "core/math/direction.h"

namespace sporeprint {

Mesh MeshCopies::merged() const {
    Mesh all;
    const std::size_t vertices = places.size() * one.positions.size();
    all.positions.reserve(vertices);
    all.normals.reserve(vertices);
    all.tangents.reserve(one.tangents.empty() ? 0 : vertices);
    all.texture_coordinates.reserve(one.texture_coordinates.empty() ? 0 : vertices);
    all.tints.reserve(vertices);
    all.indices.reserve(places.size() * one.indices.size());
    for (const GlbTransform& place : places) {
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        for (std::size_t i = 0; i < one.positions.size(); ++i) {
            all.positions.emplace_back(
                place.translation +
                rotated(place.rotation, place.scale * glm::dvec3(one.positions[i])));
            all.normals.emplace_back(
                glm::normalize(rotated(place.rotation, glm::dvec3(one.normals[i]))));
            if (!one.tangents.empty())
                all.tangents.emplace_back(
                    glm::vec3(glm::normalize(rotated(place.rotation, glm::dvec3(one.tangents[i])))),
                    one.tangents[i].w);
            if (!one.texture_coordinates.empty())
                all.texture_coordinates.push_back(one.texture_coordinates[i]);
            all.tints.push_back(one.tints.empty() ? place.tint : place.tint * one.tints[i]);
        }
        for (const std::uint32_t index : one.indices) all.indices.push_back(first + index);
    }
    return all;
}

}  // namespace sporeprint
