// A scene that somebody has made: triangles of named materials, on which fungi are to live.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace sporeprint {

/// Greatest number of triangles of a scene, of materials, and of metres from side to side.
inline constexpr std::size_t most_scene_triangles = 200'000, most_scene_materials = 256;
inline constexpr double most_scene_extent = 50.0;

struct SceneTriangle {
    std::array<std::uint32_t, 3> corners{};  ///< counter-clockwise from outside
    std::uint16_t material = 0;
    bool operator==(const SceneTriangle&) const = default;
};

/// Metres, +Y up, as in glTF.
struct Scene {
    std::vector<glm::vec3> positions;
    std::vector<SceneTriangle> triangles;
    std::vector<std::string>
        materials;  ///< their names; the first one is of triangles without a material

    /// Returns the memory that it takes.
    [[nodiscard]] std::size_t bytes() const;
    bool operator==(const Scene&) const = default;
};

}  // namespace sporeprint
