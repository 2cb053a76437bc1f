#include "api/products/worlds/plots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "api/http/schemas.h"
#include "api/products/pictures.h"
#include "api/products/resource.h"
#include "api/products/word_list.h"
#include "api/products/worlds/part_request.h"
#include "api/products/worlds/parts.h"
#include "api/products/worlds/placement_rows.h"
#include "api/products/worlds/worlds.h"
#include "core/grow/world/plot_of_world.h"
#include "core/grow/world/plot_places.h"
#include "core/grow/world/plot_scenery.h"
#include "core/grow/world/plot_view.h"
#include "core/params/query.h"
#include "core/params/schema.h"
#include "core/surface/codecs.h"
#include "core/world/season.h"
#include "core/world/tree_growth.h"

namespace sporeprint::api {

namespace {

/// Plots are made of so many images that none of them has an address of its own.
enum class PlotTextures { embedded, none };

constexpr const char* name(PlotTextures textures) {
    switch (textures) {
        case PlotTextures::embedded:
            return "embedded";
        case PlotTextures::none:
            return "none";
    }
    return nullptr;
}

/// The query of a plot.
struct PlotParams {
    double x = 0.0, y = 0.0;
    double size = 10.0;
    int lod = 1;
    double litter = 20.0;
    Text<40> layers;
    LeafInstancing instancing = LeafInstancing::none;
    PlotTextures textures = PlotTextures::embedded;
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
        visit(&P::layers,
              Info{.name = "layers",
                   .most = 40,
                   .doc = "Parts of the plot, joined by +: ground, trees, floor (dead wood, "
                          "leaves, grass), fungi. All without it; what the others are changes "
                          "none of them."});
        visit(&P::instancing,
              Info{.name = "instancing",
                   .doc = "How leaves and fruit bodies are repeated: as meshes and nodes, or by "
                          "EXT_mesh_gpu_instancing."});
        visit(&P::textures, Info{.name = "textures", .doc = "Images inside the file, or none."});
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

/// The query of a picture of a plot.
struct PlotPictureParams {
    double x = 0.0, y = 0.0;
    double size = 10.0;
    int lod = 1;
    double litter = 20.0;
    Text<40> layers;
    Choice<256, 512, 1024, 2048> texture_size{1024};
    int width = 960, height = 640;
    PlotView view = PlotView::standing;
    double turn_deg = 0.0;
    PlotBackground background = PlotBackground::sky;

    static constexpr void fields(auto visit) {
        using P = PlotPictureParams;
        visit(&P::x, info_of<PlotParams>("x"));
        visit(&P::y, info_of<PlotParams>("y"));
        visit(&P::size, info_of<PlotParams>("size"));
        visit(&P::lod, info_of<PlotParams>("lod"));
        visit(&P::litter, info_of<PlotParams>("litter"));
        visit(&P::layers, info_of<PlotParams>("layers"));
        visit(&P::texture_size, info_of<PlotParams>("texture_size"));
        visit(&P::width, Info{.name = "width",
                              .unit = "pixels",
                              .min = 64,
                              .max = 1024,
                              .doc = "Width of the picture."});
        visit(&P::height, Info{.name = "height",
                               .unit = "pixels",
                               .min = 64,
                               .max = 1024,
                               .doc = "Height of the picture."});
        visit(
            &P::view,
            Info{.name = "view",
                 .doc = "As somebody sees it who stands at its edge, or who kneels there or before "
                        "the most fruit bodies that stand together; aslant from above, or from "
                        "straight above it, below the crowns of large trees."});
        visit(&P::turn_deg,
              Info{.name = "turn_deg",
                   .unit = "deg",
                   .min = -180,
                   .max = 180,
                   .doc = "From where the camera looks: 0 from the south, 90 from the east."});
        visit(&P::background,
              Info{.name = "background",
                   .doc = "The sky of the day, for standing and kneeling with the world round the "
                          "plot; or the plot alone before nothing or a colour."});
    }
    bool operator==(const PlotPictureParams&) const = default;

    /// Returns the parameters of the plot that it shows.
    [[nodiscard]] PlotParams plot() const {
        PlotParams params;
        params.x = x;
        params.y = y;
        params.size = size;
        params.lod = lod;
        params.litter = litter;
        params.layers = layers;
        params.texture_size = texture_size;
        return params;
    }
    [[nodiscard]] PictureParams picture() const {
        PictureParams params;
        params.width = width;
        params.height = height;
        params.background = behind();
        return params;
    }
    /// Returns whether the world round the plot is part of the picture.
    [[nodiscard]] bool shows_world() const {
        return background == PlotBackground::sky &&
               (view == PlotView::standing || view == PlotView::kneeling);
    }

