// Reads uploaded GLB files as scenes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/scene/scene.h"

namespace sporeprint {

/// The largest JSON chunk of a scene that is read.
inline constexpr std::size_t most_scene_json = 4U << 20U;

/// Returns the triangles of the scene that a GLB file shows, or of its first one: all meshes of its nodes where these
/// put them, in the pose of the file. Triangles, strips and fans are read, points and lines are left out, and so are
/// triangles without an area. Vertices are not shared between primitives.
///
/// throws  InvalidInput (path "") for what is no GLB of version 2 or is broken; for buffers that are not in the file,
///         sparse or compressed geometry, skins (whose pose depends on a moment), coordinates that are not finite; for
///         no triangle, more than most_scene_triangles, or more than most_scene_extent from side to side. Messages have
///         the JSON pointer of what is wrong
/// cost    O(size of the file)
[[nodiscard]] Scene scene_in_glb(std::span<const std::uint8_t> file);

}  // namespace sporeprint
