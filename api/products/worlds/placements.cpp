#include "api/products/worlds/placements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/http/schemas.h"
#include "api/products/mix.h"
#include "api/products/presets.h"
#include "api/products/resource.h"
#include "api/products/trees.h"
#include "api/products/word_list.h"
#include "api/products/worlds/part_request.h"
#include "api/products/worlds/parts.h"
#include "api/products/worlds/placement_rows.h"
#include "api/products/worlds/worlds.h"
#include "core/grow/world/placements.h"
#include "core/grow/world/plot_parts.h"
#include "core/params/messages.h"
#include "core/params/query.h"
#include "core/params/schema.h"

namespace sporeprint::api {

namespace {

/// Greatest areas, with fungi and without, m²; the rectangle without bbox, metres; and the largest number of rows.
constexpr double most_area_of_fungi = 250'000.0, most_area = 1'000'000.0;
constexpr WorldBox usual_box{-32.0, -32.0, 32.0, 32.0};
constexpr std::size_t most_rows = 200'000;

/// The query of placements.
struct PlacementParams {
    Text<120> bbox;
    Text<40> kinds;
    Text<620> species;

    static constexpr void fields(auto visit) {
        using P = PlacementParams;
        visit(&P::bbox, Info{.name = "bbox",
                             .unit = "m",
                             .most = 120,
                             .doc = "West, south, east and north edge, from the centre of the "
                                    "world; at most 1,000,000 m², with fungi 250,000 m². Without "
                                    "it -32,-32,32,32."});
        visit(&P::kinds, Info{.name = "kinds",
                              .most = 40,
                              .doc = "What to list, joined by +: tree, snag, log, fungus. All "
                                     "without it."});
        visit(&P::species, Info{.name = "species",
                                .most = 620,
                                .doc = "Which fungi of the world to list, joined by +: "
                                       "boletus_edulis+russula_emetica. All without it."});
    }
    bool operator==(const PlacementParams&) const = default;
};
static_assert(well_described<PlacementParams>());

/// Placements that a URL or a body names.
struct PlacementRequest {
    WorldRequest world;
    WorldTimeRead time;
    WorldBox box = usual_box;
    std::array<bool, placement_kind_count> kinds{};
    std::vector<std::string> species;  ///< empty for all

