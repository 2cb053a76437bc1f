#include "api/products/worlds/placements.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
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

// --- Rows -------------------------------------------------------------------------------

/// What the rows of a file refer to.
struct Names {
    std::vector<std::string> kinds, species, substrates;
    std::vector<std::string> trees;  ///< addresses, as Placements::trees
    std::string folder;              ///< of the addresses of mushrooms
};

/// Returns what fungi of a guild that are not on a trunk stand on.
const char* ground_of_guild(Guild guild) {
    switch (guild) {
        case Guild::ectomycorrhizal:
            return "soil";
        case Guild::litter:
            return "litter";
        case Guild::grass:
            return "turf";
        case Guild::wood:
            return "wood";
    }
    return "";
}

Names names_of(const Context& context, const World& world, const Placements& placements) {
    Names names;
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

const std::string& species_of(const Placement& row, const Names& names) {
    return (row.kind == PlacementKind::fungus ? names.species : names.kinds)[row.species];
}

std::string substrate_of(const Placement& row, const Names& names) {
    if (row.kind != PlacementKind::fungus) return {};
    return row.trunk != 0 ? names.kinds[row.wood] : names.substrates[row.species];
}

double rounded_age(const Placement& row) { return std::round(row.age * 100.0) / 100.0; }

/// Returns the address of the individual's model; empty for dead wood.
std::string model_of(const Placement& row, const Names& names) {
    if (row.kind == PlacementKind::tree)
        return names.trees[row.species * tree_shapes_of_kind + row.seed - 1];
    if (row.kind != PlacementKind::fungus) return {};
    return names.folder + names.species[row.species] + ".glb?seed=" + std::to_string(row.seed) +
           "&age=" + number_text(rounded_age(row));
}

/// Returns a moment in days since the beginning of year 0.
double days_of(WorldTime time) { return static_cast<double>(time) / ticks_of_day; }

/// Appends numbers with fixed numbers of digits to a line of CSV.
class CsvLine {
  public:
    explicit CsvLine(std::string& out) : out_(out) {}
    CsvLine& text(std::string_view value) {
        if (!is_first_) out_ += ',';
        is_first_ = false;
        out_ += value;
        return *this;
    }
    CsvLine& number(double value, int digits) {
        std::array<char, 40> buffer{};
        const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                       std::chars_format::fixed, digits);
        std::string_view digits_of(buffer.data(),
                                   static_cast<std::size_t>(end.ptr - buffer.data()));
        const bool is_zero = digits_of.find_first_not_of("-0.") == std::string_view::npos;
        if (is_zero && digits_of.starts_with('-')) digits_of.remove_prefix(1);
        return text(digits_of);
    }
    CsvLine& number_if(bool is_there, double value, int digits) {
        return is_there ? number(value, digits) : text("");
    }

  private:
    std::string& out_;
    bool is_first_ = true;
};

std::string csv_of(const Placements& placements, const Names& names) {
    std::string out =
        "id,kind,species,x,y,z,qx,qy,qz,qw,sx,sy,sz,length,diameter,began,age,substrate,host,trunk,"
        "model\r\n";
    out.reserve(out.size() + placements.rows.size() * 220);
    for (const Placement& row : placements.rows) {
        const bool is_fungus = row.kind == PlacementKind::fungus;
        CsvLine line(out);
        line.text(id_text(row.id)).text(name(row.kind)).text(species_of(row, names));
        for (int i = 0; i < 3; ++i) line.number(row.place.translation[i], 3);
        for (int i = 0; i < 4; ++i) line.number(row.place.rotation[i], 5);
        for (int i = 0; i < 3; ++i) line.number(row.place.scale[i], 4);
        line.number_if(!is_fungus, row.length, 2).number_if(!is_fungus, row.diameter, 3);
        line.number(days_of(row.began), 4).number_if(is_fungus, row.age, 2);
        line.text(substrate_of(row, names));
        line.text(row.host ? id_text(row.host) : "").text(row.trunk ? id_text(row.trunk) : "");
        line.text(model_of(row, names));
        out += "\r\n";
    }
    return out;
}

double rounded(double value, double steps) { return std::round(value * steps) / steps + 0.0; }

