// The mesh type: a structure of arrays, ready to be written as glTF.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace sporeprint {

/// Indexed triangles, counter-clockwise from outside; metres, +Y up. Texture coordinates and
/// tangents may both be empty.
struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents;
    std::vector<glm::vec2> texture_coordinates;
    std::vector<std::uint32_t> indices;

    [[nodiscard]] std::size_t triangles() const { return indices.size() / 3; }
};

/// An axis-aligned bounding box.
struct Bounds {
    glm::vec3 min{0.0F};
    glm::vec3 max{0.0F};
};

/// Returns the bounding box of the positions.
///
/// pre  at least one vertex
[[nodiscard]] Bounds bounds(const Mesh& mesh);

}  // namespace sporeprint