    [[nodiscard]] bool has(PlacementKind kind) const {
        return kinds[static_cast<std::size_t>(kind)];
    }
    [[nodiscard]] double area() const { return (box.east - box.west) * (box.north - box.south); }
    /// Returns the canonical query.
    [[nodiscard]] std::string query() const {
        PlacementParams params;
        if (box != usual_box) params.bbox = Text<120>(text_of(box));
        params.kinds = Text<40>(words_text<PlacementKind>(kinds));
        std::string ids;
        for (const std::string& id : species) (ids += ids.empty() ? "" : "+") += id;
        params.species = Text<620>(ids);
        return query_text(params);
    }
};

/// Reads the list of species, which must be fungi of the world.
std::vector<std::string> read_species(std::string_view text, const WorldParams& world,
                                      ValidationErrors& errors) {
    std::vector<Problem> problems;
    std::vector<std::string> wanted = species_in(text, "species", problems), unused;
    const std::vector<std::string> known = species_in(world.fungi.species, "species", problems);
    errors.add(400, problems);
    for (const std::string& id : wanted) {
        if (std::ranges::find(known, id) != known.end()) continue;
        errors.add(422, "species", not_of_world(id, known));
    }
    return wanted == known ? unused : wanted;
}

PlacementRequest read_placements(const RouteCall& call, ValidationErrors& errors) {
    PlacementRequest request;
    const PartRequest part = read_part(call, errors);
    request.world = part.world;
    request.time = read_world_day(part.time, "placements are of one day; add it", errors);
    PlacementParams params;
    read_params(part, params, errors);
    const WorldParams& world = request.world.spec.params;
    request.box = read_box(params.bbox, extent_of(world), usual_box, errors);
    request.kinds =
        read_words<PlacementKind, placement_kind_count>(params.kinds.view(), "kinds", errors);
    request.species = read_species(params.species, world, errors);
    const double most = request.has(PlacementKind::fungus) ? most_area_of_fungi : most_area;
    if (request.area() > most)
        errors.add(
            422, "bbox",
            "has " + number_text(std::round(request.area())) + " m²; at most " + number_text(most) +
                " are listed in one request" +
                (most < most_area ? ", and 1000000 without fungi (kinds=tree+snag+log)" : ""));
    finish_reading(call, errors);
    return request;
}

Cost cost_of(const PlacementRequest& request) {
    const bool has_fungi = request.has(PlacementKind::fungus);
    const double rim = has_fungi ? 2.0 * block_side : 1.0 * block_side;
    const WorldBox& box = request.box;
    const std::uint64_t inner = blocks_of(box).size(),
                        outer = blocks_of({box.west - rim, box.south - rim, box.east + rim,
                                           box.north + rim})
                                    .size();
    return {.base = 50'000 + 10'000 * outer + (has_fungi ? 70'000 : 5'000) * inner};
}

// --- Names ------------------------------------------------------------------------------

PlacementNames names_of(const Context& context, const World& world, const Placements& placements) {
    PlacementNames names;
    for (const StandKind& kind : world.stand.kinds) names.kinds.push_back(kind.id);
    names.species = world.species_ids;
    for (const FungusSpecies& species : world.species)
        names.substrates.emplace_back(ground_of_guild(species.ecology.guild));
    for (TreeSpec spec : placements.trees) {
        // The level of detail and the images are the reader's choice.
        const TreeParams usual = own_params<Trees>(*context.atlas, spec.preset);
        spec.params.lod = usual.lod;
        spec.params.texture_size = usual.texture_size;
        names.trees.push_back(
            context.responses.link(canonical_address<Trees>(*context.atlas, spec, Product::glb)));
    }
    names.folder = context.responses.link("/v1/mushrooms/");
    return names;
}

// --- Responses --------------------------------------------------------------------------

std::string path_of(const PlacementRequest& request, PlacementFile file) {
    return '/' + request.time.text() + "/placements" + ending_of(file);
}

/// Returns the addresses of the files; none if the world has edits.
Value links_of(const Context& context, const PlacementRequest& request, const std::string& world) {
    if (request.world.edits) return Value::object();
    const auto link = [&](PlacementFile file) {
        return context.responses.link(
            with_query(folder_of(Worlds::all) + world + path_of(request, file), request.query()));
    };
    return Value::object()
        .set("self", link(PlacementFile::json))
        .set("csv", link(PlacementFile::csv))
        .set("bin", link(PlacementFile::bin));
}

Value head_of(const Context& context, const PlacementRequest& request, const std::string& world) {
    const WorldBox& box = request.box;
    return Value::object()
        .set("world", world)
        .set("time", request.time.text())
        .set("bbox", Value(Value::Array{box.west, box.south, box.east, box.north}))
        .set("axes", "x to the east, y up, z to the south, metres from the centre of the world")
        .set("links", links_of(context, request, world));
}

Placements placements_of(const PlacementRequest& request, const World& world, const Atlas& atlas,
                         const ExecutionContext& execution) {
    PlacementChoice choice{request.kinds, {}};
    if (!request.species.empty())
        for (const std::string& id : world.species_ids)
            choice.species.push_back(std::ranges::find(request.species, id) !=
                                     request.species.end());
    Placements placements =
        placements_in(world, request.box, request.time.noon(), choice, atlas, execution);
    if (placements.rows.size() > most_rows)
        throw Impossible("/bbox", "has " + std::to_string(placements.rows.size()) +
                                      " things; at most " + std::to_string(most_rows) +
                                      " are listed in one request");
    return placements;
}

Plan plan_file(RouteCall& call, PlacementFile file) {
    Context& context = call.context;
    const auto request =
        std::make_shared<const PlacementRequest>(read_placements(call, call.errors));
    if (!call.errors.empty()) return context.responses.problem(call.request, call.errors);
    Resource resource =
        world_resource(context, request->world, path_of(*request, file), request->query());
    resource.type = type_of(file);
    resource.file_name =
        request->world.spec.preset + "_placements_" + request->time.text() + ending_of(file);
    resource.estimate_cost = [cost = cost_of(*request)](const Caches&) { return cost; };
    make_of_world(
        resource, request->world.spec.params, context.atlas,
        [&context, request, file,
         text = world_text(request->world.spec, *context.atlas, resource.version)](
            const SharedWorld& world, const ExecutionContext& execution) {
            execution.observer(Step::build);
            const Placements placements =
                placements_of(*request, *world, *context.atlas, execution);
            execution.observer(Step::pack);
            const PlacementNames names = names_of(context, *world, placements);
            switch (file) {
                case PlacementFile::csv:
                    return Body{slice_of(csv_of(placements.rows, names))};
                case PlacementFile::bin:
                    return Body{slice_of(bin_of(placements.rows, names))};
                case PlacementFile::json:
                    break;
            }
            return Body{
                slice_of(json_of(placements.rows, names, head_of(context, *request, text)))};
        },
        request->world.edits);
    return plan_resource(context, call.request, std::move(resource), call.errors);
}

}  // namespace

template <PlacementFile File>
Plan plan_placements(RouteCall& call) {
    return plan_file(call, File);
}

template Plan plan_placements<PlacementFile::csv>(RouteCall& call);
template Plan plan_placements<PlacementFile::json>(RouteCall& call);
template Plan plan_placements<PlacementFile::bin>(RouteCall& call);

Value placement_query_schema(const Atlas&) { return schema<PlacementParams>(); }

Value placement_schema() {
    const Value text = typed("string"), number = typed("number"), whole = typed("integer");
    const Value numbers = list_of(number);
    Value row = objects({{"id", text},
                         {"kind", text},
                         {"species", text},
                         {"translation", numbers},
                         {"rotation", numbers},
                         {"scale", numbers},
                         {"began_day", number}});
    Value& members = *row.find("properties");
    for (const char* name : {"substrate", "host", "trunk", "model"}) members.set(name, text);
    for (const char* name : {"age", "length_m", "diameter_m"}) members.set(name, number);
    return objects({{"world", text},
                    {"time", text},
                    {"bbox", numbers},
                    {"axes", text},
                    {"count", whole},
                    {"placements", list_of(std::move(row))},
                    {"links", map_of(text)}});
}

}  // namespace sporeprint::api
