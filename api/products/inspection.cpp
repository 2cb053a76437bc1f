#include "api/products/inspection.h"

#include <utility>

#include "api/http/query.h"
#include "api/http/schemas.h"
#include "api/products/context.h"
#include "core/gltf/inspect.h"

namespace sporeprint::api {

namespace {

bool is_url(const RouteTable& routes, std::string_view text) {
    std::vector<Problem> problems;
    const Target target = split_target(text, problems);
    return problems.empty() && text.starts_with("/v1/") &&
           routes.match("GET", target.segments).route;
}

Plan plan_inspection(RouteCall& call) {
    refuse_query(call.target, call.errors);
    Context& context = call.context;
    const Request& request = call.request;
    const ValidationErrors& errors = call.errors;
    if (!errors.empty()) return context.responses.problem(request, errors);
    const std::size_t bytes = request.body.size();
    const std::string_view json =
        json_chunk({reinterpret_cast<const std::uint8_t*>(request.body.data()), bytes});
    if (json.size() > most_inspected_json)
        return context.responses.problem(request, 413,
                                         "the JSON chunk of this file has " +
                                             std::to_string(json.size()) + " bytes; at most " +
                                             std::to_string(most_inspected_json) + " are read");
    const Cost cost = cost_of_json(json);
    // The job holds only the JSON chunk: the rest of an upload of 64 MB is never copied.
    auto run = [json = std::make_shared<const std::string>(json), bytes, &routes = context.routes](
                   const std::stop_token& stop, const Observer& observer, const Parallel&) {
        observer(Step::resolve);
        const Inspection found = inspect_json(*json, stop);
        // A custom model or arcs have no URL.
        if (!found.canonical.empty() &&
            (found.canonical.size() > longest_target || !is_url(routes, found.canonical)))
            throw InvalidInput(
                "", "the canonical request in this file is not an address of Sporeprint");
        std::vector<Problem> problems;
        Value effective =
            parse(found.effective_json.empty() ? "{}" : found.effective_json, problems);
        if (!problems.empty() || !effective.is_object())
            throw InvalidInput("", "the effective parameters in this file are not JSON");
        Value counts = Value::object();
        counts.set("vertices", found.vertices)
            .set("triangles", found.triangles)
            .set("meshes", found.meshes);
        counts.set("materials", found.materials)
            .set("images", found.images)
            .set("morph_targets", found.morph_targets)
            .set("animations", found.animations)
            .set("bytes", bytes);
        Value body = Value::object();
        body.set("generator", found.generator);
        body.set("canonical", found.canonical.empty() ? Value() : Value(found.canonical));
        body.set("effective", std::move(effective));
        body.set("counts", std::move(counts));
        Response response;
        response.headers = {{"Content-Type", "application/json"}, {"Cache-Control", "no-store"}};
        response.body = {slice_of(dump(body))};
        return response;
    };
    // Each upload is a separate piece of work: its key is a number, not a hash of up to 64 MB.
    return Job{"inspection " + std::to_string(context.store.uploads++), cost, std::move(run)};
}

constexpr Route routes[] = {{.kind = RouteKind::upload,
                             .method = "POST",
                             .pattern = "/v1/inspect",
                             .id = "inspect",
                             .summary = "Reads a GLB of Sporeprint and answers with the request "
                                        "that made it.",
                             .media_type = "application/json",
                             .body_type = "model/gltf-binary",
                             .most_body = 64u << 20,
                             .response_schema = "inspection",
                             .plan = plan_inspection}};

void add_schemas(Value& schemas, const Atlas&) {
    const Value text = typed("string");
    const Value text_or_null =
        object({{"type", Value(Value::Array{"string", "null"})},
                {"description",
                 "The address that makes it again; null for a model or arcs of one's own."}});
    schemas.set("inspection", objects({{"generator", text},
                                       {"canonical", text_or_null},
                                       {"effective", typed("object")},
                                       {"counts", map_of(typed("integer"))}}));
}

}  // namespace

const RouteGroup inspection_routes = {
    .tag = "service", .description = "", .routes = routes, .add_schemas = add_schemas};

}  // namespace sporeprint::api
