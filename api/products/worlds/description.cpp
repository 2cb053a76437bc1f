#include "api/products/worlds/description.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "api/products/presets.h"
#include "api/products/resource.h"
#include "api/products/worlds/maps.h"
#include "api/products/worlds/worlds.h"
#include "core/params/query.h"
#include "core/params/schema.h"
#include "core/world/absence.h"
#include "core/world/weather.h"

namespace sporeprint::api {

namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

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
                 .set("tileset", context.responses.link(folder + "/web/y80d270/tileset.json"))
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

}  // namespace

Plan plan_description(RouteCall& call) {
    Context& context = call.context;
    const WorldRequest requested = read_world(call.captured[0], context, call.errors);
    refuse_query_of_world(call.target, call.errors);
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
    const WorldRequest requested = read_world(call.captured[0], context, call.errors);
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

Value weather_query_schema(const Atlas&) { return schema<YearParams>(); }

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

}  // namespace sporeprint::api
