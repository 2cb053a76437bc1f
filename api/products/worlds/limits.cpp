#include "api/products/worlds/limits.h"

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "api/http/schemas.h"
#include "api/products/resource.h"
#include "api/products/worlds/parts.h"
#include "api/products/worlds/worlds.h"
#include "core/grow/world/limits.h"
#include "core/grow/world/plot_of_world.h"
#include "core/params/messages.h"
#include "core/params/query.h"
#include "core/params/schema.h"
#include "core/world/absence.h"

namespace sporeprint::api {

namespace {

/// The query of limits.
struct LimitParams {
    double x = 0.0, y = 0.0;

    static constexpr void fields(auto visit) {
        using L = LimitParams;
        visit(&L::x, Info{.name = "x",
                          .unit = "m",
                          .min = -2048,
                          .max = 2048,
                          .doc = "The place, to the east of the centre of the world."});
        visit(&L::y, Info{.name = "y",
                          .unit = "m",
                          .min = -2048,
                          .max = 2048,
                          .doc = "The place, to the north of the centre of the world."});
    }
    bool operator==(const LimitParams&) const = default;
};
static_assert(well_described<LimitParams>());

/// A place and a day that a URL names.
struct LimitRequest {
    WorldRequest world;
    WorldTimeRead time;
    LimitParams params;

