#include "api/products/worlds/maps.h"

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/http/schemas.h"
#include "api/products/resource.h"
#include "api/products/worlds/part_request.h"
#include "api/products/worlds/parts.h"
#include "api/products/worlds/worlds.h"
#include "core/grow/world/parts.h"
#include "core/grow/world/plot_of_world.h"
#include "core/params/messages.h"
#include "core/params/query.h"
#include "core/params/schema.h"
#include "core/surface/codecs.h"
#include "core/world/fungi_params.h"
#include "core/world/ground.h"
#include "core/world/maps.h"
#include "core/world/weather.h"

namespace sporeprint::api {

namespace {

/// The map whose file has the colours of Terrarium in place of grey; it shows heights.
constexpr const char* terrarium = "terrarium";

/// The day of the year whose trees maps of crowns show: any day between spring and the storms of autumn.
constexpr int midsummer_day = 172;

/// The query of a map.
struct MapParams {
    int size = 512;
    Text<120> bbox;
    Text<48> species;

    static constexpr void fields(auto visit) {
        using M = MapParams;
        visit(&M::size, Info{.name = "size",
                             .min = 64,
                             .max = 2049,
                             .doc = "Numbers along the longer side. The outermost ones are on the "
                                    "edges, so that maps side by side share them."});
        visit(&M::bbox, Info{.name = "bbox",
                             .unit = "m",
                             .most = 120,
                             .doc = "West, south, east and north edge, from the centre of the "
                                    "world: -100,-50,100,50. The whole world without it."});
        visit(&M::species, Info{.name = "species",
                                .most = 48,
                                .doc = "Of the maps of spores and of probability: which of the "
                                       "fungi of the world they show; the first without it."});
    }
    bool operator==(const MapParams&) const = default;
};
static_assert(well_described<MapParams>());

/// A map that a URL or a body names.
struct MapRequest {
    WorldRequest world;
    WorldMap map = WorldMap::height;
    bool is_terrarium = false;
    int year = 0;
    int day = 0;  ///< 0 for maps that do not change from day to day
    WorldBox box;
    int size = 0;
    std::string species;  ///< of maps of one species

