#include "api/products/scenes/routes.h"

#include <string>
#include <string_view>

#include "api/http/schemas.h"
#include "api/products/scenes/files.h"
#include "api/products/scenes/uploads.h"
#include "api/products/worlds/routes.h"
#include "core/grow/scene/scene_maps.h"

namespace sporeprint::api {

namespace {

constexpr const char* json = "application/json";

constexpr Route routes[] = {
    {.kind = RouteKind::upload,
     .method = "POST",
     .pattern = "/v1/scenes",
     .id = "post_scene",
     .summary = "Stores a scene for fungi to grow on: a GLB file of at most 200,000 triangles and "
                "50 m, y up, in metres. Equal scenes have one id.",
     .media_type = json,
     .body_type = "model/gltf-binary",
     .success = 201,
     .may_be_stored = true,
     .most_body = most_scene_bytes,
     .response_schema = "scene",
     .plan = plan_scene_upload},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/scenes/{scene}.json",
     .id = "describe_scene",
     .summary = "A stored scene: its size, and what its materials seem to be to fungi.",
     .media_type = json,
     .response_schema = "scene",
     .plan = plan_scene_description},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/scenes/{scene}/{world}/{time}/fungi.glb",
     .id = "get_scene_fungi",
     .summary = "The fruit bodies that stand on a scene on a day, in its coordinates. The world "
                "gives the climate, the soil, the species and the seed; its terrain, its trees "
                "and its extent have no meaning.",
     .media_type = "model/gltf-binary",
     .query_schema = scene_fungi_query_schema,
     .plan = plan_scene_fungi,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/scenes/{scene}/{world}/{time}/placements.csv",
     .id = "get_scene_placements",
     .summary = "Where they stand, a line each, as the placements of worlds.",
     .media_type = "text/csv",
     .query_schema = scene_placement_query_schema,
     .plan = plan_scene_placements<PlacementFile::csv>,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/scenes/{scene}/{world}/{time}/placements.json",
     .id = "list_scene_placements",
     .summary = "The same as JSON.",
     .media_type = json,
     .response_schema = "scene_placements",
     .query_schema = scene_placement_query_schema,
     .plan = plan_scene_placements<PlacementFile::json>,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/scenes/{scene}/{world}/{time}/placements.bin",
     .id = "get_binary_scene_placements",
     .summary = "The same as a table of 88 bytes for each.",
     .media_type = "application/octet-stream",
     .query_schema = scene_placement_query_schema,
     .plan = plan_scene_placements<PlacementFile::bin>,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/scenes/{scene}/{world}/{time}/maps/{map}.bin",
     .id = "get_scene_map",
     .summary = "A number for each vertex or surfel of a scene as floats, low byte first.",
     .media_type = "application/octet-stream",
     .query_schema = scene_map_query_schema,
     .plan = plan_scene_map<SceneMapFile::bin>,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/scenes/{scene}/{world}/{time}/maps/{map}.json",
     .id = "describe_scene_map",
     .summary = "What these numbers are: how many, and their range.",
     .media_type = json,
     .response_schema = "scene_map",
     .query_schema = scene_map_query_schema,
     .plan = plan_scene_map<SceneMapFile::json>,
     .has_version_in_path = true},
};

void add_parameters(Value& parameters, const Route& route, const Atlas& atlas) {
    const std::string_view pattern = route.pattern;
    const auto has = [&](const char* capture) {
        return pattern.find(capture) != std::string_view::npos;
    };
    if (has("{scene}"))
        parameters.push(path_parameter("scene", "The id of a scene.", typed("string"),
                                       "s-0123456789abcdef0123456789abcdef"));
    if (has("{world}")) parameters.push(world_path_parameter(atlas));
    if (has("{time}")) parameters.push(time_path_parameter());
    if (!has("{map}")) return;
    std::string of_species, others;
    for (std::size_t i = 0; i < scene_map_count; ++i) {
        const auto map = static_cast<SceneMap>(i);
        std::string& list = is_of_species(map) ? of_species : others;
        (list += list.empty() ? "" : "|") += name(map);
    }
    parameters.push(
        path_parameter("map", "Which map; spores and probability are of a species of the world.",
                       object({{"type", "string"},
                               {"pattern", "^(" + others + "|(" + of_species + "):[a-z0-9_]+)$"}}),
                       "light"));
}

void add_schemas(Value& schemas, const Atlas&) {
    schemas.set("scene", scene_schema())
        .set("scene_placements", scene_placement_schema())
        .set("scene_map", scene_map_schema());
}

}  // namespace

const RouteGroup scene_routes = {
    .tag = "scenes",
    .description =
        "Scenes of one's own, on whose surfaces fungi grow; only where the service has a folder "
        "for them.",
    .routes = routes,
    .add_schemas = add_schemas,
    .add_parameters = add_parameters};

}  // namespace sporeprint::api