    [[nodiscard]] WorldPoint place() const { return point_at(params.x, params.y); }
    /// Returns the query that names its place.
    [[nodiscard]] std::string query() const { return query_text(params); }
};

LimitRequest read_limits(const RouteCall& call, ValidationErrors& errors) {
    LimitRequest request;
    request.world = read_world(call.captured[0], call.context, errors);
    request.time = read_world_day(call.captured[1],
                                  "what limits fungi changes from day to day; add one", errors);
    std::vector<Problem> problems;
    read_query(query_of_world(call.target, errors), request.params, problems);
    errors.add(400, problems);
    without_negative_zero(request.params);
    if (!errors.empty()) return request;
    const WorldBox extent = extent_of(request.world.spec.params);
    const auto check = [&](double value, double least, double most, const char* name) {
        if (value < least || value >= most)
            errors.add(422, name,
                       number_text(value) + " is outside the world, which reaches from " +
                           number_text(least) + " to " + number_text(most));
    };
    check(request.params.x, extent.west, extent.east, "x");
    check(request.params.y, extent.south, extent.north, "y");
    return request;
}

double rounded(double value) { return std::round(value * 1000.0) / 1000.0 + 0.0; }

/// Returns where a value is against a response, such as "0.9, above the 0.1 to 0.5 that it prefers".
template <class Response>
std::string against(double value, const Response& response) {
    const Range &wanted = response.prefers, &possible = response.tolerates;
    const bool is_impossible = value < possible.from || value > possible.to;
    const Range& range = is_impossible ? possible : wanted;
    return number_text(rounded(value)) + ", " + (value < range.from ? "below" : "above") + " the " +
           number_text(range.from) + " to " + number_text(range.to) + " that it " +
           (is_impossible ? "tolerates" : "prefers");
}

const char* missing_substrate(Guild guild) {
    switch (guild) {
        case Guild::ectomycorrhizal:
            return "None of the trees that it lives with has roots here.";
        case Guild::litter:
            return "The litter that it lives on does not fall here.";
        case Guild::grass:
            return "There is no turf here.";
        case Guild::wood:
            return "No dead wood that it lives on, as rotten as it needs, is here.";
    }
    return "";
}

/// Returns in a sentence what limits a species most.
std::string sentence_of(Condition condition, const Ecology& ecology, const PlaceLimits& place,
                        double share) {
    const bool is_nothing = share <= 0.0;
    switch (condition) {
        case Condition::establishment:
            return is_nothing ? "Its spores have not settled here yet."
                              : "It is not common here yet: its spores are few.";
        case Condition::substrate:
            return missing_substrate(ecology.guild);
        case Condition::light:
            return "The light is " + against(place.site.light, ecology.light) + '.';
        case Condition::wetness:
            return "The wetness of the ground in autumn is " +
                   against(place.site.wetness, ecology.wetness) + '.';
        case Condition::acidity:
            return "The acidity of the soil is " + against(place.site.acidity, ecology.acidity) +
                   '.';
        case Condition::mycelium:
            return "It could live here, but none of its mycelia does.";
        case Condition::temperature:
            return "The last five days were too warm or too cold; it fruits best at " +
                   number_text(ecology.temperature.prefers.from) + " to " +
                   number_text(ecology.temperature.prefers.to) + " °C.";
        case Condition::rain:
            return "There has been too little rain.";
        case Condition::moisture:
            return "The ground is too dry on this day: its wetness is " +
                   number_text(rounded(place.wetness)) + '.';
        case Condition::month:
            return "It is not the time of the year in which it fruits.";
        case Condition::cold:
            return "The last three nights were too cold.";
    }
    return {};
}

Value species_value(const World& world, std::size_t i, const PlaceLimits& place) {
    const Limits& limits = place.species[i];
    const Ecology& ecology = world.species[i].ecology;
    Value all = Value::object();
    for (std::size_t k = 0; k < condition_count; ++k)
        all.set(name(static_cast<Condition>(k)), rounded(limits.values[k]));
    const Condition limiting = limits.limiting();
    const double share = limits[limiting];
    const bool is_limited = share < 1.0;
    std::string why = reason_of_absence(ecology, world.params);
    if (why.empty())
        why = is_limited ? sentence_of(limiting, ecology, place, share)
                         : "Nothing keeps it from fruiting here on this day.";
    return Value::object()
        .set("id", world.species_ids[i])
        .set("guild", name(ecology.guild))
        .set("possible", share > 0.0)
        .set("limiting", is_limited ? name(limiting) : "nothing")
        .set("share", rounded(share))
        .set("why", std::move(why))
        .set("limits", std::move(all));
}

Value describe(const Context& context, const LimitRequest& request, const World& world,
               const PlaceLimits& limits, const std::string& text) {
    Value species = Value::array();
    for (std::size_t i = 0; i < world.species.size(); ++i)
        species.push(species_value(world, i, limits));
    const std::string folder = folder_of(Worlds::all) + text + '/' + request.time.text();
    return Value::object()
        .set("world", text)
        .set("time", request.time.text())
        .set("place_m", Value(Value::Array{request.params.x, request.params.y,
                                           rounded(world.place_at(request.place()).height)}))
        .set("axes", axes_of_places)
        .set("site", Value::object()
                         .set("light", rounded(limits.site.light))
                         .set("wetness_in_autumn", rounded(limits.site.wetness))
                         .set("wetness_today", rounded(limits.wetness))
                         .set("acidity", rounded(limits.site.acidity)))
        .set("species", std::move(species))
        .set("links", Value::object().set("self", context.responses.link(with_query(
                                                      folder + "/limits.json", request.query()))));
}

}  // namespace

Plan plan_limits(RouteCall& call) {
    Context& context = call.context;
    const auto request = std::make_shared<const LimitRequest>(read_limits(call, call.errors));
    if (!call.errors.empty()) return context.responses.problem(call.request, call.errors);
    Resource resource = world_resource(
        context, request->world, '/' + request->time.text() + "/limits.json", request->query());
    resource.file_name = request->world.spec.preset + "_limits_" + request->time.text() + ".json";
    resource.estimate_cost = [](const Caches&) { return Cost{.base = 100'000}; };
    make_of_world(
        resource, request->world.spec.params, context.atlas,
        [&context, request,
         text = world_text(request->world.spec, *context.atlas, resource.version)](
            const SharedWorld& world, const ExecutionContext& execution) {
            execution.observer(Step::build);
            const PlaceLimits limits = limits_in(*world, request->place(), request->time.year,
                                                 request->time.day, execution);
            execution.observer(Step::pack);
            return Body{slice_of(dump(describe(context, *request, *world, limits, text)))};
        });
    return plan_resource(context, call.request, std::move(resource), call.errors);
}

Value limits_query_schema(const Atlas&) { return schema<LimitParams>(); }

Value limits_schema() {
    const Value text = typed("string"), number = typed("number");
    return objects({{"world", text},
                    {"time", text},
                    {"place_m", list_of(number)},
                    {"axes", text},
                    {"site", objects({{"light", number},
                                      {"wetness_in_autumn", number},
                                      {"wetness_today", number},
                                      {"acidity", number}})},
                    {"species", list_of(objects({{"id", text},
                                                 {"guild", text},
                                                 {"possible", typed("boolean")},
                                                 {"limiting", text},
                                                 {"share", number},
                                                 {"why", text},
                                                 {"limits", map_of(number)}}))},
                    {"links", map_of(text)}});
}

}  // namespace sporeprint::api
