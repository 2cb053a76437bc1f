#include "api/products/world_plots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "api/http/schemas.h"
#include "api/products/resource.h"
#include "api/products/world_parts.h"
#include "api/products/worlds.h"
#include "core/grow/plot_of_world.h"
#include "core/params/query.h"
#include "core/params/schema.h"
#include "core/world/season.h"
#include "core/world/tree_growth.h"

namespace sporeprint::api {

namespace {

/// The query of a plot.
struct PlotParams {
    double x = 0.0, y = 0.0;
    double size = 10.0;
    int lod = 1;
    double litter = 20.0;
    LeafInstancing instancing = LeafInstancing::none;
    Textures textures = Textures::embedded;
    Choice<256, 512, 1024, 2048> texture_size{1024};
    Compression compress = Compression::none;
    ImageFormats image_format = ImageFormats::jpg;
    MaterialSet materials = MaterialSet::full;

    static constexpr void fields(auto visit) {
        using P = PlotParams;
        visit(&P::x, Info{.name = "x",
                          .unit = "m",
                          .min = -2048,
                          .max = 2048,
                          .doc = "Place of its middle, to the east of the centre of the world."});
        visit(&P::y, Info{.name = "y",
                          .unit = "m",
                          .min = -2048,
                          .max = 2048,
                          .doc = "Place of its middle, to the north of the centre of the world."});
        visit(
            &P::size,
            Info{.name = "size", .unit = "m", .min = 2, .max = 32, .doc = "Length of its sides."});
        visit(&P::lod, Info{.name = "lod",
                            .min = 0,
                            .max = 2,
                            .doc = "Level of detail of the fruit bodies; trees have the next one. "
                                   "Where there are too many of them, they have fewer triangles."});
        visit(&P::litter,
              Info{.name = "litter",
                   .unit = "per m²",
                   .min = 0,
                   .max = 100,
                   .doc = "Leaves that are meshes where leaves cover the ground; others "
                          "are painted."});
        visit(&P::instancing,
              Info{.name = "instancing",
                   .doc = "How leaves and fruit bodies are repeated: as meshes and nodes, or by "
                          "EXT_mesh_gpu_instancing."});
        visit(&P::textures, info_of<LeafParams>("textures"));
        visit(&P::texture_size, Info{.name = "texture_size",
                                     .unit = "texels",
                                     .doc = "Side of the images of the ground."});
        visit(&P::compress, info_of<FileOptions>("compress"));
        visit(&P::image_format, info_of<FileOptions>("image_format"));
        visit(&P::materials, info_of<FileOptions>("materials"));
    }
    bool operator==(const PlotParams&) const = default;
};
static_assert(well_described<PlotParams>());

/// A plot that a URL names.
struct PlotRequest {
    WorldRequest world;
    WorldTimeRead time;
    PlotParams params;

