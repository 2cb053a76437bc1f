#include "api/products/worlds.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "api/http/schemas.h"
#include "api/products/mix.h"
#include "api/products/presets.h"
#include "api/products/resource.h"
#include "api/products/world_limits.h"
#include "api/products/world_maps.h"
#include "api/products/world_placements.h"
#include "api/products/world_plots.h"
#include "api/products/world_seasons.h"
#include "core/params/canonical.h"
#include "core/params/query.h"
#include "core/params/schema.h"
#include "core/world/absence.h"
#include "core/world/weather.h"

namespace sporeprint::api {

namespace {

constexpr const char* json = "application/json";

using Pairs = std::vector<std::pair<std::string, std::string>>;

/// Returns the pairs behind the preset of a world's text. A part without '=' is an error.
Pairs pairs_of(std::string_view text, ValidationErrors& errors) {
    Pairs pairs;
    while (!text.empty()) {
        text.remove_prefix(1);  // the comma
        const std::string_view part = text.substr(0, text.find(','));
        const std::size_t equals = part.find('=');
        if (equals == std::string_view::npos || equals == 0)
            errors.add(400, "world",
                       in_quotes(part) +
                           " is not name=value; a world is a preset and such pairs "
                           "behind it, as in 'beech,seed=7'");
        else
            pairs.emplace_back(part.substr(0, equals), part.substr(equals + 1));
        text.remove_prefix(part.size());
    }
    return pairs;
}

void replace_all(std::string& text, std::string_view old, std::string_view by) {
    for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += by.size())
        text.replace(at, old.size(), by);
}

/// Reports kinds of trees that the atlas does not have.
void check_kinds(const StandParams& stand, const Atlas& atlas, std::vector<Problem>& problems) {
    std::vector<std::string> ids;
    for (const TreePreset& tree : atlas.trees()) ids.push_back(tree.id.string());
    const auto check = [&](std::string_view id, const char* name) {
        if (atlas.find_tree(id)) return;
        const std::string_view meant = closest(id, ids);
        report(problems, name,
               "unknown tree " + in_quotes(id) +
                   (meant.empty() ? "; those of /v1/trees are known"
                                  : "; did you mean " + in_quotes(meant) + '?'));
    };
    for (const auto& [id, weight] : kinds_in(stand.kinds, "stand.kinds", problems))
        check(id, "stand.kinds");
    if (!stand.lone.empty()) check(stand.lone, "stand.lone");
}

/// Reports species that the atlas does not have.
void check_species(const FungiParams& fungi, const Atlas& atlas, std::vector<Problem>& problems) {
    for (const std::string& id : species_in(fungi.species, "fungi.species", problems))
        if (!atlas.find(id)) report(problems, "fungi.species", unknown_species(id, atlas));
}

/// The query of a world's weather.
struct YearParams {
    int year = 0;

