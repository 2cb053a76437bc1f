// Helpers that append single vertices and triangles to a mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/math/direction.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// Appends one vertex.
///
/// textured    whether the mesh has texture coordinates and tangents; otherwise the last three
///             arguments are ignored
/// tangent     orthonormalised against the normal before it is stored
/// handedness  handedness of the tangent space, 1 or -1
inline void append_vertex(Mesh& mesh, bool textured, const glm::dvec3& position,
                          const glm::dvec3& normal, const glm::dvec3& tangent,
                          const glm::vec2& texture, double handedness = 1.0) {
    mesh.positions.emplace_back(position);
    mesh.normals.emplace_back(normal);
    if (!textured) return;
    mesh.texture_coordinates.push_back(texture);
    mesh.tangents.emplace_back(glm::vec3(square_to(normal, tangent)),
                               static_cast<float>(handedness));
}

inline void append_triangle(Mesh& mesh, std::size_t a, std::size_t b, std::size_t c) {
    mesh.indices.insert(mesh.indices.end(),
                        {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                         static_cast<std::uint32_t>(c)});
}

}  // namespace sporeprint
