// Worlds as 3D Tiles 1.1: tilesets, subtrees and tiles, each a function of the world, the time and its own place.
#pragma once

#include "api/products/context.h"
#include "core/params/value.h"

namespace sporeprint::api {

/// Handles GET /v1/worlds/{world}/{profile}/{time}/tileset.json: all layers of a day.
Plan plan_tileset(RouteCall& call);

/// Handles GET /v1/worlds/{world}/{profile}/{layertime}/{layer}/tileset.json: one layer.
Plan plan_layer_tileset(RouteCall& call);

/// Handles GET /v1/worlds/{world}/{profile}/{layertime}/{layer}/{level}/{x}/{y}.subtree.
Plan plan_subtree(RouteCall& call);

/// Handles GET /v1/worlds/{world}/{profile}/{layertime}/{layer}/{level}/{x}/{y}.glb.
Plan plan_tile(RouteCall& call);

/// Adds the parameters of these routes to a document of OpenAPI.
void add_tile_parameters(Value& parameters, std::string_view pattern);

/// Returns the schema of a tileset.
[[nodiscard]] Value tileset_schema();

}  // namespace sporeprint::api
