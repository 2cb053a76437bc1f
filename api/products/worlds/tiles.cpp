#include "api/products/worlds/tiles.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "api/http/schemas.h"
#include "api/products/mushrooms.h"
#include "api/products/surfaces.h"
#include "api/products/trees.h"
#include "api/products/wood.h"
#include "api/products/worlds/parts.h"
#include "api/products/worlds/worlds.h"
#include "core/grow/painting.h"
#include "core/grow/world/parts.h"
#include "core/grow/world/tile.h"
#include "core/grow/world/tile_ground.h"
#include "core/grow/world/tiling.h"
#include "core/params/messages.h"
#include "core/params/query.h"
#include "core/world/weather.h"

namespace sporeprint::api {

namespace {

constexpr std::array all_layers = {PlotLayer::ground, PlotLayer::trees, PlotLayer::floor,
                                   PlotLayer::fungi};
constexpr std::array all_profiles = {TileProfile::web, TileProfile::core};

/// Segments between /v1/ and the name of a tile.
constexpr int depth_of_tiles = 7;

/// Fungi change from day to day, everything else from month to month.
constexpr bool has_days(PlotLayer layer) { return layer == PlotLayer::fungi; }

/// A year, and a month or a day of it.
struct LayerTime {
    int year = 0, month = 0, day = 0;  ///< month or day is 0

    [[nodiscard]] std::string text() const {
        return 'y' + std::to_string(year) +
               (month > 0 ? 'm' + std::to_string(month) : 'd' + std::to_string(day));
    }
    /// Returns noon of its day, or of the middle of its month.
    [[nodiscard]] WorldTime noon() const {
        int of_year = day;
        if (month > 0) {
            of_year = 1 + days_of_months[static_cast<std::size_t>(month - 1)] / 2;
            for (int i = 0; i + 1 < month; ++i)
                of_year += days_of_months[static_cast<std::size_t>(i)];
        }
        return time_of(year, of_year) + ticks_of_day / 2;
    }
};

/// Returns the month of a day of the year.
int month_of(int day) {
    int month = 1;
    for (const int length : days_of_months) {
        if (day <= length) break;
        day -= length;
        ++month;
    }
    return month;
}

/// Returns the time of a layer on a day.
LayerTime time_of_layer(PlotLayer layer, int year, int day) {
    if (has_days(layer)) return {year, 0, day};
    return {year, month_of(day), 0};
}

LayerTime read_layer_time(std::string_view text, PlotLayer layer, ValidationErrors& errors) {
    const std::size_t at = text.find('m');
    if (has_days(layer)) {
        const WorldTimeRead time = read_world_day(text, "fungi are those of a day; add it", errors);
        return {time.year, 0, time.day};
    }
    LayerTime time;
    if (at != std::string_view::npos) {
        const std::string_view month = text.substr(at + 1);
        const auto [end, error] =
            std::from_chars(month.data(), month.data() + month.size(), time.month);
        if (error == std::errc() && end == month.data() + month.size() && time.month >= 1 &&
            time.month <= 12 && month.front() != '0') {
            time.year = read_world_time(text.substr(0, at), errors).year;
            return time;
        }
    }
    errors.add(400, "layertime",
               in_quotes(text) + " is no time of " + name(layer) +
                   ", which changes from month to month; a year and a month from m1 to m12 are "
                   "allowed, as in y80m10");
    return {0, 1, 0};
}

template <class Enum, std::size_t N>
Enum read_name(std::string_view text, const char* parameter, const std::array<Enum, N>& all,
               ValidationErrors& errors) {
    std::string names;
    for (const Enum one : all) {
        if (text == name(one)) return one;
        (names += names.empty() ? "" : ", ") += name(one);
    }
    errors.add(
        404, parameter,
        "unknown " + std::string(parameter) + ' ' + in_quotes(text) + "; there are " + names);
    return all[0];
}

/// Reads a number of a tile; anything but a plain number is that of no tile.
int read_index(std::string_view text) {
    int number = -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || text.front() == '-' ||
        (text.front() == '0' && text.size() > 1))
        return -1;
    return number;
}

/// A tile, or all of a layer, that a URL names.
struct LayerRequest {
    WorldRequest world;
    TileRequest tile;
    LayerTime time;

