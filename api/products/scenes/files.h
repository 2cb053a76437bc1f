// What grows on an uploaded scene on a day: its fruit bodies as a GLB file and as placements, and maps of its surface.
#pragma once

#include "api/products/context.h"
#include "api/products/worlds/placements.h"
#include "core/params/value.h"

namespace sporeprint::api {

/// Handles GET /v1/scenes/{scene}/{world}/{time}/fungi.glb.
Plan plan_scene_fungi(RouteCall& call);

/// Handles GET /v1/scenes/{scene}/{world}/{time}/placements.csv, .json and .bin.
template <PlacementFile File>
Plan plan_scene_placements(RouteCall& call);

/// The files of a map.
enum class SceneMapFile { bin, json };

/// Handles GET /v1/scenes/{scene}/{world}/{time}/maps/{map}.bin and .json.
template <SceneMapFile File>
Plan plan_scene_map(RouteCall& call);

/// Return the schemas of the queries.
[[nodiscard]] Value scene_fungi_query_schema(const Atlas& atlas);
[[nodiscard]] Value scene_placement_query_schema(const Atlas& atlas);
[[nodiscard]] Value scene_map_query_schema(const Atlas& atlas);

/// Return the schemas of the JSON files.
[[nodiscard]] Value scene_placement_schema();
[[nodiscard]] Value scene_map_schema();

}  // namespace sporeprint::api