    static constexpr void fields(auto visit) {
        visit(&YearParams::year,
              Info{.name = "year", .min = 0, .max = last_year, .doc = "Which year of the world."});
    }
};
static_assert(well_described<YearParams>());

/// Returns the fungi of a world, and why those that cannot live in it do not.
Value fungi_of(const WorldParams& params, const Atlas& atlas) {
    Value list = Value::array();
    std::vector<Problem> problems;
    for (const std::string& id : species_in(params.fungi.species, "fungi.species", problems)) {
        const AtlasEntry* const entry = atlas.find(id);
        if (entry == nullptr) continue;
        const Ecology& ecology = entry->species.ecology;
        std::string why = reason_of_absence(ecology, params);
        Value one = Value::object()
                        .set("id", id)
                        .set("guild", name(ecology.guild))
                        .set("possible", why.empty());
        if (!why.empty()) one.set("why_not", std::move(why));
        list.push(std::move(one));
    }
    return list;
}

Value describe_world(const Context& context, const WorldSpec& spec, const std::string& version) {
    const std::string text = world_text(spec, *context.atlas, version),
                      folder = folder_of(Worlds::all) + text;
    return Value::object()
        .set("canonical", folder_of(Worlds::all) + world_text(spec, *context.atlas) + ".json")
        .set("world", text)
        .set("v", version)
        .set("preset", spec.preset)
        .set("effective", write(spec.params))
        .set("fungi", fungi_of(spec.params, *context.atlas))
        .set("years", Value(Value::Array{0, last_year}))
        .set("maps", map_list(context.responses, folder))
        .set("links",
             Value::object()
                 .set("self", context.responses.link(folder + ".json"))
                 .set("weather", context.responses.link(folder + "/weather.json"))
                 .set("season", context.responses.link(folder + "/season.json"))
                 .set("plot", context.responses.link(folder + "/y80d270/plot.glb"))
                 .set("placements", context.responses.link(folder + "/y80d270/placements.csv"))
                 .set("limits", context.responses.link(folder + "/y80d270/limits.json"))
                 .set("schema", context.responses.link("/v1/worlds/schema")));
}

/// Returns a number with two digits behind its point.
double rounded(double value) { return std::round(value * 100.0) / 100.0 + 0.0; }

/// Returns the sums and means of some days of a year.
Value summary(std::span<const WeatherDay> days) {
    WeatherDay sum;
    int wet_days = 0;
    for (const WeatherDay& day : days) {
        sum.rain += day.rain;
        sum.temperature += day.temperature;
        sum.evaporation += day.evaporation;
        sum.soil_water += day.soil_water;
        wet_days += rounded(day.rain) > 0.0 ? 1 : 0;  // less than that is dew
    }
    const auto count = static_cast<double>(days.size());
    return Value::object()
        .set("rain_mm", rounded(sum.rain))
        .set("rain_days", wet_days)
        .set("temperature_c", rounded(sum.temperature / count))
        .set("potential_evaporation_mm", rounded(sum.evaporation))
        .set("soil_water_mm", rounded(sum.soil_water / count));
}

Value daily(const WeatherYear& year, double WeatherDay::*member) {
    Value list = Value::array();
    for (const WeatherDay& day : year) list.push(rounded(day.*member));
    return list;
}

Value describe_weather(const WorldSpec& spec, const std::string& text, int number) {
    const WeatherYear year = weather_of(spec.params.climate, spec.params.seed, number);
    const std::span<const WeatherDay> days = year;
    Value months = Value::array();
    std::size_t first = 0;
    for (const int length : days_of_months) {
        months.push(summary(days.subspan(first, static_cast<std::size_t>(length))));
        first += static_cast<std::size_t>(length);
    }
    return Value::object()
        .set("world", text)
        .set("year", number)
        .set("days", Value::object()
                         .set("rain_mm", daily(year, &WeatherDay::rain))
                         .set("temperature_c", daily(year, &WeatherDay::temperature))
                         .set("potential_evaporation_mm", daily(year, &WeatherDay::evaporation))
                         .set("soil_water_mm", daily(year, &WeatherDay::soil_water)))
        .set("months", std::move(months))
        .set("whole_year", summary(days))
        .set("most_soil_water_mm", most_soil_water);
}

Plan plan_description(RouteCall& call) {
    Context& context = call.context;
    const WorldRequest requested = read_world(call.captured[0], *context.atlas, call.errors);
    std::vector<Problem> problems;
    const Pairs query = query_of_world(call.target, call.errors);
    QueryReader(query, problems).refuse_the_rest();
    call.errors.add(400, problems);
    if (!call.errors.empty()) return context.responses.problem(call.request, call.errors);
    Resource resource = world_resource(context, requested, ".json", {});
    resource.file_name = requested.spec.preset + ".json";
    resource.estimate_cost = [](const Caches&) { return Cost{.base = 50}; };
    resource.make = [&context, spec = requested.spec, version = resource.version](JobContext& job) {
        job.execution().observer(Step::pack);
        return Body{slice_of(dump(describe_world(context, spec, version)))};
    };
    return plan_resource(context, call.request, std::move(resource), call.errors);
}

Plan plan_weather(RouteCall& call) {
    Context& context = call.context;
    const WorldRequest requested = read_world(call.captured[0], *context.atlas, call.errors);
    YearParams params;
    std::vector<Problem> problems;
    read_query(query_of_world(call.target, call.errors), params, problems);
    call.errors.add(400, problems);
    if (!call.errors.empty()) return context.responses.problem(call.request, call.errors);
    Resource resource = world_resource(context, requested, "/weather.json", query_text(params));
    resource.file_name =
        requested.spec.preset + "_weather_" + std::to_string(params.year) + ".json";
    resource.estimate_cost = [](const Caches&) { return Cost{.base = 400}; };
    resource.make =
        [spec = requested.spec, year = params.year,
         text = world_text(requested.spec, *context.atlas, resource.version)](JobContext& job) {
            job.execution().observer(Step::build);
            const Value weather = describe_weather(spec, text, year);
            job.execution().observer(Step::pack);
            return Body{slice_of(dump(weather))};
        };
    return plan_resource(context, call.request, std::move(resource), call.errors);
}

Value world_list(const Atlas& atlas) {
    Value list = Value::array();
    for (const WorldPreset& preset : atlas.worlds()) {
        const std::string folder = folder_of(Worlds::all) + preset.id.string();
        list.push(Value::object()
                      .set("id", preset.id.view())
                      .set("name", preset.name.view())
                      .set("links", Value::object()
                                        .set("self", folder + ".json")
                                        .set("weather", folder + "/weather.json")
                                        .set("plot", folder + "/y80d270/plot.glb")
                                        .set("schema", "/v1/worlds/schema")));
    }
    return Value::object().set(Worlds::all, std::move(list));
}

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
     .query_schema = [](const Atlas&) { return schema<YearParams>(); },
     .plan = plan_weather,
     .has_version_in_path = true},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/worlds/{world}/{time}/maps/{map}.png",
     .id = "get_map",
     .summary = "A map of a world: grey numbers of 16 bits, or heights in the colours of "
                "Terrarium.",
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
};