    [[nodiscard]] std::string name() const {
        return is_terrarium ? terrarium : sporeprint::name(map);
    }
    [[nodiscard]] bool is_palette() const { return !is_terrarium && map == WorldMap::species; }
    [[nodiscard]] std::string time() const {
        return 'y' + std::to_string(year) + (day == 0 ? "" : 'd' + std::to_string(day));
    }
    [[nodiscard]] MapFrame frame() const { return frame_of(box, size); }
    /// Returns the moment whose trees it shows: noon of its day, or any of the summer.
    [[nodiscard]] WorldTime moment() const {
        return day == 0 ? time_of(year, midsummer_day) : time_of(year, day) + ticks_of_day / 2;
    }
};

/// Nanoseconds of one place of a map: its value, and its part of a PNG file.
struct PlaceCost {
    std::uint64_t value, png;
};

PlaceCost place_cost_of(const MapRequest& request) {
    if (request.is_terrarium) return {8, 23};
    switch (request.map) {
        case WorldMap::height:
            return {8, 14};
        case WorldMap::slope:
        case WorldMap::aspect:
            return {34, 29};
        case WorldMap::twi:
        case WorldMap::wetness:
            return {4, 14};
        case WorldMap::streams:
            return {4, 4};
        case WorldMap::sky:
        case WorldMap::spores:
            return {60, 14};
        case WorldMap::wind:
            return {400, 14};
        case WorldMap::light:
        case WorldMap::canopy:
        case WorldMap::probability:
            return {900, 29};
        case WorldMap::litter:
        case WorldMap::moss:
        case WorldMap::grass:
            return {3000, 29};
        case WorldMap::species:
            return {1800, 6};
    }
    return {};
}

Cost cost_of_map(const MapRequest& request, MapFile file) {
    if (file == MapFile::json) return {.base = 100};
    const MapFrame frame = request.frame();
    const auto places =
        static_cast<std::uint64_t>(frame.width) * static_cast<std::uint64_t>(frame.height);
    const PlaceCost cost = place_cost_of(request);
    const std::uint64_t nanoseconds = cost.value + (file == MapFile::png ? cost.png : 1);
    const double rim = block_side;
    const std::uint64_t blocks = has_crowns(request.map)
                                     ? blocks_of({request.box.west - rim, request.box.south - rim,
                                                  request.box.east + rim, request.box.north + rim})
                                           .size()
                                     : 0;
    return {.base = 200 + places * nanoseconds / 1000 + 20'000 * blocks};
}

void read_map_name(std::string_view text, MapRequest& request, ValidationErrors& errors) {
    request.is_terrarium = text == terrarium;
    if (request.is_terrarium) return;
    for (int i = 0; const char* one = name(static_cast<WorldMap>(i)); ++i)
        if (text == one) {
            request.map = static_cast<WorldMap>(i);
            return;
        }
    std::vector<std::string> names;
    const Value known = map_names(MapFile::png);
    for (const Value& one : known.items()) names.push_back(one.as_string());
    std::string list;
    for (const std::string& one : names) (list += list.empty() ? "" : ", ") += one;
    const std::string_view meant = closest(text, names);
    errors.add(
        404, "map",
        "there is no map " + in_quotes(text) +
            (meant.empty() ? "; there are " + list : "; did you mean " + in_quotes(meant) + '?'));
}

/// Reads the {time} of a URL into the year and the day of a request.
void read_time(std::string_view text, MapRequest& request, ValidationErrors& errors) {
    const WorldTimeRead time = read_world_time(text, errors);
    if (has_years(request.map)) request.year = time.year;
    if (!has_days(request.map)) return;
    if (time.is_valid && time.day == 0)
        errors.add(400, "time",
                   std::string(name(request.map)) + " changes from day to day; add one, such as " +
                       std::string(text) + "d270");
    request.day = time.day;
}

/// Reads which species a map shows.
std::string read_species(const MapRequest& request, std::string_view text,
                         ValidationErrors& errors) {
    if (request.is_terrarium || !has_species(request.map)) {
        if (!text.empty())
            errors.add(422, "species",
                       "is for the map of spores and that of probability; this is the map of " +
                           request.name());
        return {};
    }
    std::vector<Problem> problems;
    const std::vector<std::string> known =
        species_in(request.world.spec.params.fungi.species, "species", problems);
    if (text.empty() && !known.empty()) return known.front();
    if (std::find(known.begin(), known.end(), text) != known.end()) return std::string(text);
    errors.add(422, "species",
               known.empty() ? "no fungus lives in this world" : not_of_world(text, known));
    return {};
}

MapRequest read_map(const RouteCall& call, ValidationErrors& errors) {
    MapRequest request;
    // The last {name} of a path with others and without; it is no member of a body.
    ValidationErrors of_path;
    read_map_name(call.captured.back(), request, of_path);
    const PartRequest part = read_part(call, errors);
    request.world = part.world;
    read_time(part.time, request, errors);
    MapParams params;
    read_params(part, params, errors);
    const WorldBox extent = extent_of(request.world.spec.params);
    request.box = read_box(params.bbox, extent, extent, errors);
    request.size = params.size;
    request.species = read_species(request, params.species, errors);
    finish_reading(call, errors);
    for (const Problem& problem : of_path.problems())
        errors.add(404, problem.path, problem.message);
    return request;
}

/// Returns the canonical query.
std::string query_of(const MapRequest& request) {
    MapParams params{request.size, {}, {}};
    params.species = Text<48>(request.species);
    if (request.box != extent_of(request.world.spec.params))
        params.bbox = Text<120>(text_of(request.box));
    return query_text(params);
}

double soil_water_on(const MapRequest& request) {
    if (request.day == 0) return 0.0;
    const WorldParams& params = request.world.spec.params;
    return weather_of(params.climate, params.seed,
                      request.year)[static_cast<std::size_t>(request.day - 1)]
        .soil_water;
}

/// Returns how the value of a place follows from its number or its colour.
const char* formula_of(const MapRequest& request) {
    if (request.is_palette()) return "0 for none, otherwise the number of a species";
    return request.is_terrarium ? "256 R + G + B / 256 - 32768"
                                : "from + (to - from) * number / 65535";
}

/// Returns the ids of the species of a world in their order.
std::vector<std::string> species_of(const MapRequest& request) {
    std::vector<Problem> ignored;
    return species_in(request.world.spec.params.fungi.species, "species", ignored);
}

/// What the numbers of a map mean, beside it in a PNG file.
ImageTexts texts_of(const MapRequest& request, const MapRange& range, const std::string& world) {
    ImageTexts texts = {{"Title", request.name()},
                        {"Source", world},
                        {"Software", "Sporeprint"},
                        {"Bounding box", text_of(request.box)},
                        {"Formula", formula_of(request)}};
    if (request.is_palette()) {
        const std::vector<std::string> ids = species_of(request);
        for (std::size_t i = 0; i < ids.size(); ++i)
            texts.emplace_back("Species " + std::to_string(i + 1), ids[i]);
        return texts;
    }
    if (request.is_terrarium) {
        texts.emplace_back("Unit", "m");
        return texts;
    }
    texts.emplace_back("From", number_text(range.from));
    texts.emplace_back("To", number_text(range.to));
    if (*range.unit) texts.emplace_back("Unit", range.unit);
    return texts;
}

/// The parts of a world that its maps are computed from.
struct MapSource {
    SharedGround ground;
    SharedWorld world;  ///< of maps that need one
};

/// Returns the numbers of a map.
std::vector<std::uint16_t> numbers_of(const MapRequest& request, const MapSource& source,
                                      const Atlas& atlas, const ExecutionContext& execution) {
    MapInputs inputs{.ground = *source.ground,
                     .soil_water = soil_water_on(request),
                     .world = source.world.get(),
                     .year = request.year,
                     .day = std::max(request.day, 1),
                     .climate = request.world.spec.params.climate};
    if (has_species(request.map)) {
        const std::vector<std::string>& ids = source.world->species_ids;
        inputs.species = static_cast<std::size_t>(
            std::find(ids.begin(), ids.end(), request.species) - ids.begin());
    }
    inputs.crowns = [&](CellIndex block) {
        throw_if_cancelled(execution);
        const WorldBox box = box_of(block);
        const double reach = shade_reach + 1.0;
        return crowns_in(*source.world, trees_round(*source.world, box, execution),
                         {box.west - reach, box.south - reach, box.east + reach, box.north + reach},
                         request.moment());
    };
    if (is_of_cover(request.map)) inputs.has_needles = needles_of(*source.world, atlas);
    inputs.litter = [&](CellIndex block) {
        const WorldBox box = box_of(block);
        const double reach = most_litter_reach;
        return litter_in(trees_round(*source.world, box, execution),
                         {box.west - reach, box.south - reach, box.east + reach, box.north + reach},
                         request.moment());
    };
    return map_of(request.map, inputs, request.frame(), execution.parallel);
}

Bytes png_of(const MapRequest& request, const MapSource& source, const std::string& world,
             const Atlas& atlas, const ExecutionContext& execution) {
    const Ground& ground = *source.ground;
    const MapFrame frame = request.frame();
    const ImageTexts texts = texts_of(request, range_of(request.map, ground), world);
    if (request.is_terrarium) {
        const std::vector<std::uint8_t> rgb = terrarium_of(ground, frame, execution.parallel);
        execution.observer(Step::pack);
        return png_of_numbers(rgb, frame.width, frame.height, texts);
    }
    const std::vector<std::uint16_t> numbers = numbers_of(request, source, atlas, execution);
    execution.observer(Step::pack);
    if (request.is_palette()) {
        const std::vector<std::uint8_t> small(numbers.begin(), numbers.end());
        return png_of_palette(small, frame.width, frame.height, colours_of_species, texts);
    }
    return png_of_numbers(numbers, frame.width, frame.height, texts);
}

Bytes r16_of(const MapRequest& request, const MapSource& source, const Atlas& atlas,
             const ExecutionContext& execution) {
    const std::vector<std::uint16_t> numbers = numbers_of(request, source, atlas, execution);
    execution.observer(Step::pack);
    Bytes out;
    out.reserve(2 * numbers.size());
    for (const std::uint16_t number : numbers) {
        out.push_back(static_cast<std::uint8_t>(number & 255U));
        out.push_back(static_cast<std::uint8_t>(number >> 8U));
    }
    return out;
}

const char* ending_of(MapFile file) {
    switch (file) {
        case MapFile::png:
            return ".png";
        case MapFile::r16:
            return ".r16";
        case MapFile::json:
            return ".json";
    }
    return "";
}

const char* type_of(MapFile file) {
    switch (file) {
        case MapFile::png:
            return "image/png";
        case MapFile::r16:
            return "application/octet-stream";
        case MapFile::json:
            return "application/json";
    }
    return "";
}

std::string path_of(const MapRequest& request, const std::string& ending) {
    return '/' + request.time() + "/maps/" + request.name() + ending;
}

/// Returns the numbers of the map of species, with their species and their colours.
Value palette_of(const MapRequest& request) {
    std::vector<std::string> ids = species_of(request);
    ids.insert(ids.begin(), "");
    Value list = Value::array();
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const auto& [r, g, b] = colours_of_species[i];
        list.push(Value::object()
                      .set("number", i)
                      .set("species", ids[i])
                      .set("colour", colour_text({r, g, b})));
    }
    return list;
}

Value describe(const Context& context, const MapRequest& request, const Ground& ground,
               const std::string& world) {
    const MapFrame frame = request.frame();
    const MapRange range = range_of(request.map, ground);
    const auto link = [&](MapFile file) {
        return context.responses.link(with_query(
            folder_of(Worlds::all) + world + path_of(request, ending_of(file)), query_of(request)));
    };
    Value links = Value::object();
    if (!request.world.edits) {
        links.set("self", link(MapFile::json)).set("png", link(MapFile::png));
        if (!request.is_terrarium) links.set("r16", link(MapFile::r16));
    }
    const WorldBox& box = request.box;
    Value body = Value::object();
    if (request.is_palette()) body.set("palette", palette_of(request));
    return body.set("world", world)
        .set("time", request.time())
        .set("map", request.name())
        .set("description", doc_of(request.map))
        .set("unit", range.unit)
        .set("formula", formula_of(request))
        .set("from", range.from)
        .set("to", range.to)
        .set("rows", "from north to south, each from west to east")
        .set("width", frame.width)
        .set("height", frame.height)
        .set("bbox", Value(Value::Array{box.west, box.south, box.east, box.north}))
        .set("step_m", Value(Value::Array{(box.east - box.west) / (frame.width - 1),
                                          (box.north - box.south) / (frame.height - 1)}))
        .set("ground_step_m", world_grid(request.world.spec.params.extent).cell)
        .set("links", std::move(links));
}

/// Returns the bytes of a file of a map.
Slice slice_of_map(MapFile file, const Context& context, const MapRequest& request,
                   const MapSource& source, const std::string& world,
                   const ExecutionContext& execution) {
    const auto shared = [](Bytes bytes) {
        return Slice(std::make_shared<const Bytes>(std::move(bytes)));
    };
    switch (file) {
        case MapFile::png:
            return shared(png_of(request, source, world, *context.atlas, execution));
        case MapFile::r16:
            return shared(r16_of(request, source, *context.atlas, execution));
        case MapFile::json:
            break;
    }
    return slice_of(dump(describe(context, request, *source.ground, world)));
}

Plan plan_file(RouteCall& call, MapFile file) {
    Context& context = call.context;
    const auto request = std::make_shared<const MapRequest>(read_map(call, call.errors));
    if (file == MapFile::r16 && request->is_terrarium)
        call.errors.add(404, "map",
                        "terrarium is in colours, which .r16 has not; height is "
                        "there as .r16");
    if (!call.errors.empty()) return context.responses.problem(call.request, call.errors);
    Resource resource = world_resource(context, request->world, path_of(*request, ending_of(file)),
                                       query_of(*request));
    resource.type = type_of(file);
    resource.file_name = request->world.spec.preset + '_' + request->name() +
                         (request->species.empty() ? "" : '_' + request->species) +
                         (has_years(request->map) ? '_' + request->time() : "") + ending_of(file);
    resource.estimate_cost = [cost = cost_of_map(*request, file)](const Caches&) { return cost; };
    // The range of heights alone depends on the ground.
    const bool needs_ground = file != MapFile::json || request->map == WorldMap::height;
    const bool with_world = file != MapFile::json && needs_world(request->map);
    if (with_world)
        resource.prerequisite = [request, atlas = context.atlas](Store& store) {
            return world_job(store, request->world.spec.params, atlas, request->world.edits);
        };
    else if (needs_ground)
        resource.prerequisite = [request](Store& store) {
            return ground_job(store, request->world.spec.params);
        };
    resource.make = [&context, request, needs_ground, with_world, file,
                     world = world_text(request->world.spec, *context.atlas, resource.version)](
                        JobContext& job) {
        const ExecutionContext& execution = job.execution();
        execution.observer(Step::resolve);
        const WorldParams& params = request->world.spec.params;
        MapSource source;
        if (with_world) {
            source.world =
                world_of_request(params, *context.atlas, execution, request->world.edits);
            source.ground = source.world->ground;
        } else {
            source.ground = needs_ground ? ground_of_world(params, execution.caches)
                                         : std::make_shared<const Ground>();
        }
        execution.observer(Step::build);
        return Body{slice_of_map(file, context, *request, source, world, execution)};
    };
    return plan_resource(context, call.request, std::move(resource), call.errors);
}

}  // namespace

template <MapFile File>
Plan plan_map(RouteCall& call) {
    return plan_file(call, File);
}

template Plan plan_map<MapFile::png>(RouteCall& call);
template Plan plan_map<MapFile::r16>(RouteCall& call);
template Plan plan_map<MapFile::json>(RouteCall& call);

Value map_query_schema(const Atlas&) { return schema<MapParams>(); }

Value map_names(MapFile file) {
    Value names = Value::array();
    for (int i = 0; const char* one = name(static_cast<WorldMap>(i)); ++i) names.push(one);
    if (file != MapFile::r16) names.push(terrarium);
    return names;
}

Value map_schema() {
    const Value text = typed("string"), number = typed("number"), whole = typed("integer");
    Value map = objects({{"world", text},
                         {"time", text},
                         {"map", text},
                         {"description", text},
                         {"unit", text},
                         {"formula", text},
                         {"from", number},
                         {"to", number},
                         {"rows", text},
                         {"width", whole},
                         {"height", whole},
                         {"bbox", list_of(number)},
                         {"step_m", list_of(number)},
                         {"ground_step_m", number},
                         {"links", map_of(text)}});
    map.find("properties")
        ->set("palette",
              list_of(objects({{"number", whole}, {"species", text}, {"colour", text}})));
    return map;
}

Value map_list(const ResponseBuilder& responses, const std::string& world) {
    Value maps = Value::object();
    const auto add = [&](const char* map, const char* time) {
        maps.set(map, responses.link(world + time + "/maps/" + map + ".json"));
    };
    for (int i = 0; const char* map = name(static_cast<WorldMap>(i)); ++i) {
        const auto kind = static_cast<WorldMap>(i);
        add(map, has_days(kind) ? "/y80d270" : has_years(kind) ? "/y80" : "/y0");
    }
    add(terrarium, "/y0");
    return maps;
}

}  // namespace sporeprint::api
