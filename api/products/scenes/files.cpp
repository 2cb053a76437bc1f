#include "api/products/scenes/files.h"

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/http/schemas.h"
#include "api/products/mix.h"
#include "api/products/presets.h"
#include "api/products/resource.h"
#include "api/products/scenes/uploads.h"
#include "api/products/worlds/parts.h"
#include "api/products/worlds/placement_rows.h"
#include "api/products/worlds/worlds.h"
#include "core/grow/scene/scene_fungi_file.h"
#include "core/grow/scene/scene_maps.h"
#include "core/grow/scene/scene_parts.h"
#include "core/grow/scene/scene_placements.h"
#include "core/params/canonical.h"
#include "core/params/messages.h"
#include "core/params/query.h"
#include "core/params/schema.h"

namespace sporeprint::api {

namespace {

/// The query of the GLB file.
struct SceneFungiParams {
    Text<1000> substrates;
    double decay = 0.3;
    int lod = 1;
    LeafInstancing instancing = LeafInstancing::none;
    Textures textures = Textures::embedded;
    Compression compress = Compression::none;
    ImageFormats image_format = ImageFormats::jpg;
    MaterialSet materials = MaterialSet::full;

    static constexpr void fields(auto visit) {
        using P = SceneFungiParams;
        visit(&P::substrates, info_of<SceneParams>("substrates"));
        visit(&P::decay, info_of<SceneParams>("decay"));
        visit(&P::lod, Info{.name = "lod",
                            .min = 0,
                            .max = 2,
                            .doc = "Level of detail of the fruit bodies. Where there are too many "
                                   "of them, they have fewer triangles."});
        visit(&P::instancing,
              Info{.name = "instancing",
                   .doc = "How fruit bodies that look alike are repeated: as nodes, or by "
                          "EXT_mesh_gpu_instancing."});
        visit(&P::textures, info_of<LeafParams>("textures"));
        visit(&P::compress, info_of<FileOptions>("compress"));
        visit(&P::image_format, info_of<FileOptions>("image_format"));
        visit(&P::materials, info_of<FileOptions>("materials"));
    }
    bool operator==(const SceneFungiParams&) const = default;
};
static_assert(well_described<SceneFungiParams>());

/// The query of placements.
struct ScenePlacementParams {
    Text<1000> substrates;
    double decay = 0.3;
    Text<620> species;

    static constexpr void fields(auto visit) {
        using P = ScenePlacementParams;
        visit(&P::substrates, info_of<SceneParams>("substrates"));
        visit(&P::decay, info_of<SceneParams>("decay"));
        visit(&P::species, Info{.name = "species",
                                .most = 620,
                                .doc = "Which fungi of the world to list, joined by +: "
                                       "boletus_edulis+russula_emetica. All without it."});
    }
    bool operator==(const ScenePlacementParams&) const = default;
};
static_assert(well_described<ScenePlacementParams>());

/// For which points a map has numbers.
enum class MapPoints { vertices, surfels };

constexpr const char* name(MapPoints points) {
    switch (points) {
        case MapPoints::vertices:
            return "vertices";
        case MapPoints::surfels:
            return "surfels";
    }
    return nullptr;
}

/// The query of a map.
struct SceneMapParams {
    Text<1000> substrates;
    double decay = 0.3;
    MapPoints points = MapPoints::vertices;

    static constexpr void fields(auto visit) {
        using P = SceneMapParams;
        visit(&P::substrates, info_of<SceneParams>("substrates"));
        visit(&P::decay, info_of<SceneParams>("decay"));
        visit(&P::points,
              Info{.name = "points",
                   .doc = "Numbers of the vertices of the scene, one float each, in the order of "
                          "its nodes, their primitives and these's vertices; or of surfels, which "
                          "lie evenly on its surface: x, y, z and the number as four floats."});
    }
    bool operator==(const SceneMapParams&) const = default;
};
static_assert(well_described<SceneMapParams>());

/// What all files about a scene name.
struct SceneRequest {
    SceneSpec spec;
    WorldRequest world;
    WorldTimeRead time;