void add_links(Value& links, const Atlas&) {
    links.set("worlds", "/v1/worlds").set("world_schema", "/v1/worlds/schema");
}

void add_parameters(Value& parameters, const Route& route, const Atlas& atlas) {
    const std::string_view pattern = route.pattern;
    const auto has = [&](const char* capture) {
        return pattern.find(capture) != std::string_view::npos;
    };
    if (has("{world}"))
        parameters.push(path_parameter(
            "world",
            "Id of a preset, then what differs from it as ,name=value by the names of "
            "/v1/worlds/schema, last perhaps ,v= and a version token: today's makes the answer "
            "immutable, any other is 410 with the canonical address of today's.",
            object({{"type", "string"}, {"maxLength", longest_world}}),
            atlas.worlds().front().id.string() + ",seed=7"));
    if (has("{time}"))
        parameters.push(path_parameter(
            "time",
            "A year from y0 to y200, with a day from d1 to d365 for "
            "what changes from day to day.",
            object({{"type", "string"}, {"pattern", "^y\\d{1,3}(d\\d{1,3})?$"}}), "y80d270"));
    if (has("{map}"))
        parameters.push(path_parameter(
            "map", "Which map.",
            object({{"type", "string"},
                    {"enum", map_names(pattern.ends_with(".r16") ? MapFile::r16 : MapFile::png)}}),
            "height"));
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

}  // namespace

WorldRequest read_world(std::string_view text, const Atlas& atlas, ValidationErrors& errors) {
    WorldRequest request;
    if (text.size() > longest_world) {
        errors.add(400, "world",
                   "has " + std::to_string(text.size()) + " bytes; at most " +
                       std::to_string(longest_world) + " are allowed");
        text = {};
    }
    const std::string_view id = text.substr(0, text.find(','));
    const WorldPreset& preset = preset_of<Worlds>(atlas, id, "world", errors);
    request.spec = {preset.id.string(), params_of(preset, atlas)};
    Pairs rest;
    request.version = take_version(pairs_of(text.substr(id.size()), errors), rest, errors);
    std::vector<Problem> problems;
    read_query(rest, request.spec.params, problems);
    if (problems.empty()) check_kinds(request.spec.params.stand, atlas, problems);
    if (problems.empty()) check_species(request.spec.params.fungi, atlas, problems);
    errors.add(400, problems);
    StandParams& stand = request.spec.params.stand;
    stand.kinds = Text<256>(canonical_kinds(stand.kinds));
    FungiParams& fungi = request.spec.params.fungi;
    fungi.species = Text<620>(canonical_species(fungi.species));
    without_negative_zero(request.spec.params);
    return request;
}

std::string world_text(const WorldSpec& spec, const Atlas& atlas, std::string_view version) {
    std::string query = query_text(spec.params, own_params<Worlds>(atlas, spec.preset));
    std::replace(query.begin(), query.end(), '&', ',');
    // Signs of the list of kinds, which a path may have as they are.
    replace_all(query, "%3A", ":");
    replace_all(query, "%2B", "+");
    std::string text = spec.preset;
    if (!query.empty()) (text += ',') += query;
    if (!version.empty()) (text += ",v=") += version;
    return text;
}

std::vector<std::pair<std::string, std::string>> query_of_world(const Target& target,
                                                                ValidationErrors& errors) {
    Pairs query;
    for (const auto& pair : target.query) {
        if (pair.first == "v")
            errors.add(400, "v", "of a world ends its text in the path: ',v=' and the token");
        else
            query.push_back(pair);
    }
    return query;
}

Resource world_resource(const Context& context, const WorldRequest& requested,
                        const std::string& ending, const std::string& query) {
    Resource resource;
    resource.version = preset_token<Worlds>(*context.atlas, requested.spec.preset);
    const std::string text = world_text(requested.spec, *context.atlas, resource.version);
    resource.address = with_query(folder_of(Worlds::all) + text + ending, query);
    resource.key = Worlds::one + with_query(ending, query) + ' ' + resource.version + '\n' +
                   requested.spec.preset + '\n' + canonical_text(requested.spec.params);
    resource.type = json;
    resource.requested_version = requested.version;
    return resource;
}

const RouteGroup world_routes = {
    .tag = "worlds",
    .description =
        "Worlds: woods and meadows of a square kilometre through 200 years, their ground, weather, "
        "trees and fungi.",
    .routes = routes,
    .add_links = add_links,
    .add_schemas = add_schemas,
    .add_parameters = add_parameters,
};

}  // namespace sporeprint::api
