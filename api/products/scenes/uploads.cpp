#include "api/products/scenes/uploads.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "api/http/schemas.h"
#include "api/products/product.h"
#include "api/products/resource.h"
#include "core/gltf/inspect.h"
#include "core/params/messages.h"
#include "core/params/query.h"
#include "core/scene/scene_file.h"
#include "core/scene/scene_store.h"

namespace sporeprint::api {

namespace {

constexpr const char* json = "application/json";

/// Returns the cost of reading a file of so many bytes.
Cost cost_of_reading(std::size_t bytes) { return {.base = 3'000 + bytes / 40}; }

Value place_value(const glm::vec3& at) {
    return Value(Value::Array{static_cast<double>(at.x), static_cast<double>(at.y),
                              static_cast<double>(at.z)});
}

/// Returns what is known of a scene.
Value described(const Scene& scene, const std::string& id, const Atlas& atlas,
                const ResponseBuilder& responses) {
    const std::vector<std::string> kinds = tree_kinds(atlas);
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    std::vector<std::size_t> triangles(scene.materials.size(), 0);
    for (const SceneTriangle& triangle : scene.triangles) {
        ++triangles[triangle.material];
        for (const std::uint32_t corner : triangle.corners) {
            low = glm::min(low, scene.positions[corner]);
            high = glm::max(high, scene.positions[corner]);
        }
    }
    Value materials = Value::array();
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        if (triangles[i] == 0) continue;
        const MaterialSoil soil = guessed_soil(scene.materials[i], kinds);
        Value trees = Value::array();
        for (std::size_t k = 0; k < kinds.size(); ++k)
            if (soil.trees != all_trees && (soil.trees >> k & 1U) != 0) trees.push(kinds[k]);
        materials.push(Value::object()
                           .set("name", scene.materials[i])
                           .set("triangles", triangles[i])
                           .set("substrate", name(soil.soil))
                           .set("trees", std::move(trees)));
    }
    const std::string fungi = path_of_scene(id) + "/beech/y80d270/";
    return Value::object()
        .set("scene", id)
        .set("triangles", scene.triangles.size())
        .set("vertices", scene.positions.size())
        .set("bounds_m", Value::object().set("min", place_value(low)).set("max", place_value(high)))
        .set("materials", std::move(materials))
        .set("links", Value::object()
                          .set("self", responses.link(path_of_scene(id) + ".json"))
                          .set("fungi", responses.link(fungi + "fungi.glb"))
                          .set("placements", responses.link(fungi + "placements.json")));
}

}  // namespace

std::string path_of_scene(const std::string& id) { return folder_of("scenes") + id; }

SceneCaches scene_caches(Store& store, const ExecutionContext& execution) {
    SceneCaches caches;
    caches.scene = [&store](std::string_view id) { return stored_scene(store, id); };
    caches.shapes = [&store, stop = execution.stop](const std::string& key, const auto& make) {
        return shape_in(store, key, make, stop);
    };
    caches.fungi = [&store, stop = execution.stop](const std::string& key, const auto& make) {
        return fungi_in(store, key, make, stop);
    };
    return caches;
}

void check_scene(const std::string& id, const Context& context, ValidationErrors& errors) {
    if (is_scene_id(id) && context.store.scenes && context.store.scenes->holds(id)) return;
    errors.add(
        404, "scene",
        "there is no scene " + in_quotes(id) + ", or no longer; upload it to /v1/scenes again");
}

Plan plan_scene_upload(RouteCall& call) {
    Context& context = call.context;
    const Request& request = call.request;
    refuse_query(call.target, call.errors);
    if (!context.store.scenes)
        call.errors.add(422, "",
                        "this service stores no scenes; its operator can give it a --store");
    const std::span<const std::uint8_t> file(
        reinterpret_cast<const std::uint8_t*>(request.body.data()), request.body.size());
    if (call.errors.empty()) {
        // What is no GLB at all needs no job.
        try {
            static_cast<void>(json_chunk(file));
        } catch (const InvalidInput& refused) {
            call.errors.add(422, refused.problems());
        }
    }
    if (!call.errors.empty()) return context.responses.problem(request, call.errors);
    auto run = [sent = std::make_shared<const Bytes>(file.begin(), file.end()),
                &store = context.store, &responses = context.responses, atlas = context.atlas](
                   const std::stop_token& stop, const Observer& observer, const Parallel&) {
        observer(Step::resolve);
        Scene scene;
        try {
            scene = scene_in_glb(*sent);
        } catch (const InvalidInput& refused) {
            throw Impossible(refused.problems());
        }
        if (stop.stop_requested()) throw Cancelled();
        observer(Step::pack);
        const std::string id = id_of(scene);
        const bool is_known = store.scenes->holds(id);
        if (!store.scenes->insert(id, {Slice(std::make_shared<const Bytes>(file_of(scene)))}))
            throw GenerationError("a scene could not be written to the store");
        Response response =
            private_json(described(scene, id, *atlas, responses), is_known ? 200 : 201);
        set_header(response, "Location", responses.link(path_of_scene(id) + ".json"));
        return response;
    };
    // Each upload is a piece of work of its own: its key is a number, not a hash of up to 32 MB.
    return Job{"scene upload " + std::to_string(context.store.uploads++),
               cost_of_reading(file.size()), std::move(run)};
}

Plan plan_scene_description(RouteCall& call) {
    Context& context = call.context;
    const std::string& id = call.captured[0];
    std::vector<std::pair<std::string, std::string>> rest;
    Resource resource;
    resource.requested_version = take_version(call.target.query, rest, call.errors);
    std::vector<Problem> problems;
    QueryReader(rest, problems).refuse_the_rest();
    call.errors.add(400, problems);
    check_scene(id, context, call.errors);
    if (!call.errors.empty()) return context.responses.problem(call.request, call.errors);
    resource.version = token_of(id);
    resource.key = "scene " + id + ".json " + resource.version;
    resource.type = json;
    resource.address = with_version(path_of_scene(id) + ".json", resource.version);
    resource.file_name = id + ".json";
    resource.estimate_cost = [](const Caches&) { return Cost{.base = 10'000}; };
    resource.make = [id, &context, atlas = context.atlas](JobContext& job) {
        job.execution().observer(Step::resolve);
        const SharedScene scene = stored_scene(context.store, id);
        if (!scene)
            throw InvalidInput(
                "scene", "there is no scene " + id + " any more; upload it to /v1/scenes again");
        job.execution().observer(Step::pack);
        return Body{slice_of(dump(described(*scene, id, *atlas, context.responses)))};
    };
    return plan_resource(context, call.request, std::move(resource), call.errors);
}

Value scene_schema() {
    const Value text = typed("string"), whole = typed("integer"),
                numbers = list_of(typed("number"));
    return objects({{"scene", text},
                    {"triangles", whole},
                    {"vertices", whole},
                    {"bounds_m", objects({{"min", numbers}, {"max", numbers}})},
                    {"materials", list_of(objects({{"name", text},
                                                   {"triangles", whole},
                                                   {"substrate", text},
                                                   {"trees", list_of(text)}}))},
                    {"links", map_of(text)}});
}

}  // namespace sporeprint::api