Value row_value(const Placement& row, const Names& names) {
    const auto list = [](const auto& vector, int count, double steps) {
        Value::Array numbers;
        for (int i = 0; i < count; ++i) numbers.emplace_back(rounded(vector[i], steps));
        return Value(std::move(numbers));
    };
    Value value = Value::object()
                      .set("id", id_text(row.id))
                      .set("kind", name(row.kind))
                      .set("species", species_of(row, names))
                      .set("translation", list(row.place.translation, 3, 1e3))
                      .set("rotation", list(row.place.rotation, 4, 1e5))
                      .set("scale", list(row.place.scale, 3, 1e4))
                      .set("began_day", days_of(row.began));
    if (row.kind == PlacementKind::fungus) {
        value.set("age", rounded_age(row)).set("substrate", substrate_of(row, names));
        if (row.host) value.set("host", id_text(row.host));
        if (row.trunk) value.set("trunk", id_text(row.trunk));
    } else {
        value.set("length_m", rounded(row.length, 1e2))
            .set("diameter_m", rounded(row.diameter, 1e3));
    }
    if (const std::string model = model_of(row, names); !model.empty()) value.set("model", model);
    return value;
}

/// Row by row, since a Value of all would take several times the memory of the text.
std::string json_of(const Placements& placements, const Names& names, Value head) {
    head.set("count", placements.rows.size());
    std::string out = dump(head);
    out.erase(out.rfind('}'));
    out += ",\"placements\":[";
    for (const Placement& row : placements.rows) {
        if (&row != placements.rows.data()) out += ',';
        out += dump(row_value(row, names));
    }
    return out += "]}";
}

/// Appends numbers, low byte first.
class LittleEndian {
  public:
    explicit LittleEndian(std::string& out) : out_(out) {}
    void u64(std::uint64_t value) { bytes(value, 8); }
    void u32(std::uint32_t value) { bytes(value, 4); }
    void u16(std::uint16_t value) { bytes(value, 2); }
    void u8(std::uint8_t value) { bytes(value, 1); }
    void f32(double value) { u32(std::bit_cast<std::uint32_t>(static_cast<float>(value) + 0.0F)); }

  private:
    void bytes(std::uint64_t value, int count) {
        for (int i = 0; i < count; ++i) out_ += static_cast<char>(value >> (8 * i) & 255U);
    }
    std::string& out_;
};

constexpr std::uint32_t bytes_of_head = 24, bytes_of_row = 88;

/// A head of 24 bytes, rows of 88 bytes, and JSON with the names that they refer to; README.md has the table.
std::string bin_of(const Placements& placements, const Names& names) {
    const auto list = [](const std::vector<std::string>& texts) {
        return Value(Value::Array(texts.begin(), texts.end()));
    };
    const std::string words = dump(Value::object()
                                       .set("kinds", list(names.kinds))
                                       .set("species", list(names.species))
                                       .set("trees", list(names.trees))
                                       .set("mushrooms", names.folder));
    const auto count = static_cast<std::uint32_t>(placements.rows.size());
    std::string out = "SPPL";
    out.reserve(bytes_of_head + std::size_t{bytes_of_row} * count + words.size());
    LittleEndian write(out);
    write.u32(1);  // version of the format
    write.u32(count);
    write.u32(bytes_of_row);
    write.u32(bytes_of_head + bytes_of_row * count);
    write.u32(static_cast<std::uint32_t>(words.size()));
    for (const Placement& row : placements.rows) {
        write.u64(row.id);
        write.u64(row.host);
        write.u64(row.trunk);
        for (int i = 0; i < 3; ++i) write.f32(row.place.translation[i]);
        for (int i = 0; i < 4; ++i) write.f32(row.place.rotation[i]);
        for (int i = 0; i < 3; ++i) write.f32(row.place.scale[i]);
        write.f32(row.length);
        write.f32(row.diameter);
        write.f32(days_of(row.began));
        write.f32(row.age);
        write.u32(row.seed);
        write.u8(static_cast<std::uint8_t>(row.kind));
        write.u8(row.species);
        write.u16(row.wood);
    }
    return out += words;
}

// --- Responses --------------------------------------------------------------------------

const char* ending_of(PlacementFile file) {
    switch (file) {
        case PlacementFile::csv:
            return ".csv";
        case PlacementFile::json:
            return ".json";
        case PlacementFile::bin:
            return ".bin";
    }
    return "";
}

const char* type_of(PlacementFile file) {
    switch (file) {
        case PlacementFile::csv:
            return "text/csv";
        case PlacementFile::json:
            return "application/json";
        case PlacementFile::bin:
            return "application/octet-stream";
    }
    return "";
}

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
            const Names names = names_of(context, *world, placements);
            switch (file) {
                case PlacementFile::csv:
                    return Body{slice_of(csv_of(placements, names))};
                case PlacementFile::bin:
                    return Body{slice_of(bin_of(placements, names))};
                case PlacementFile::json:
                    break;
            }
            return Body{slice_of(json_of(placements, names, head_of(context, *request, text)))};
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
