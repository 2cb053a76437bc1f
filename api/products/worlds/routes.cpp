#include "api/products/worlds/routes.h"

#include <string>
#include <string_view>
#include <utility>

#include "api/http/schemas.h"
#include "api/products/presets.h"
#include "api/products/worlds/description.h"
#include "api/products/worlds/limits.h"
#include "api/products/worlds/maps.h"
#include "api/products/worlds/part_request.h"
#include "api/products/worlds/placements.h"
#include "api/products/worlds/plots.h"
#include "api/products/worlds/seasons.h"
#include "api/products/worlds/tiles.h"
#include "api/products/worlds/worlds.h"
#include "core/params/schema.h"

namespace sporeprint::api {

namespace {

constexpr const char* json = "application/json";

constexpr Route routes[] = {
    {.kind = RouteKind::document,
     .method = "GET",
     .pattern = "/v1/worlds",
     .id = "list_worlds",
     .summary = "The worlds to begin with.",
     .media_type = json,
     .response_schema = "world_list",
     .document = [](const DocumentInputs& inputs) { return world_list(inputs.atlas); }},
    {.kind = RouteKind::document,
     .method = "GET",
     .pattern = "/v1/worlds/schema",
     .id = "world_schema",
     .summary = "JSON Schema of the parameters that the text of a world names.",
     .media_type = "application/schema+json",
     .document =
         [](const DocumentInputs&) {
             return from_preset<WorldPreset>(schema_document<WorldParams>("Parameters of a world"));
         }},
    // Before /v1/worlds/{world}.json, which has the form of some of them.
    {.kind = RouteKind::product,
     .method = "POST",
     .pattern = "/v1/worlds/plot.glb",
     .id = "post_plot",
     .summary = "A piece of a world from a body, which may also have ecologies, founders and masks "
                "of its own.",
     .media_type = "model/gltf-binary",
     .body_type = json,
     .most_body = most_part_body,
     .request_body = "plot_order",
     .plan = plan_plot<Product::glb>},
    {.kind = RouteKind::product,
     .method = "POST",
     .pattern = "/v1/worlds/plot.json",
     .id = "post_plot_description",
     .summary = "What stands, lies and grows on it.",
     .media_type = json,
     .body_type = json,
     .most_body = most_part_body,
     .response_schema = "world_plot",
     .request_body = "plot_order",
     .plan = plan_plot<Product::json>},
    {.kind = RouteKind::product,
     .method = "POST",
     .pattern = "/v1/worlds/plot.png",
     .id = "post_plot_picture",
     .summary = "A picture of it.",
     .media_type = "image/png",
     .body_type = json,
     .most_body = most_part_body,
     .request_body = "plot_picture_order",
     .plan = plan_plot<Product::png>},
    {.kind = RouteKind::product,
     .method = "POST",
     .pattern = "/v1/worlds/placements.csv",
     .id = "post_placements",
     .summary = "Where things stand in a world from a body, a line each.",
     .media_type = "text/csv",
     .body_type = json,
     .most_body = most_part_body,
     .request_body = "placement_order",
     .plan = plan_placements<PlacementFile::csv>},
    {.kind = RouteKind::product,
     .method = "POST",
     .pattern = "/v1/worlds/placements.json",
     .id = "post_placement_list",
     .summary = "The same as JSON.",
     .media_type = json,
     .body_type = json,
     .most_body = most_part_body,
     .response_schema = "world_placements",
     .request_body = "placement_order",
     .plan = plan_placements<PlacementFile::json>},
    {.kind = RouteKind::product,
     .method = "POST",
     .pattern = "/v1/worlds/maps/{map}.png",
     .id = "post_map",
     .summary = "A map of a world from a body.",
     .media_type = "image/png",
     .body_type = json,
     .most_body = most_part_body,
     .request_body = "map_order",
     .plan = plan_map<MapFile::png>},
    {.kind = RouteKind::product,
     .method = "POST",
     .pattern = "/v1/worlds/maps/{map}.json",
     .id = "post_map_description",
     .summary = "What its numbers mean.",
     .media_type = json,
     .body_type = json,
     .most_body = most_part_body,
     .response_schema = "world_map",
     .request_body = "map_order",
     .plan = plan_map<MapFile::json>},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/worlds/{world}.json",
     .id = "describe_world",
     .summary = "A world: its canonical text, its effective parameters, and what there is of it.",
     .media_type = json,
     .response_schema = "world_description",
     .plan = plan_description,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/worlds/{world}/weather.json",
     .id = "get_weather",
     .summary = "The weather on each day of a year: rain, temperature, the evaporation from ground "
                "that is "
                "wet, and the water in the soil.",
     .media_type = json,
     .response_schema = "weather",
     .query_schema = weather_query_schema,
     .plan = plan_weather,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/worlds/{world}/{time}/maps/{map}.png",
     .id = "get_map",
     .summary =
         "A map of a world: grey numbers of 16 bits, heights in the colours of Terrarium, or "
         "species in those of a palette.",
     .media_type = "image/png",
     .query_schema = map_query_schema,
     .plan = plan_map<MapFile::png>,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/worlds/{world}/{time}/maps/{map}.r16",
     .id = "get_raw_map",
     .summary = "The same numbers alone, rows from north to south, low byte first.",
     .media_type = "application/octet-stream",
     .query_schema = map_query_schema,
     .plan = plan_map<MapFile::r16>,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/worlds/{world}/{time}/maps/{map}.json",
     .id = "describe_map",
     .summary = "What the numbers of a map mean: unit, range, size, edges.",
     .media_type = json,
     .response_schema = "world_map",
     .query_schema = map_query_schema,
     .plan = plan_map<MapFile::json>,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/worlds/{world}/season.json",
     .id = "get_season",
     .summary = "How many fruit bodies of each species stand on each day of a year, beside the "
                "weather.",
     .media_type = json,
     .response_schema = "world_season",
     .query_schema = season_query_schema,
     .plan = plan_season,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/worlds/{world}/{time}/plot.glb",
     .id = "get_plot",
     .summary = "A piece of a world on a day: ground, trees, dead wood, litter and fungi.",
     .media_type = "model/gltf-binary",
     .query_schema = plot_query_schema,
     .plan = plan_plot<Product::glb>,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/worlds/{world}/{time}/plot.json",
     .id = "describe_plot",
     .summary = "What stands, lies and grows on it: places, sizes, ages, and the model of each "
                "fruit body.",
     .media_type = json,
     .response_schema = "world_plot",
     .query_schema = plot_query_schema,
     .plan = plan_plot<Product::json>,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/worlds/{world}/{time}/plot.png",
     .id = "picture_plot",
     .summary = "A picture of a plot, from its edge or from above.",
     .media_type = "image/png",
     .query_schema = plot_picture_query_schema,
     .plan = plan_plot<Product::png>,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/worlds/{world}/{time}/placements.csv",
     .id = "get_placements",
     .summary = "Where trees, dead trunks and fruit bodies stand on a day, a line each.",
     .media_type = "text/csv",
     .query_schema = placement_query_schema,
     .plan = plan_placements<PlacementFile::csv>,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/worlds/{world}/{time}/placements.json",
     .id = "list_placements",
     .summary = "The same as JSON.",
     .media_type = json,
     .response_schema = "world_placements",
     .query_schema = placement_query_schema,
     .plan = plan_placements<PlacementFile::json>,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/worlds/{world}/{time}/placements.bin",
     .id = "get_binary_placements",
     .summary = "The same as a table of 88 bytes for each.",
     .media_type = "application/octet-stream",
     .query_schema = placement_query_schema,
     .plan = plan_placements<PlacementFile::bin>,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/worlds/{world}/{time}/limits.json",
     .id = "get_limits",
     .summary = "What keeps each species from fruiting at a place on a day.",
     .media_type = json,
     .response_schema = "world_limits",
     .query_schema = limits_query_schema,
     .plan = plan_limits,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/worlds/{world}/{profile}/{time}/tileset.json",
     .id = "get_tileset",
     .summary = "The whole world of a day as 3D Tiles: ground, trees, floor and fungi.",
     .media_type = json,
     .response_schema = "world_tileset",
     .plan = plan_tileset,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/worlds/{world}/{profile}/{layertime}/{layer}/tileset.json",
     .id = "get_layer_tileset",
     .summary = "One layer of it as 3D Tiles.",
     .media_type = json,
     .response_schema = "world_tileset",
     .plan = plan_layer_tileset,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/worlds/{world}/{profile}/{layertime}/{layer}/{level}/{x}/{y}.subtree",
     .id = "get_subtree",
     .summary = "Which tiles below a tile there are, and their boxes.",
     .media_type = "application/octet-stream",
     .plan = plan_subtree,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/worlds/{world}/{profile}/{layertime}/{layer}/{level}/{x}/{y}.glb",
     .id = "get_tile",
     .summary = "A tile: a layer of a square of the world.",
     .media_type = "model/gltf-binary",
     .plan = plan_tile,
     .has_version_in_path = true},
};

void add_links(Value& links, const Atlas&) {
    links.set("worlds", "/v1/worlds").set("world_schema", "/v1/worlds/schema");
}

void add_parameters(Value& parameters, const Route& route, const Atlas& atlas) {
    const std::string_view pattern = route.pattern;
    const auto has = [&](const char* capture) {
        return pattern.find(capture) != std::string_view::npos;
    };
    if (has("{world}")) parameters.push(world_path_parameter(atlas));
    if (has("{time}")) parameters.push(time_path_parameter());
    if (has("{map}"))
        parameters.push(path_parameter(
            "map", "Which map.",
            object({{"type", "string"},
                    {"enum", map_names(pattern.ends_with(".r16") ? MapFile::r16 : MapFile::png)}}),
            "height"));
    add_tile_parameters(parameters, pattern);
}

void add_schemas(Value& schemas, const Atlas&) {
    const Value text = typed("string"), number = typed("number"), whole = typed("integer");
    const Value days = list_of(number);
    const Value sums = objects({{"rain_mm", number},
                                {"rain_days", whole},
                                {"temperature_c", number},
                                {"potential_evaporation_mm", number},
                                {"soil_water_mm", number}});
    Value fungus = objects({{"id", text}, {"guild", text}, {"possible", typed("boolean")}});
    fungus.find("properties")->set("why_not", text);
    schemas.set("world_params", as_written(schema<WorldParams>()))
        .set("world_list",
             objects({{"worlds",
                       list_of(objects({{"id", text}, {"name", text}, {"links", map_of(text)}}))}}))
        .set("world_description", objects({{"canonical", text},
                                           {"world", text},
                                           {"v", text},
                                           {"preset", text},
                                           {"effective", reference("schemas/world_params")},
                                           {"fungi", list_of(std::move(fungus))},
                                           {"years", list_of(whole)},
                                           {"maps", map_of(text)},
                                           {"links", map_of(text)}}))
        .set("world_map", map_schema())
        .set("world_season", season_schema())
        .set("world_plot", plot_schema())
        .set("world_placements", placement_schema())
        .set("world_limits", limits_schema())
        .set("world_tileset", tileset_schema())
        .set("weather", objects({{"world", text},
                                 {"year", whole},
                                 {"days", objects({{"rain_mm", days},
                                                   {"temperature_c", days},
                                                   {"potential_evaporation_mm", days},
                                                   {"soil_water_mm", days}})},
                                 {"months", list_of(sums)},
                                 {"whole_year", sums},
                                 {"most_soil_water_mm", number}}));
}

void add_bodies(Value& bodies, const Atlas& atlas) {
    const auto add = [&](const char* name, const char* what, Value params) {
        bodies.set(name,
                   json_body(std::string(what) +
                                 " of a world on a day, which may have ecologies, founders "
                                 "and masks of its own.",
                             part_body_schema(atlas, std::move(params)), part_body_example(atlas)));
    };
    add("plot_order", "A plot", plot_query_schema(atlas));
    add("plot_picture_order", "A picture of a plot", plot_picture_query_schema(atlas));
    add("placement_order", "Placements", placement_query_schema(atlas));
    add("map_order", "A map", map_query_schema(atlas));
}

}  // namespace

Value world_path_parameter(const Atlas& atlas) {
    return path_parameter(
        "world",
        "Id of a preset, then what differs from it as ,name=value by the names of "
        "/v1/worlds/schema, last perhaps ,v= and a version token: today's makes the answer "
        "immutable, any other is 410 with the canonical address of today's.",
        object({{"type", "string"}, {"maxLength", longest_world}}),
        atlas.worlds().front().id.string() + ",seed=7");
}

Value time_path_parameter() {
    return path_parameter("time",
                          "A year from y0 to y200, with a day from d1 to d365 for "
                          "what changes from day to day.",
                          object({{"type", "string"}, {"pattern", "^y\\d{1,3}(d\\d{1,3})?$"}}),
                          "y80d270");
}

const RouteGroup world_routes = {
    .tag = "worlds",
    .description =
        "Worlds: woods and meadows of a square kilometre through 200 years, their ground, weather, "
        "trees and fungi.",
    .routes = routes,
    .add_links = add_links,
    .add_schemas = add_schemas,
    .add_bodies = add_bodies,
    .add_parameters = add_parameters,
};

}  // namespace sporeprint::api
