// Scenes that clients upload for fungi to grow on, and what is known of them.
#pragma once

#include <cstddef>
#include <string>

#include "api/products/context.h"
#include "core/grow/scene/scene_parts.h"
#include "core/params/value.h"

namespace sporeprint::api {

/// Largest file of a scene, bytes.
inline constexpr std::size_t most_scene_bytes = 32U << 20U;

/// Handles POST /v1/scenes.
Plan plan_scene_upload(RouteCall& call);

/// Handles GET /v1/scenes/{scene}.json.
Plan plan_scene_description(RouteCall& call);

/// Returns the path of a scene, without an ending.
[[nodiscard]] std::string path_of_scene(const std::string& id);

/// Returns the caches of scenes for a job.
[[nodiscard]] SceneCaches scene_caches(Store& store, const ExecutionContext& execution);

/// Adds 404 for a scene that is not stored.
void check_scene(const std::string& id, const Context& context, ValidationErrors& errors);

/// Returns the schema of what is known of a scene.
[[nodiscard]] Value scene_schema();

}  // namespace sporeprint::api
