// The mesh type: a structure of arrays, ready to be written as glTF.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace sporeprint {

/// How wind moves a vertex; all 0..1.
struct Sway {
    float bend = 0.0F;     ///< share of the largest displacement; 0 at the ground
    float flutter = 0.0F;  ///< share of the largest oscillation; 0 but on leaves
    float phase = 0.0F;    ///< of the oscillations, periods; continuous where surfaces meet
    float branch = 0.0F;   ///< number of the main branch or individual / 255; 0: trunk or roots
    bool operator==(const Sway&) const = default;
};

/// Returns the phase of one of many things that sway, 0..1: those of consecutive indices are far
/// apart.
///
/// source  multiples of the golden ratio, modulo 1
[[nodiscard]] float phase_of(std::size_t index);

/// Indexed triangles, counter-clockwise from outside; metres, +Y up. Texture coordinates and
/// tangents may both be empty, and so may sway and tints.
struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents;
    std::vector<glm::vec2> texture_coordinates;
    std::vector<Sway> sway;  ///< how wind moves each vertex; usually empty
    /// Factors of the base colour of each vertex, linear, 0..1; usually empty.
    std::vector<glm::vec3> tints;
    std::vector<std::uint32_t> indices;

    [[nodiscard]] std::size_t triangles() const { return indices.size() / 3; }
};

/// Appends the vertices and triangles of one mesh to another, with all that vertices carry.
///
/// pre  both have the same arrays; an empty mesh takes those of the part
void append(Mesh& mesh, const Mesh& part);

/// An axis-aligned bounding box.
struct Bounds {
    glm::vec3 min{0.0F};
    glm::vec3 max{0.0F};
};

/// Returns the bounding box of the positions.
///
/// pre  at least one vertex
[[nodiscard]] Bounds bounds(const Mesh& mesh);

/// Returns the bounding box of two.
[[nodiscard]] Bounds united(const Bounds& one, const Bounds& other);

}  // namespace sporeprint
