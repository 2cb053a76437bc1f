// Pipeline of the fruit bodies of a scene: a GLB file that is laid over the scene, whose coordinates it has.
#pragma once

#include <string>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/grow/execution_context.h"
#include "core/grow/product.h"
#include "core/plant/tree_spec.h"
#include "core/scene/scene_season.h"

namespace sporeprint {

/// How the fruit bodies of a scene are shown.
struct SceneFungiOptions {
    int lod = 1;                                       ///< 0..2
    LeafInstancing instancing = LeafInstancing::none;  ///< of those that look alike
    Textures textures = Textures::embedded;            ///< embedded or none
    FileOptions file;
};

/// The budget of such a file: what exceeds it has less detail, and bodies that look alike become one mesh.
inline constexpr std::uint64_t most_scene_body_triangles = 400'000;
inline constexpr std::size_t most_scene_nodes = 1'000;

/// Builds the file. The nodes are in metres in the coordinates of the scene; asset.extras lists the bodies with their
/// ids.
///
/// bodies   scene_bodies() of the year of the moment
/// species  ids of the species
/// throws   InvalidInput (path "/lod", "/species"), Impossible for linked images (path "/textures"), Cancelled
[[nodiscard]] Grown grow_scene_fungi(const std::vector<SceneBody>& bodies, WorldTime time,
                                     const std::vector<std::string>& species,
                                     const SceneFungiOptions& options, const Atlas& atlas,
                                     const Extras& extras = {},
                                     const ExecutionContext& execution = {});

}  // namespace sporeprint
