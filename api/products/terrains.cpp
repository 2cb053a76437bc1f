#include "api/products/terrains.h"

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/http/schemas.h"
#include "api/products/context.h"
#include "api/products/product.h"
#include "api/products/resource.h"
#include "core/params/messages.h"
#include "core/params/query.h"
#include "core/params/schema.h"
#include "core/surface/codecs.h"
#include "core/surface/grey_codec.h"
#include "core/world/terrain_map.h"

namespace sporeprint::api {

namespace {

constexpr const char* json = "application/json";
constexpr std::size_t most_terrain_bytes = 32u << 20U;

/// What has to be said of a terrain, since no image tells how wide and how high its ground is.
constexpr std::array required_of_upload = {"metres", "max"};

/// Returns the cost of work on the samples of a terrain: decoding a PNG file, hashing, writing; or encoding one.
Cost cost_of_samples(std::uint64_t samples) { return {.base = 2'000 + samples / 20}; }

std::string path_of(const std::string& id) { return folder_of("terrains") + id; }

/// Returns what is known of a terrain.
Value described(const TerrainMap& map, const std::string& id, const ResponseBuilder& responses) {
    const auto [low, high] = std::ranges::minmax(map.samples);
    return Value::object()
        .set("terrain", id)
        .set("side", map.side)
        .set("metres", map.scale.metres)
        .set("min", map.scale.min)
        .set("max", map.scale.max)
        .set("lowest", map.height(low))
        .set("highest", map.height(high))
        .set("links",
             Value::object()
                 .set("self", responses.link(path_of(id) + ".json"))
                 .set("image", responses.link(path_of(id) + ".png"))
                 .set("world", responses.link("/v1/worlds/beech,terrain.id=" + id + ".json")));
}

/// Returns the terrain of a PNG file.
///
/// throws  InvalidInput for a file or a scale that is none of a terrain
TerrainMap terrain_of(std::span<const std::uint8_t> file, const TerrainScale& scale) {
    const GreyValues grey = decoded_grey(file, most_terrain_side, "");
    TerrainMap map{scale, grey.width, grey.values};
    check(map);
    return map;
}

/// Adds what the header of a PNG file tells that a terrain cannot be.
void check_header(std::span<const std::uint8_t> file, ValidationErrors& errors) {
    try {
        const DeclaredSize size = declared_grey_size(file, most_terrain_side, "");
        const std::string pixels =
            std::to_string(size.width) + " x " + std::to_string(size.height) + " pixels; ";
        if (size.bits != 16)
            errors.add(422, "",
                       "the image has 8 bits, which make steps of the ground; a terrain has 16");
        if (size.width != size.height)
            errors.add(422, "", "the image has " + pixels + "a terrain is square, as a world is");
        else if (size.width < least_terrain_side)
            errors.add(422, "",
                       "the image has " + pixels + "a terrain has at least " +
                           std::to_string(least_terrain_side) + " a side");
    } catch (const InvalidInput& refused) {
        errors.add(422, refused.problems());
    }
}

Plan plan_upload(RouteCall& call) {
    Context& context = call.context;
    const Request& request = call.request;
    TerrainScale scale;
    std::vector<Problem> problems;
    read_query(call.target.query, scale, problems);
    call.errors.add(400, problems);
    for (const std::string_view name : required_of_upload)
        if (std::ranges::none_of(call.target.query,
                                 [&](const auto& pair) { return pair.first == name; }))
            call.errors.add(400, std::string(name),
                            "is missing; no image tells how wide and how high its ground is");
    if (!context.store.terrains)
        call.errors.add(422, "",
                        "this service stores no terrains; its operator can give it a --store");
    const std::span<const std::uint8_t> file(
        reinterpret_cast<const std::uint8_t*>(request.body.data()), request.body.size());
    if (call.errors.empty()) check_header(file, call.errors);
    if (!call.errors.empty()) return context.responses.problem(request, call.errors);
    const DeclaredSize size = declared_grey_size(file, most_terrain_side, "");
    const Cost cost = cost_of_samples(static_cast<std::uint64_t>(size.width) *
                                      static_cast<std::uint64_t>(size.height));
    auto run = [sent = std::make_shared<const Bytes>(file.begin(), file.end()), scale,
                &store = context.store, &responses = context.responses](
                   const std::stop_token& stop, const Observer& observer, const Parallel&) {
        observer(Step::resolve);
        TerrainMap map;
        try {
            map = terrain_of(*sent, scale);
        } catch (const InvalidInput& refused) {
            throw Impossible(refused.problems());
        }
        if (stop.stop_requested()) throw Cancelled();
        observer(Step::pack);
        const std::string id = id_of(map);
        const bool is_known = store.terrains->holds(id);
        if (!store.terrains->insert(id, {Slice(std::make_shared<const Bytes>(file_of(map)))}))
            throw GenerationError("a terrain could not be written to the store");
        Response response = private_json(described(map, id, responses), is_known ? 200 : 201);
        set_header(response, "Location", responses.link(path_of(id) + ".json"));
        return response;
    };
    // Each upload is a piece of work of its own: its key is a number, not a hash of up to 32 MB.
    return Job{"terrain " + std::to_string(context.store.uploads++), cost, std::move(run)};
}

/// Plans a file about a stored terrain.
Plan plan_of_terrain(RouteCall& call, const char* ending, const char* type, Cost cost,
                     Body (*make)(const TerrainMap&, const std::string& id,
                                  const ResponseBuilder&)) {
    Context& context = call.context;
    const std::string& id = call.captured[0];
    std::vector<std::pair<std::string, std::string>> rest;
    Resource resource;
    resource.requested_version = take_version(call.target.query, rest, call.errors);
    std::vector<Problem> problems;
    QueryReader(rest, problems).refuse_the_rest();
    call.errors.add(400, problems);
    const bool is_stored =
        is_terrain_id(id) && context.store.terrains && context.store.terrains->holds(id);
    if (!is_stored)
        call.errors.add(404, "terrain",
                        "there is no terrain " + in_quotes(id) +
                            ", or no longer; upload it to /v1/terrains again");
    if (!call.errors.empty()) return context.responses.problem(call.request, call.errors);
    resource.version = token_of(id);
    resource.key = "terrain " + id + ending + ' ' + resource.version;
    resource.type = type;
    resource.address = with_version(path_of(id) + ending, resource.version);
    resource.file_name = id + ending;
    resource.estimate_cost = [cost](const Caches&) { return cost; };
    resource.make = [id, make, &responses = context.responses](JobContext& job) {
        job.execution().observer(Step::resolve);
        const SharedTerrain terrain = job.execution().caches.terrain(id);
        if (!terrain)
            throw InvalidInput("terrain", "there is no terrain " + id +
                                              " any more; upload it to /v1/terrains again");
        job.execution().observer(Step::pack);
        return make(*terrain, id, responses);
    };
    return plan_resource(context, call.request, std::move(resource), call.errors);
}

Plan plan_description(RouteCall& call) {
    return plan_of_terrain(
        call, ".json", json, Cost{.base = 3'000},
        [](const TerrainMap& map, const std::string& id, const ResponseBuilder& responses) {
            return Body{slice_of(dump(described(map, id, responses)))};
        });
}

Plan plan_image(RouteCall& call) {
    return plan_of_terrain(call, ".png", "image/png",
                           cost_of_samples(std::uint64_t{most_terrain_side} * most_terrain_side),
                           [](const TerrainMap& map, const std::string&, const ResponseBuilder&) {
                               const ImageTexts texts = {{"metres", number_text(map.scale.metres)},
                                                         {"min", number_text(map.scale.min)},
                                                         {"max", number_text(map.scale.max)}};
                               return Body{Slice(std::make_shared<const Bytes>(
                                   png_of_numbers(map.samples, map.side, map.side, texts)))};
                           });
}

Value upload_query_schema(const Atlas&) {
    Value query = schema<TerrainScale>(), required = Value::array();
    for (const char* name : required_of_upload) {
        required.push(name);
        query.find("properties")->find(name)->erase("default");
    }
    return query.set("required", std::move(required));
}

constexpr Route routes[] = {
    {.kind = RouteKind::upload,
     .method = "POST",
     .pattern = "/v1/terrains",
     .id = "post_terrain",
     .summary = "Stores heights for worlds to stand on: a square PNG file, grey of 16 bits, north "
                "up, 17 to 2049 pixels a side, whose first and last pixels lie on its rim. Equal "
                "terrains have one id, which is terrain.id of a world.",
     .media_type = json,
     .body_type = "image/png",
     .success = 201,
     .may_be_stored = true,
     .most_body = most_terrain_bytes,
     .response_schema = "terrain",
     .query_schema = upload_query_schema,
     .plan = plan_upload},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/terrains/{terrain}.json",
     .id = "describe_terrain",
     .summary = "A stored terrain: its size and its heights.",
     .media_type = json,
     .response_schema = "terrain",
     .plan = plan_description},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/terrains/{terrain}.png",
     .id = "get_terrain",
     .summary = "Its heights, as they were sent.",
     .media_type = "image/png",
     .plan = plan_image},
};

void add_schemas(Value& schemas, const Atlas&) {
    const auto number = [](const char* type, const char* description) {
        return object({{"type", type}, {"description", description}});
    };
    schemas.set("terrain",
                objects({{"terrain", number("string", "Its id: terrain.id of a world.")},
                         {"side", number("integer", "Samples along each side.")},
                         {"metres", number("number", "Distance of the first and the last sample.")},
                         {"min", number("number", "Height of black, metres.")},
                         {"max", number("number", "Height of white, metres.")},
                         {"lowest", number("number", "Least of its heights, metres.")},
                         {"highest", number("number", "Greatest of its heights, metres.")},
                         {"links", map_of(typed("string"))}}));
}

}  // namespace

const RouteGroup terrain_routes = {
    .tag = "terrains",
    .description =
        "Terrains of one's own, on which worlds stand; only where the service has a "
        "folder for them.",
    .routes = routes,
    .add_schemas = add_schemas};

}  // namespace sporeprint::api
