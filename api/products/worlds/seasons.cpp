#include "api/products/worlds/seasons.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "api/http/schemas.h"
#include "api/products/resource.h"
#include "api/products/worlds/parts.h"
#include "api/products/worlds/worlds.h"
#include "core/grow/world/parts.h"
#include "core/params/query.h"
#include "core/params/schema.h"
#include "core/world/season.h"

namespace sporeprint::api {

namespace {

/// Greatest area of a season, and the rectangle without bbox, metres.
constexpr double most_area = 10'000.0;
constexpr WorldBox usual_box{-32.0, -32.0, 32.0, 32.0};

/// The query of a season.
struct SeasonParams {
    int year = 0;
    Text<120> bbox;

    static constexpr void fields(auto visit) {
        using S = SeasonParams;
        visit(&S::year,
              Info{.name = "year", .min = 0, .max = last_year, .doc = "Which year of the world."});
        visit(&S::bbox, Info{.name = "bbox",
                             .unit = "m",
                             .most = 120,
                             .doc = "West, south, east and north edge of the ground that is looked "
                                    "at, from the centre of the world; at most 10,000 m². Without "
                                    "it -32,-32,32,32."});
    }
    bool operator==(const SeasonParams&) const = default;
};
static_assert(well_described<SeasonParams>());

/// A season that a URL names.
struct SeasonRequest {
    WorldRequest world;
    int year = 0;
    WorldBox box;

    [[nodiscard]] std::string query() const {
        SeasonParams params;
        params.year = year;
        if (box != usual_box) params.bbox = Text<120>(text_of(box));
        return query_text(params);
    }
    [[nodiscard]] double area() const { return (box.east - box.west) * (box.north - box.south); }
};

SeasonRequest read_season(const RouteCall& call, ValidationErrors& errors) {
    SeasonRequest request;
    request.world = read_world(call.captured[0], call.context, errors);
    SeasonParams params;
    std::vector<Problem> problems;
    read_query(query_of_world(call.target, errors), params, problems);
    errors.add(400, problems);
    request.year = params.year;
    request.box = read_box(params.bbox, extent_of(request.world.spec.params), usual_box, errors);
    if (request.area() > most_area)
        errors.add(422, "bbox",
                   "has " + number_text(std::round(request.area())) +
                       " m²; at most 10000 are looked at in one request");
    return request;
}

Value daily(const WeatherYear& weather, double WeatherDay::*member) {
    Value list = Value::array();
    for (const WeatherDay& day : weather) list.push(std::round(day.*member * 100.0) / 100.0 + 0.0);
    return list;
}

Value describe(const SeasonRequest& request, const World& world,
               const std::vector<FruitBody>& bodies, const std::string& text) {
    const std::vector<std::array<std::uint32_t, days_of_year>> counts =
        daily_counts(bodies, world.species.size(), request.year);
    std::vector<int> emerged(world.species.size(), 0);
    for (const FruitBody& body : bodies)
        if (body.emerged >= time_of(request.year) && body.emerged < time_of(request.year + 1))
            ++emerged[body.species];
    Value species = Value::array();
    for (std::size_t i = 0; i < world.species.size(); ++i) {
        Value days = Value::array();
        for (const std::uint32_t count : counts[i]) days.push(static_cast<int>(count));
        species.push(Value::object()
                         .set("id", world.species_ids[i])
                         .set("guild", name(world.species[i].ecology.guild))
                         .set("emerged", emerged[i])
                         .set("standing", std::move(days)));
    }
    const WorldParams& params = world.params;
    const WeatherYear weather = weather_of(params.climate, params.seed, request.year);
    const WorldBox& box = request.box;
    return Value::object()
        .set("world", text)
        .set("year", request.year)
        .set("bbox", Value(Value::Array{box.west, box.south, box.east, box.north}))
        .set("area_m2", request.area())
        .set("species", std::move(species))
        .set("days", Value::object()
                         .set("rain_mm", daily(weather, &WeatherDay::rain))
                         .set("temperature_c", daily(weather, &WeatherDay::temperature))
                         .set("soil_water_mm", daily(weather, &WeatherDay::soil_water)));
}

}  // namespace

Plan plan_season(RouteCall& call) {
    Context& context = call.context;
    const auto request = std::make_shared<const SeasonRequest>(read_season(call, call.errors));
    if (!call.errors.empty()) return context.responses.problem(call.request, call.errors);
    Resource resource = world_resource(context, request->world, "/season.json", request->query());
    resource.file_name =
        request->world.spec.preset + "_season_" + std::to_string(request->year) + ".json";
    const Cost cost{.base = 20'000 + 120'000 * blocks_of(request->box).size()};
    resource.estimate_cost = [cost](const Caches&) { return cost; };
    make_of_world(
        resource, request->world.spec.params, context.atlas,
        [request, text = world_text(request->world.spec, *context.atlas, resource.version)](
            const SharedWorld& world, const ExecutionContext& execution) {
            execution.observer(Step::build);
            const std::vector<FruitBody> bodies =
                bodies_of_year(*world, request->box, request->year, execution);
            execution.observer(Step::pack);
            return Body{slice_of(dump(describe(*request, *world, bodies, text)))};
        });
    return plan_resource(context, call.request, std::move(resource), call.errors);
}

Value season_query_schema(const Atlas&) { return schema<SeasonParams>(); }

Value season_schema() {
    const Value text = typed("string"), number = typed("number"), whole = typed("integer");
    const Value days = list_of(number);
    return objects(
        {{"world", text},
         {"year", whole},
         {"bbox", list_of(number)},
         {"area_m2", number},
         {"species",
          list_of(objects(
              {{"id", text}, {"guild", text}, {"emerged", whole}, {"standing", list_of(whole)}}))},
         {"days", objects({{"rain_mm", days}, {"temperature_c", days}, {"soil_water_mm", days}})}});
}

}  // namespace sporeprint::api