    [[nodiscard]] std::string folder() const {
        return '/' + std::string(name(tile.profile)) + '/' + time.text() + '/' + name(tile.layer) +
               '/';
    }
    [[nodiscard]] std::string path(const char* ending) const {
        const TileIndex& at = tile.tile;
        return folder() + std::to_string(at.level) + '/' + std::to_string(at.x) + '/' +
               std::to_string(at.y) + ending;
    }
    [[nodiscard]] std::string file_name(const char* ending) const {
        const TileIndex& at = tile.tile;
        return world.spec.preset + '_' + name(tile.layer) + '_' + time.text() + '_' +
               std::to_string(at.level) + '_' + std::to_string(at.x) + '_' + std::to_string(at.y) +
               ending;
    }
};

/// Reads {world}, {profile}, {layertime} and {layer}; no route of tiles has a query.
LayerRequest read_layer(const RouteCall& call, ValidationErrors& errors) {
    LayerRequest request;
    request.world = read_world(call.captured[0], call.context, errors);
    request.tile.profile = read_name(call.captured[1], "profile", all_profiles, errors);
    request.tile.layer = read_name(call.captured[3], "layer", all_layers, errors);
    request.time = read_layer_time(call.captured[2], request.tile.layer, errors);
    request.tile.time = request.time.noon();
    request.tile.tiling.extent = request.world.spec.params.extent;
    refuse_query_of_world(call.target, errors);
    return request;
}

LayerRequest read_tile(const RouteCall& call, ValidationErrors& errors) {
    LayerRequest request = read_layer(call, errors);
    TileIndex& tile = request.tile.tile;
    tile = {read_index(call.captured[4]), read_index(call.captured[5]),
            read_index(call.captured[6])};
    const Tiling& tiling = request.tile.tiling;
    if (!errors.empty() || tiling.has(tile)) return request;
    errors.add(404, "level",
               "there is no tile " + call.captured[4] + '/' + call.captured[5] + '/' +
                   call.captured[6] + "; levels are 0 to " + std::to_string(tiling.levels() - 1) +
                   ", x and y of a level l 0 to 2^l - 1");
    return request;
}

TileReach reach_in(const WorldParams& params, const Atlas& atlas, const Ground& ground) {
    return reach_of(ground, params, stand_of(params, lookup_in(atlas)));
}

Value box_value(const TileBox& box) {
    const std::array<double, 12> numbers = box.numbers();
    return Value::object().set("box", Value(Value::Array(numbers.begin(), numbers.end())));
}

/// Returns the box of all layers.
TileBox box_of_world(const Tiling& tiling, const TileReach& reach) {
    TileBox all = box_of(tiling, {}, all_layers[0], reach);
    for (const PlotLayer layer : all_layers) {
        const TileBox box = box_of(tiling, {}, layer, reach);
        all = {std::min(all.west, box.west),   std::min(all.south, box.south),
               std::min(all.low, box.low),     std::max(all.east, box.east),
               std::max(all.north, box.north), std::max(all.high, box.high)};
    }
    return all;
}

/// Returns the implicit root tile of a layer.
///
/// folder  URL of its tiles
Value root_of_layer(const Tiling& tiling, PlotLayer layer, const TileReach& reach,
                    const std::string& folder) {
    // Readers that do not know boxes of single tiles divide this one, so it is that of the ground alone in the plane.
    TileBox box = box_of(tiling, {}, layer, reach);
    const WorldBox square = tiling.box({});
    box = {square.west, square.south, box.low, square.east, square.north, box.high};
    return Value::object()
        .set("boundingVolume", box_value(box))
        .set("geometricError", geometric_error(tiling.side(0)))
        .set("refine", layer == PlotLayer::floor ? "ADD" : "REPLACE")
        .set("content", Value::object().set("uri", folder + "{level}/{x}/{y}.glb"))
        .set("implicitTiling",
             Value::object()
                 .set("subdivisionScheme", "QUADTREE")
                 .set("subtreeLevels", tiling.levels_of_subtree())
                 .set("availableLevels", tiling.levels())
                 .set("subtrees", Value::object().set("uri", folder + "{level}/{x}/{y}.subtree")));
}

Value tileset_of(const Tiling& tiling, const TileReach& reach, const std::string& canonical,
                 Value::Array layers) {
    const double extent = tiling.extent;
    const Value box_of_tile = Value::object()
                                  .set("type", "SCALAR")
                                  .set("componentType", "FLOAT64")
                                  .set("array", true)
                                  .set("count", 12)
                                  .set("semantic", "TILE_BOUNDING_BOX");
    return Value::object()
        .set("asset", Value::object()
                          .set("version", "1.1")
                          .set("extras", Value::object().set("canonical", canonical)))
        .set("schema",
             Value::object()
                 .set("id", "sporeprint_tiles")
                 .set("classes", Value::object().set(
                                     "tile", Value::object().set(
                                                 "properties",
                                                 Value::object().set("boundingBox", box_of_tile)))))
        .set("geometricError", 4.0 * extent)
        .set("root", Value::object()
                         .set("boundingVolume", box_value(box_of_world(tiling, reach)))
                         .set("geometricError", 2.0 * extent)
                         .set("refine", "ADD")
                         .set("children", Value(std::move(layers))));
}

/// Lets a resource be made of the ground of a world, which a job of its own computes before if it is not cached.
void make_of_ground(Resource& resource, const WorldParams& params,
                    std::function<Slice(const Ground&)> make) {
    resource.prerequisite = [params](Store& store) { return ground_job(store, params); };
    resource.make = [params, make = std::move(make)](JobContext& job) {
        const ExecutionContext& execution = job.execution();
        execution.observer(Step::resolve);
        const SharedGround ground = ground_of_world(params, execution.caches);
        execution.observer(Step::pack);
        return Body{make(*ground)};
    };
}

/// Returns the cost of a tile whose blocks are computed.
Cost cost_of_tile(const TileRequest& tile) {
    const double side = tile.tiling.side(tile.tile.level);
    if (!has_content(tile.layer, side)) return {.base = 200};
    switch (tile.layer) {
        case PlotLayer::ground:
            return {.base = side > coarsest_of_trees ? 18'000U
                            : side > finest_tile     ? 5'000U
                                                     : 12'000U,
                    .texels = texels_of_tile(side).all(),
                    .bytes = 150'000};
        case PlotLayer::trees:
            return {.base = 8'000, .bytes = 40'000};
        case PlotLayer::floor:
            return {.base = 12'000, .bytes = 100'000};
        case PlotLayer::fungi:
            return {.base = 15'000, .bytes = 20'000};
    }
    return {};
}

/// Returns how tiles refer to what they share.
TileLinks links_of(const Context& context, const ExecutionContext& execution) {
    const Atlas& atlas = *context.atlas;
    const auto reference = [](const std::string& address, const std::string& version) {
        return reference_from(depth_of_tiles, with_version(address, version));
    };
    TileLinks links;
    links.tree = [&atlas, reference](const TreeSpec& spec) {
        return reference(canonical_address<Trees>(atlas, spec, Product::bin),
                         preset_token<Trees>(atlas, spec.preset));
    };
    links.mushroom = [&atlas, reference](const MushroomSpec& spec) {
        return reference(canonical_address(spec, Product::bin), version_token(spec.mix, atlas));
    };
    links.bark = [&context, &execution](const TreeSpec& spec) {
        return references_from(
            depth_of_tiles,
            PresetProduct<Trees>::image_urls(
                context, spec, preset_token<Trees>(*context.atlas, spec.preset), execution));
    };
    links.leaves = [&atlas](const std::string& leaf, const LeafPaint& paint) {
        return references_from(depth_of_tiles, foliage_image_urls(leaf, paint, atlas));
    };
    links.skin = [&context, &execution](const MushroomSpec& spec) {
        return references_from(depth_of_tiles, Mushrooms::image_urls(context, spec, {}, execution));
    };
    links.wood = [](const WoodPaint& paint) {
        return references_from(depth_of_tiles, wood_image_urls("mushrooms", paint));
    };
    return links;
}

/// Plans the response to a request for a tileset.
///
/// layers  of one world
/// folder  of the tileset below that of the world
Plan plan_tileset_of(RouteCall& call, std::vector<LayerRequest> layers, const std::string& folder,
                     const std::string& file_name) {
    Context& context = call.context;
    if (!call.errors.empty()) return context.responses.problem(call.request, call.errors);
    const WorldRequest& world = layers.front().world;
    const WorldParams& params = world.spec.params;
    Resource resource = world_resource(context, world, folder + "tileset.json", {});
    resource.file_name = file_name + ".json";
    resource.estimate_cost = [](const Caches&) { return Cost{.base = 3'000}; };
    const std::string of_world =
        folder_of(Worlds::all) + world_text(world.spec, *context.atlas, resource.version);
    make_of_ground(
        resource, params,
        [&context, params, layers = std::move(layers), of_world,
         address = resource.address](const Ground& ground) {
            const Tiling tiling{params.extent};
            const TileReach reach = reach_in(params, *context.atlas, ground);
            Value::Array roots;
            for (const LayerRequest& layer : layers)
                roots.push_back(root_of_layer(tiling, layer.tile.layer, reach,
                                              context.responses.link(of_world + layer.folder())));
            return slice_of(
                dump(tileset_of(tiling, reach, context.responses.link(address), std::move(roots))));
        });
    return plan_resource(context, call.request, std::move(resource), call.errors);
}

}  // namespace

Plan plan_tileset(RouteCall& call) {
    const WorldRequest world = read_world(call.captured[0], call.context, call.errors);
    const TileProfile profile = read_name(call.captured[1], "profile", all_profiles, call.errors);
    const WorldTimeRead time =
        read_world_day(call.captured[2], "fungi are those of a day; add it", call.errors);
    refuse_query_of_world(call.target, call.errors);
    std::vector<LayerRequest> layers;
    for (const PlotLayer layer : all_layers) {
        LayerRequest one{world, {}, time_of_layer(layer, time.year, time.day)};
        one.tile.profile = profile;
        one.tile.layer = layer;
        layers.push_back(std::move(one));
    }
    return plan_tileset_of(call, std::move(layers),
                           '/' + std::string(name(profile)) + '/' + time.text() + '/',
                           world.spec.preset + "_tileset_" + time.text());
}

Plan plan_layer_tileset(RouteCall& call) {
    LayerRequest layer = read_layer(call, call.errors);
    const std::string folder = layer.folder(), file_name = layer.world.spec.preset + '_' +
                                                           name(layer.tile.layer) + '_' +
                                                           layer.time.text() + "_tileset";
    return plan_tileset_of(call, {std::move(layer)}, folder, file_name);
}

Plan plan_subtree(RouteCall& call) {
    Context& context = call.context;
    const auto request = std::make_shared<const LayerRequest>(read_tile(call, call.errors));
    const Tiling& tiling = request->tile.tiling;
    if (call.errors.empty() && request->tile.tile.level % tiling.levels_of_subtree() != 0)
        call.errors.add(404, "level",
                        "subtrees begin at levels 0 and " +
                            std::to_string(tiling.levels_of_subtree()) + ", not at " +
                            std::to_string(request->tile.tile.level));
    if (!call.errors.empty()) return context.responses.problem(call.request, call.errors);
    Resource resource = world_resource(context, request->world, request->path(".subtree"), {});
    resource.type = "application/octet-stream";
    resource.file_name = request->file_name(".subtree");
    resource.estimate_cost = [](const Caches&) { return Cost{.base = 4'000}; };
    make_of_ground(resource, request->world.spec.params, [&context, request](const Ground& ground) {
        const TileReach reach = reach_in(request->world.spec.params, *context.atlas, ground);
        const TileRequest& tile = request->tile;
        return Slice(
            std::make_shared<const Bytes>(subtree_of(tile.tiling, tile.tile, tile.layer, reach)));
    });
    return plan_resource(context, call.request, std::move(resource), call.errors);
}

Plan plan_tile(RouteCall& call) {
    Context& context = call.context;
    const auto request = std::make_shared<const LayerRequest>(read_tile(call, call.errors));
    if (!call.errors.empty()) return context.responses.problem(call.request, call.errors);
    Resource resource = world_resource(context, request->world, request->path(".glb"), {});
    resource.type = type_of(Product::glb);
    resource.file_name = request->file_name(".glb");
    resource.estimate_cost = [cost = cost_of_tile(request->tile)](const Caches&) { return cost; };
    make_of_world(resource, request->world.spec.params, context.atlas,
                  [&context, request, address = resource.address](
                      const SharedWorld& world, const ExecutionContext& execution) -> Body {
                      Extras extras;
                      extras.canonical = context.responses.link(address);
                      return grow_tile(world, request->tile, *context.atlas,
                                       links_of(context, execution), extras, execution)
                          .glb;
                  });
    return plan_resource(context, call.request, std::move(resource), call.errors);
}

void add_tile_parameters(Value& parameters, std::string_view pattern) {
    const auto has = [&](const char* capture) {
        return pattern.find(capture) != std::string_view::npos;
    };
    const auto names = [](const auto& all) {
        Value list = Value::array();
        for (const auto one : all) list.push(name(one));
        return object({{"type", "string"}, {"enum", std::move(list)}});
    };
    const auto number = [&](const char* own, const char* doc, int most) {
        parameters.push(path_parameter(
            own, doc, object({{"type", "integer"}, {"minimum", 0}, {"maximum", most}}), "0"));
    };
    if (has("{profile}"))
        parameters.push(path_parameter(
            "profile",
            "web: shapes that tiles share are files of their own, and trees and fungi are "
            "instances (EXT_mesh_gpu_instancing). core: each tile contains all that it shows.",
            names(all_profiles), "web"));
    if (has("{layertime}"))
        parameters.push(path_parameter(
            "layertime",
            "A year with the time that the layer needs: a month, as in y80m10, for ground, trees "
            "and floor; a day, as in y80d270, for fungi.",
            object({{"type", "string"}, {"pattern", "^y\\d{1,3}[md]\\d{1,3}$"}}), "y80m10"));
    if (has("{layer}"))
        parameters.push(
            path_parameter("layer", "A layer of the world.", names(all_layers), "ground"));
    if (has("{level}")) number("level", "Level of the tile, 0 for the whole world.", 9);
    if (has("{x}")) number("x", "Column of the tile, from the west.", 511);
    if (has("{y}")) number("y", "Row of the tile, from the south.", 511);
}

Value tileset_schema() {
    const Value any = object({{"type", "object"}}), number = typed("number");
    return objects({{"asset", any}, {"schema", any}, {"geometricError", number}, {"root", any}});
}

}  // namespace sporeprint::api