    [[nodiscard]] WorldBox box() const {
        const double half = 0.5 * params.size;
        return {params.x - half, params.y - half, params.x + half, params.y + half};
    }
    /// Noon of its day.
    [[nodiscard]] WorldTime moment() const {
        return time_of(time.year, time.day) + ticks_of_day / 2;
    }
    [[nodiscard]] std::string time_text() const {
        return 'y' + std::to_string(time.year) + 'd' + std::to_string(time.day);
    }
};

/// Reports a plot that is partly outside its world.
void check_place(const PlotRequest& request, ValidationErrors& errors) {
    const WorldBox extent = extent_of(request.world.spec.params), box = request.box();
    const auto check = [&](double low, double high, double least, double most, const char* name) {
        if (low >= least && high <= most) return;
        const double half = 0.5 * request.params.size;
        errors.add(422, name,
                   "the plot is partly outside the world; with size=" +
                       number_text(request.params.size) + " its middle is between " +
                       number_text(least + half) + " and " + number_text(most - half));
    };
    check(box.west, box.east, extent.west, extent.east, "x");
    check(box.south, box.north, extent.south, extent.north, "y");
}

PlotRequest read_plot(const RouteCall& call, ValidationErrors& errors) {
    PlotRequest request;
    request.world = read_world(call.captured[0], *call.context.atlas, errors);
    request.time = read_world_time(call.captured[1], errors);
    if (request.time.is_valid && request.time.day == 0)
        errors.add(400, "time", "a plot is of one day; add it, as in " + call.captured[1] + "d270");
    std::vector<Problem> problems;
    read_query(query_of_world(call.target, errors), request.params, problems);
    errors.add(400, problems);
    without_negative_zero(request.params);
    if (errors.empty()) check_place(request, errors);
    return request;
}

std::unique_ptr<const WorldPlot> plot_of(const PlotRequest& request, const Atlas& atlas,
                                         const ExecutionContext& execution) {
    const PlotParams& params = request.params;
    return plot_of_world(world_of_request(request.world.spec.params, atlas, execution),
                         {params.x, params.y, params.size}, request.moment(), execution);
}

PlotOptions options_of(const PlotParams& params) {
    PlotOptions options;
    options.lod = params.lod;
    options.texture_size = params.texture_size;
    options.litter = params.litter;
    options.instancing = params.instancing;
    options.textures = params.textures;
    options.file.compress = params.compress;
    options.file.image_format = params.image_format;
    options.file.materials = params.materials;
    return options;
}

/// Returns the approximate cost of a plot whose world is computed.
Cost cost_of_plot(const PlotRequest& request, PlotFile file) {
    const PlotParams& params = request.params;
    // The blocks round it, their mycelia and their fruit bodies, of which one plot in five finds none computed.
    const std::uint64_t blocks = blocks_of(request.box()).size();
    Cost cost{.base = 20'000 + 100'000 * blocks};
    if (file == PlotFile::json) return cost;
    const auto area = static_cast<std::uint64_t>(params.size * params.size);
    cost.placed_vertices = 100'000 + area * 1000;
    cost.bytes = 4'000'000 + area * 20'000;
    if (params.textures == Textures::embedded)
        cost.texels = 3 * static_cast<std::uint64_t>(params.texture_size) *
                      static_cast<std::uint64_t>(params.texture_size);
    return cost;
}

double rounded(double value, double steps) { return std::round(value * steps) / steps + 0.0; }

/// Returns an id as text: numbers of JSON have 53 bits.
std::string id_text(std::uint64_t id) {
    constexpr const char* digits = "0123456789abcdef";
    std::string text(16, '0');
    for (std::size_t i = 0; i < 16; ++i) text[i] = digits[id >> (60U - 4U * i) & 15U];
    return text;
}

Value place_value(const World& world, WorldPoint at) {
    return Value(Value::Array{rounded(metres(at.x), 1000.0), rounded(metres(at.y), 1000.0),
                              rounded(world.place_at(at).height, 1000.0)});
}

Value trees_on(const WorldPlot& plot, const WorldBox& box, WorldTime time) {
    Value list = Value::array();
    for (const StandTree& tree : plot.around.trees) {
        if (!tree.lives_at(time) || !contains(box, tree.at)) continue;
        const double height = height_at(tree, time);
        list.push(Value::object()
                      .set("id", id_text(tree.id))
                      .set("kind", plot.content.kinds[tree.kind])
                      .set("place_m", place_value(*plot.world, tree.at))
                      .set("age_years", rounded(years_between(tree.born, time), 10.0))
                      .set("height_m", rounded(height, 100.0))
                      .set("diameter_m", rounded(trunk_diameter(height), 1000.0)));
    }
    return list;
}

Value dead_on(const WorldPlot& plot, const WorldBox& box, WorldTime time) {
    Value list = Value::array();
    for (const DeadWood& wood : plot.around.dead) {
        const bool stands = wood.stands_at(time);
        if ((!stands && !wood.lies_at(time)) || !contains(box, wood.at)) continue;
        list.push(Value::object()
                      .set("id", id_text(wood.id))
                      .set("kind", plot.content.kinds[wood.kind])
                      .set("stands", stands)
                      .set("place_m", place_value(*plot.world, wood.at))
                      .set("length_m", rounded(wood.length, 100.0))
                      .set("diameter_m", rounded(2.0 * radius_at(wood, time), 1000.0))
                      .set("mass_lost", rounded(mass_lost(wood, time), 1000.0)));
    }
    return list;
}

Value bodies_on(const Context& context, const WorldPlot& plot, WorldTime time) {
    Value list = Value::array();
    for (const FruitBody& body : plot.bodies) {
        const std::string& species = plot.content.species[body.species];
        const double age = rounded(age_at(body, time), 100.0);
        list.push(Value::object()
                      .set("id", id_text(body.id))
                      .set("species", species)
                      .set("place_m", place_value(*plot.world, body.at))
                      .set("above_ground_m", rounded(body.height, 1000.0))
                      .set("age", age)
                      .set("days_old",
                           rounded(static_cast<double>(time - body.emerged) / ticks_of_day, 10.0))
                      .set("model", context.responses.link(
                                        "/v1/mushrooms/" + species + ".glb?seed=" +
                                        std::to_string(body.seed()) + "&age=" + number_text(age))));
    }
    return list;
}

std::string path_of(const PlotRequest& request, PlotFile file) {
    return '/' + request.time_text() + (file == PlotFile::glb ? "/plot.glb" : "/plot.json");
}

Value describe(const Context& context, const PlotRequest& request, const WorldPlot& plot,
               const std::string& world) {
    const WorldBox box = request.box();
    const WorldTime time = request.moment();
    const auto link = [&](PlotFile file) {
        return context.responses.link(with_query(
            folder_of(Worlds::all) + world + path_of(request, file), query_text(request.params)));
    };
    return Value::object()
        .set("world", world)
        .set("time", request.time_text())
        .set("bbox", Value(Value::Array{box.west, box.south, box.east, box.north}))
        .set("soil_water_mm", rounded(plot.content.soil_water, 100.0))
        .set("trees", trees_on(plot, box, time))
        .set("dead_wood", dead_on(plot, box, time))
        .set("fruit_bodies", bodies_on(context, plot, time))
        .set("links",
             Value::object().set("self", link(PlotFile::json)).set("model", link(PlotFile::glb)));
}

Plan plan_file(RouteCall& call, PlotFile file) {
    Context& context = call.context;
    const auto request = std::make_shared<const PlotRequest>(read_plot(call, call.errors));
    if (!call.errors.empty()) return context.responses.problem(call.request, call.errors);
    Resource resource = world_resource(context, request->world, path_of(*request, file),
                                       query_text(request->params));
    if (file == PlotFile::glb) resource.type = "model/gltf-binary";
    resource.file_name = request->world.spec.preset + "_plot_" + request->time_text() +
                         (file == PlotFile::glb ? ".glb" : ".json");
    resource.estimate_cost = [cost = cost_of_plot(*request, file)](const Caches&) { return cost; };
    resource.prerequisite = [request, atlas = context.atlas](Store& store) {
        return world_job(store, request->world.spec.params, atlas);
    };
    resource.make = [&context, request, file, address = resource.address,
                     world = world_text(request->world.spec, *context.atlas, resource.version)](
                        JobContext& job) {
        const ExecutionContext& execution = job.execution();
        execution.observer(Step::resolve);
        const std::unique_ptr<const WorldPlot> plot = plot_of(*request, *context.atlas, execution);
        if (file == PlotFile::json) {
            execution.observer(Step::pack);
            return Body{slice_of(dump(describe(context, *request, *plot, world)))};
        }
        Extras extras;
        extras.canonical = context.responses.link(address);
        return grow_plot(plot->content, options_of(request->params), *context.atlas, extras,
                         execution)
            .glb;
    };
    return plan_resource(context, call.request, std::move(resource), call.errors);
}

}  // namespace

template <PlotFile File>
Plan plan_plot(RouteCall& call) {
    return plan_file(call, File);
}

template Plan plan_plot<PlotFile::glb>(RouteCall& call);
template Plan plan_plot<PlotFile::json>(RouteCall& call);

Value plot_query_schema(const Atlas&) { return schema<PlotParams>(); }

Value plot_schema() {
    const Value text = typed("string"), number = typed("number");
    const Value place = list_of(number);
    return objects({{"world", text},
                    {"time", text},
                    {"bbox", list_of(number)},
                    {"soil_water_mm", number},
                    {"trees", list_of(objects({{"id", text},
                                               {"kind", text},
                                               {"place_m", place},
                                               {"age_years", number},
                                               {"height_m", number},
                                               {"diameter_m", number}}))},
                    {"dead_wood", list_of(objects({{"id", text},
                                                   {"kind", text},
                                                   {"stands", typed("boolean")},
                                                   {"place_m", place},
                                                   {"length_m", number},
                                                   {"diameter_m", number},
                                                   {"mass_lost", number}}))},
                    {"fruit_bodies", list_of(objects({{"id", text},
                                                      {"species", text},
                                                      {"place_m", place},
                                                      {"above_ground_m", number},
                                                      {"age", number},
                                                      {"days_old", number},
                                                      {"model", text}}))},
                    {"links", map_of(text)}});
}

}  // namespace sporeprint::api