  private:
    [[nodiscard]] Background behind() const {
        switch (background) {
            case PlotBackground::white:
                return Background::white;
            case PlotBackground::grey:
                return Background::grey;
            case PlotBackground::black:
                return Background::black;
            case PlotBackground::sky:
            case PlotBackground::transparent:
                break;
        }
        return Background::transparent;
    }
};
static_assert(well_described<PlotPictureParams>());

/// A plot that a URL or a body names.
struct PlotRequest {
    WorldRequest world;
    WorldTimeRead time;
    PlotParams params;
    PlotPictureParams picture;  ///< of a picture
    std::array<bool, plot_layer_count> layers{};

    [[nodiscard]] WorldBox box() const {
        const double half = 0.5 * params.size;
        return {params.x - half, params.y - half, params.x + half, params.y + half};
    }
    /// Returns the canonical query of a file.
    [[nodiscard]] std::string query(Product file) const {
        return file == Product::png ? query_text(picture) : query_text(params);
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

PlotRequest read_plot(const RouteCall& call, Product file, ValidationErrors& errors) {
    PlotRequest request;
    const PartRequest part = read_part(call, errors);
    request.world = part.world;
    request.time = read_world_day(part.time, "a plot is of one day; add it", errors);
    const auto read = [&](auto& params) {
        read_params(part, params, errors);
        without_negative_zero(params);
        request.layers =
            read_words<PlotLayer, plot_layer_count>(params.layers.view(), "layers", errors);
        params.layers = Text<40>(words_text<PlotLayer>(request.layers));
    };
    if (file == Product::png) {
        read(request.picture);
        request.params = request.picture.plot();
    } else {
        read(request.params);
    }
    if (errors.empty()) check_place(request, errors);
    finish_reading(call, errors);
    return request;
}

PlotOptions options_of(const PlotRequest& request, Product file) {
    const PlotParams& params = request.params;
    PlotOptions options;
    options.lod = params.lod;
    options.texture_size = params.texture_size;
    options.litter = params.litter;
    options.layers = request.layers;
    options.for_picture = file == Product::png;
    options.instancing = params.instancing;
    options.textures =
        params.textures == PlotTextures::embedded ? Textures::embedded : Textures::none;
    options.file.compress = params.compress;
    options.file.image_format = params.image_format;
    options.file.materials = params.materials;
    return options;
}

/// Returns the approximate cost of a plot whose world is computed.
Cost cost_of_plot(const PlotRequest& request, Product file) {
    const PlotParams& params = request.params;
    // The blocks round it, their mycelia and their fruit bodies, of which one plot in five finds none computed.
    const std::uint64_t blocks = blocks_of(request.box()).size();
    Cost cost{.base = 40'000 + 20'000 * blocks};
    if (file == Product::json) return cost;
    if (file == Product::png) {
        const bool shows_world = request.picture.shows_world();
        cost += cost_of_drawing(request.picture.picture(),
                                shows_world ? most_scenery_triangles : most_picture_triangles);
        const auto side =
            static_cast<std::uint64_t>(shows_world ? scenery_texels : params.texture_size);
        cost.pixels += 3 * side * side;
    }
    const auto area = static_cast<std::uint64_t>(params.size * params.size);
    cost.placed_vertices = 100'000 + area * 1000;
    cost.bytes = 4'000'000 + area * 20'000;
    if (params.textures == PlotTextures::embedded)
        cost.texels = 3 * static_cast<std::uint64_t>(params.texture_size) *
                      static_cast<std::uint64_t>(params.texture_size);
    return cost;
}

double rounded(double value, double steps) { return std::round(value * steps) / steps + 0.0; }

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
                      .set("length_m", rounded(length_at(wood, time), 100.0))
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
                      .set("model", context.responses.link("/v1/mushrooms/" + species +
                                                           model_of_body(body.seed(), age))));
    }
    return list;
}

std::string path_of(const PlotRequest& request, Product file) {
    return '/' + request.time.text() + "/plot" + ending_of(file);
}

/// Returns the addresses of the files of a plot; none if its world has edits.
Value links_of(const Context& context, const PlotRequest& request, const std::string& world) {
    if (request.world.edits) return Value::object();
    const auto link = [&](Product file) {
        return context.responses.link(with_query(
            folder_of(Worlds::all) + world + path_of(request, file), query_text(request.params)));
    };
    const auto link_of_picture = [&] {
        PlotPictureParams picture;
        picture.x = request.params.x;
        picture.y = request.params.y;
        picture.size = request.params.size;
        return context.responses.link(with_query(
            folder_of(Worlds::all) + world + path_of(request, Product::png), query_text(picture)));
    };
    return Value::object()
        .set("self", link(Product::json))
        .set("model", link(Product::glb))
        .set("picture", link_of_picture());
}

Value describe(const Context& context, const PlotRequest& request, const WorldPlot& plot,
               const std::string& world) {
    const WorldBox box = request.box();
    const WorldTime time = request.time.noon();
    return Value::object()
        .set("world", world)
        .set("time", request.time.text())
        .set("bbox", Value(Value::Array{box.west, box.south, box.east, box.north}))
        .set("axes", axes_of_places)
        .set("soil_water_mm", rounded(plot.content.soil_water, 100.0))
        .set("trees", trees_on(plot, box, time))
        .set("dead_wood", dead_on(plot, box, time))
        .set("fruit_bodies", bodies_on(context, plot, time))
        .set("links", links_of(context, request, world));
}

Body png_of(const RgbaImage& image) {
    return {Slice(std::make_shared<const Bytes>(png(image.rgba, image.width, image.height)))};
}

/// Returns the part of a plot whose shadows are seen from near.
Bounds near_box(double size) {
    const auto half = static_cast<float>(0.6 * size);
    return {{-half, -2.0F, -half}, {half, 2.5F, half}};
}

Plan plan_file(RouteCall& call, Product file) {
    Context& context = call.context;
    const auto request = std::make_shared<const PlotRequest>(read_plot(call, file, call.errors));
    if (!call.errors.empty()) return context.responses.problem(call.request, call.errors);
    Resource resource =
        world_resource(context, request->world, path_of(*request, file), request->query(file));
    resource.type = type_of(file);
    resource.file_name =
        request->world.spec.preset + "_plot_" + request->time.text() + ending_of(file);
    resource.estimate_cost = [cost = cost_of_plot(*request, file)](const Caches&) { return cost; };
    make_of_world(
        resource, request->world.spec.params, context.atlas,
        [&context, request, file, address = resource.address,
         world = world_text(request->world.spec, *context.atlas, resource.version)](
            const SharedWorld& of, const ExecutionContext& execution) -> Body {
            const PlotParams& params = request->params;
            const std::unique_ptr<const WorldPlot> plot = plot_of_world(
                of, {params.x, params.y, params.size}, request->time.noon(), execution);
            if (file == Product::json) {
                execution.observer(Step::pack);
                return Body{slice_of(dump(describe(context, *request, *plot, world)))};
            }
            Extras extras;
            if (!address.empty()) extras.canonical = context.responses.link(address);
            if (file == Product::png) {
                const PlotPictureParams& picture = request->picture;
                const StandingCamera camera =
                    camera_of(plot->content, picture.view, picture.turn_deg);
                if (picture.shows_world())
                    return png_of(scenery_of(*plot, options_of(*request, file), camera,
                                             picture.picture(), *context.atlas, execution));
                extras.write = [&, camera](const GlbScene& scene,
                                           const Parallel& parallel) -> Body {
                    execution.observer(Step::draw);
                    throw_if_cancelled(execution);
                    return png_of(rendered_from(
                        camera, scene, picture.picture(),
                        {daylight_on(*plot->world, plot->content.time), near_box(params.size),
                         picture.background == PlotBackground::sky},
                        parallel));
                };
            }
            return grow_plot(plot->content, options_of(*request, file), *context.atlas, extras,
                             execution)
                .glb;
        },
        request->world.edits);
    return plan_resource(context, call.request, std::move(resource), call.errors);
}

}  // namespace

template <Product File>
Plan plan_plot(RouteCall& call) {
    return plan_file(call, File);
}

template Plan plan_plot<Product::glb>(RouteCall& call);
template Plan plan_plot<Product::json>(RouteCall& call);
template Plan plan_plot<Product::png>(RouteCall& call);

Value plot_query_schema(const Atlas&) { return schema<PlotParams>(); }

Value plot_picture_query_schema(const Atlas&) { return schema<PlotPictureParams>(); }

Value plot_schema() {
    const Value text = typed("string"), number = typed("number");
    const Value place = list_of(number);
    return objects({{"world", text},
                    {"time", text},
                    {"bbox", list_of(number)},
                    {"axes", text},
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
