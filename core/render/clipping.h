// Triangles cut at the borders of an image: a camera near a scene sees parts of them only.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/render/camera.h"

namespace sporeprint::render {

/// The visible parts of the triangles of a mesh, as triangles.
struct ClippedTriangles {
    std::vector<glm::vec3> corners;      ///< in the axes of the camera: the vertices, then new ones
    std::vector<std::uint32_t> indices;  ///< three of each part
    std::vector<std::uint32_t> of;       ///< index of the first corner of the triangle of each part
};

/// Cuts triangles by the borders of the image of a camera, and where they are nearer to it than
/// `Camera::nearest`. Parts of two triangles with a common edge meet without a gap: both edges are cut
/// at the same points. Triangles inside are taken as they are.
///
/// vertices  of the mesh, in the axes of the camera
/// indices   three of each triangle
/// cost      O(triangles)
[[nodiscard]] ClippedTriangles clipped(std::vector<glm::vec3> vertices,
                                       std::span<const std::uint32_t> indices,
                                       const Camera& camera);

}  // namespace sporeprint::render