    [[nodiscard]] std::string ending(const std::string& file) const {
        return '/' + time.text() + '/' + file;
    }
};

/// Reads the scene, the world and the time of a path, and the query.
template <class Params>
SceneRequest read_scene(const RouteCall& call, Params& params, ValidationErrors& errors) {
    const Atlas& atlas = *call.context.atlas;
    SceneRequest request;
    check_scene(call.captured[0], call.context, errors);
    request.world = read_world(call.captured[1], atlas, errors);
    request.time =
        read_world_day(call.captured[2], "what grows on a scene is of one day; add it", errors);
    std::vector<Problem> problems;
    read_query(query_of_world(call.target, errors), params, problems);
    const std::vector<std::string> kinds = tree_kinds(atlas);
    if (problems.empty())
        static_cast<void>(soils_in(params.substrates.view(), kinds, "substrates", problems));
    errors.add(400, problems);
    without_negative_zero(params);
    // Terrain, stand and extent are those of the scene; its text names none.
    WorldParams& world = request.world.spec.params;
    const WorldParams own = own_params<Worlds>(atlas, request.world.spec.preset);
    world.terrain = own.terrain;
    world.stand = own.stand;
    world.extent = own.extent;
    request.spec = {call.captured[0], world, {params.substrates, params.decay}};
    return request;
}

/// Returns the approximate cost of the fungi of a scene, whose size is not known before it is read: that of a large one,
/// half of the most that is possible.
Cost cost_of_fungi(Store& store, const SceneSpec& spec) {
    constexpr std::uint64_t of_shape = 5'000'000, of_climate = 1'500'000, of_species = 200'000;
    Cost cost{.base = of_climate + of_species * species_of(spec).size()};
    if (!store.scene_parts.cache().find(shape_key(spec.id))) cost.base += of_shape;
    return cost;
}

/// Returns the job that computes the fungi of a scene, if they are not cached.
std::optional<Job> fungi_job(Store& store, const SceneSpec& spec,
                             const std::shared_ptr<const Atlas>& atlas) {
    const std::string key = fungi_key(spec);
    if (store.scene_parts.cache().find(key)) return std::nullopt;
    auto run = [&store, spec, atlas](const std::stop_token& stop, const Observer& observer,
                                     const Parallel& parallel) {
        observer(Step::resolve);
        JobContext job(store, stop, observer, parallel);
        static_cast<void>(
            fungi_of_scene(spec, *atlas, scene_caches(store, job.execution()), job.execution()));
        return Response();
    };
    return Job{key, cost_of_fungi(store, spec), std::move(run), true};
}

using MakeOfFungi = std::function<Body(const SceneFungi&, const ExecutionContext&)>;

/// Plans a file about a scene.
///
/// file  its name
/// cost  without the fungi
Plan plan_of_scene(RouteCall& call, const SceneRequest& request, const std::string& file,
                   const std::string& query, const std::string& type, const Cost& cost,
                   const MakeOfFungi& make) {
    Context& context = call.context;
    if (!call.errors.empty()) return context.responses.problem(call.request, call.errors);
    Resource resource = world_resource(context, request.world, request.ending(file), query);
    resource.address = path_of_scene(request.spec.id) + '/' +
                       resource.address.substr(folder_of(Worlds::all).size());
    resource.key = "scene " + request.spec.id + ' ' + resource.key;
    resource.type = type;
    std::string name = request.spec.id + '_' + request.time.text() + '_' + file;
    std::ranges::replace(name, '/', '_');
    std::ranges::replace(name, ':', '_');
    resource.file_name = std::move(name);
    resource.estimate_cost = [cost](const Caches&) { return cost; };
    resource.prerequisite = [spec = request.spec, atlas = context.atlas](Store& store) {
        return fungi_job(store, spec, atlas);
    };
    resource.make = [&context, spec = request.spec, atlas = context.atlas, make](JobContext& job) {
        const ExecutionContext& execution = job.execution();
        execution.observer(Step::resolve);
        const std::shared_ptr<const SceneFungi> fungi =
            fungi_of_scene(spec, *atlas, scene_caches(context.store, execution), execution);
        execution.observer(Step::build);
        return make(*fungi, execution);
    };
    return plan_resource(context, call.request, std::move(resource), call.errors);
}

/// Returns the canonical text of the world of a request, as its links have it.
std::string text_of_world(const SceneRequest& request, const Context& context) {
    return world_text(request.world.spec, *context.atlas,
                      preset_token<Worlds>(*context.atlas, request.world.spec.preset));
}

std::string link_to(const SceneRequest& request, const Context& context, const std::string& file,
                    const std::string& query) {
    return context.responses.link(with_query(path_of_scene(request.spec.id) + '/' +
                                                 text_of_world(request, context) +
                                                 request.ending(file),
                                             query));
}

constexpr const char* axes = "those of the scene: y up, metres; x counts as east and z as south";

// --- Placements -------------------------------------------------------------------------

PlacementNames names_of(const Context& context, const SceneFungi& fungi, const SceneSpec& spec) {
    PlacementNames names;
    names.kinds = {name(Soil::wood)};
    names.species = species_of(spec);
    for (const FungusSpecies& species : fungi.species)
        names.substrates.emplace_back(ground_of_guild(species.ecology.guild));
    names.folder = context.responses.link("/v1/mushrooms/");
    return names;
}

/// Returns which species of a scene are listed; nothing for all.
std::vector<bool> chosen_species(std::string_view text, const SceneSpec& spec,
                                 ValidationErrors& errors) {
    std::vector<Problem> problems;
    const std::vector<std::string> wanted = species_in(text, "species", problems),
                                   known = species_of(spec);
    errors.add(400, problems);
    for (const std::string& id : wanted)
        if (std::ranges::find(known, id) == known.end())
            errors.add(422, "species", not_of_world(id, known));
    std::vector<bool> chosen;
    if (wanted.empty()) return chosen;
    for (const std::string& id : known)
        chosen.push_back(std::ranges::find(wanted, id) != wanted.end());
    return chosen;
}

Plan plan_placement_file(RouteCall& call, PlacementFile file) {
    Context& context = call.context;
    ScenePlacementParams params;
    const auto request =
        std::make_shared<const SceneRequest>(read_scene(call, params, call.errors));
    params.species = Text<620>(canonical_species(params.species.view()));
    const std::vector<bool> chosen =
        chosen_species(params.species.view(), request->spec, call.errors);
    const std::string query = query_text(params);
    return plan_of_scene(
        call, *request, std::string("placements") + ending_of(file), query, type_of(file),
        {.base = 300'000},
        [&context, request, chosen, file, query, atlas = context.atlas](
            const SceneFungi& fungi, const ExecutionContext& execution) {
            const SceneSpec& spec = request->spec;
            const std::vector<SceneBody> bodies = scene_bodies(fungi, request->time.year);
            std::vector<Placement> rows;
            for (ScenePlacement& one :
                 placements_on(fungi, bodies, request->time.noon(),
                               lateral_species(species_of(spec), *atlas), chosen))
                rows.push_back(one.row);
            execution.observer(Step::pack);
            const PlacementNames names = names_of(context, fungi, spec);
            switch (file) {
                case PlacementFile::csv:
                    return Body{slice_of(csv_of(rows, names))};
                case PlacementFile::bin:
                    return Body{slice_of(bin_of(rows, names))};
                case PlacementFile::json:
                    break;
            }
            Value head =
                Value::object()
                    .set("scene", spec.id)
                    .set("world", text_of_world(*request, context))
                    .set("time", request->time.text())
                    .set("axes", axes)
                    .set("links",
                         Value::object()
                             .set("self", link_to(*request, context, "placements.json", query))
                             .set("csv", link_to(*request, context, "placements.csv", query))
                             .set("bin", link_to(*request, context, "placements.bin", query)));
            return Body{slice_of(json_of(rows, names, std::move(head)))};
        });
}

// --- Maps -------------------------------------------------------------------------------

/// Reads the name of a map: light, or probability:boletus_edulis.
std::optional<SceneMapChoice> read_map(const std::string& text, const SceneRequest& request,
                                       ValidationErrors& errors) {
    const std::string_view of_map = std::string_view(text).substr(0, text.find(':'));
    std::vector<std::string> known;
    SceneMapChoice choice;
    choice.year = request.time.year;
    choice.day = std::max(1, request.time.day);
    for (std::size_t i = 0; i < scene_map_count; ++i) {
        const auto map = static_cast<SceneMap>(i);
        known.emplace_back(is_of_species(map) ? std::string(name(map)) + ":{species}" : name(map));
        if (of_map != name(map)) continue;
        choice.map = map;
        const bool has_species = of_map.size() < text.size();
        if (has_species != is_of_species(map)) break;
        if (!has_species) return choice;
        const std::vector<std::string> species = species_of(request.spec);
        const std::string id = text.substr(of_map.size() + 1);
        const auto found = std::ranges::find(species, id);
        if (found == species.end()) {
            errors.add(404, "map", not_of_world(id, species));
            return std::nullopt;
        }
        choice.species = static_cast<std::size_t>(found - species.begin());
        return choice;
    }
    std::string list;
    for (std::size_t i = 0; i < scene_map_count; ++i) {
        const auto map = static_cast<SceneMap>(i);
        (list += list.empty() ? "" : ", ") += name(map);
        if (is_of_species(map)) list += ":{species}";
    }
    errors.add(404, "map", "there is no map " + in_quotes(text) + "; there are " + list);
    return std::nullopt;
}

/// Appends floats, low byte first.
void append(Bytes& to, float number) {
    const auto bits = std::bit_cast<std::uint32_t>(number + 0.0F);
    for (int shift = 0; shift < 32; shift += 8)
        to.push_back(static_cast<std::uint8_t>(bits >> shift));
}

Body numbers_of(const SceneShape& shape, const std::vector<float>& values, MapPoints points) {
    Bytes bytes;
    if (points == MapPoints::vertices) {
        const std::vector<float> numbers = on_vertices(shape, values);
        bytes.reserve(4 * numbers.size());
        for (const float number : numbers) append(bytes, number);
    } else {
        bytes.reserve(16 * values.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            for (int axis = 0; axis < 3; ++axis) append(bytes, shape.surfels[i].at[axis]);
            append(bytes, values[i]);
        }
    }
    return Body{Slice(std::make_shared<const Bytes>(std::move(bytes)))};
}

double rounded(double value) { return std::round(value * 1e4) / 1e4 + 0.0; }

Plan plan_map_file(RouteCall& call, SceneMapFile file) {
    Context& context = call.context;
    SceneMapParams params;
    const auto request =
        std::make_shared<const SceneRequest>(read_scene(call, params, call.errors));
    const std::string map = call.captured[3];
    const std::optional<SceneMapChoice> choice = read_map(map, *request, call.errors);
    const std::string query = query_text(params);
    const bool is_bin = file == SceneMapFile::bin;
    const std::string folder = "maps/" + map;
    return plan_of_scene(
        call, *request, folder + (is_bin ? ".bin" : ".json"), query,
        is_bin ? "application/octet-stream" : "application/json", {.base = 400'000},
        [&context, request, params, query, folder, map, is_bin,
         choice = choice.value_or(SceneMapChoice{})](const SceneFungi& fungi,
                                                     const ExecutionContext& execution) {
            const SceneShape& shape = *fungi.habitat->shape;
            const std::vector<float> values = scene_map(fungi, choice, execution.parallel);
            execution.observer(Step::pack);
            if (is_bin) return numbers_of(shape, values, params.points);
            double sum = 0.0, area = 0.0;
            float least = values.empty() ? 0.0F : values[0], most = least;
            for (std::size_t i = 0; i < values.size(); ++i) {
                least = std::min(least, values[i]);
                most = std::max(most, values[i]);
                const auto own = static_cast<double>(shape.surfels[i].area);
                sum += own * static_cast<double>(values[i]);
                area += own;
            }
            const bool is_vertices = params.points == MapPoints::vertices;
            return Body{slice_of(dump(
                Value::object()
                    .set("scene", request->spec.id)
                    .set("world", text_of_world(*request, context))
                    .set("time", request->time.text())
                    .set("map", map)
                    .set("points", name(params.points))
                    .set("count", is_vertices ? shape.scene->positions.size() : values.size())
                    .set("bytes_of_point", is_vertices ? 4 : 16)
                    .set("least", rounded(static_cast<double>(least)))
                    .set("most", rounded(static_cast<double>(most)))
                    .set("mean", rounded(area > 0.0 ? sum / area : 0.0))
                    .set("surfels", values.size())
                    .set("spacing_m", rounded(shape.surfels.spacing()))
                    .set("axes", axes)
                    .set("links",
                         Value::object()
                             .set("self", link_to(*request, context, folder + ".json", query))
                             .set("bin", link_to(*request, context, folder + ".bin", query)))))};
        });
}

}  // namespace

Plan plan_scene_fungi(RouteCall& call) {
    Context& context = call.context;
    SceneFungiParams params;
    const auto request =
        std::make_shared<const SceneRequest>(read_scene(call, params, call.errors));
    Cost cost{.base = 300'000};
    cost.placed_vertices = 300'000;
    cost.bytes = 12'000'000;
    if (params.textures == Textures::embedded) {
        constexpr std::uint64_t images = 16, side = 256;
        cost.atlases = images;
        cost.texels = 3 * images * side * side;
    }
    const std::string query = query_text(params);
    return plan_of_scene(
        call, *request, "fungi.glb", query, "model/gltf-binary", cost,
        [&context, request, params, query, atlas = context.atlas](
            const SceneFungi& fungi, const ExecutionContext& execution) {
            SceneFungiOptions options;
            options.lod = params.lod;
            options.instancing = params.instancing;
            options.textures = params.textures;
            options.file.compress = params.compress;
            options.file.image_format = params.image_format;
            options.file.materials = params.materials;
            Extras extras;
            extras.canonical = link_to(*request, context, "fungi.glb", query);
            return grow_scene_fungi(scene_bodies(fungi, request->time.year), request->time.noon(),
                                    species_of(request->spec), options, *atlas, extras, execution)
                .glb;
        });
}

template <PlacementFile File>
Plan plan_scene_placements(RouteCall& call) {
    return plan_placement_file(call, File);
}

template Plan plan_scene_placements<PlacementFile::csv>(RouteCall& call);
template Plan plan_scene_placements<PlacementFile::json>(RouteCall& call);
template Plan plan_scene_placements<PlacementFile::bin>(RouteCall& call);

template <SceneMapFile File>
Plan plan_scene_map(RouteCall& call) {
    return plan_map_file(call, File);
}

template Plan plan_scene_map<SceneMapFile::bin>(RouteCall& call);
template Plan plan_scene_map<SceneMapFile::json>(RouteCall& call);

Value scene_fungi_query_schema(const Atlas&) { return schema<SceneFungiParams>(); }
Value scene_placement_query_schema(const Atlas&) { return schema<ScenePlacementParams>(); }
Value scene_map_query_schema(const Atlas&) { return schema<SceneMapParams>(); }

Value scene_placement_schema() {
    Value all = placement_schema();
    Value& members = *all.find("properties");
    members.erase("bbox");
    members.set("scene", typed("string"));
    Value required = Value::array();
    for (const char* name : {"scene", "world", "time", "axes", "count", "placements", "links"})
        required.push(name);
    return all.set("required", std::move(required));
}

Value scene_map_schema() {
    const Value text = typed("string"), number = typed("number"), whole = typed("integer");
    return objects({{"scene", text},
                    {"world", text},
                    {"time", text},
                    {"map", text},
                    {"points", text},
                    {"count", whole},
                    {"bytes_of_point", whole},
                    {"least", number},
                    {"most", number},
                    {"mean", number},
                    {"surfels", whole},
                    {"spacing_m", number},
                    {"axes", text},
                    {"links", map_of(text)}});
}

}  // namespace sporeprint::api
