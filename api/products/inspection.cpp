#include <utility>

#include "api/http/query.h"
#include "api/http/routes.h"
#include "api/products/endpoints.h"
#include "core/gltf/inspect.h"

namespace sporeprint::api {

namespace {

bool is_address(std::string_view text) {
    std::vector<Problem> problems;
    const Target target = split_target(text, problems);
    return problems.empty() && text.starts_with("/v1/") &&
           match_route("GET", target.segments).route;
}

}  // namespace

Plan plan_inspection(Context& context, const Request& request, ValidationErrors& errors) {
    if (!errors.empty()) return context.responses.problem(request, errors);
    const std::size_t bytes = request.body.size();
    const std::string_view json =
        json_chunk({reinterpret_cast<const std::uint8_t*>(request.body.data()), bytes});
    if (json.size() > most_inspected_json)
        return context.responses.problem(request, 413,
                                         "the JSON chunk of this file has " +
                                             std::to_string(json.size()) + " bytes; at most " +
                                             std::to_string(most_inspected_json) + " are read");
    Cost cost = cost_of_json(json);
    cost.base = 20;
    // The job holds the JSON chunk alone: of an upload of 64 MB the rest is never copied.
    auto run = [json = std::make_shared<const std::string>(json), bytes](
                   const std::stop_token& stop, const Observer& observer, const Parallel&) {
        observer(Step::resolve);
        const Inspection found = inspect_json(*json, stop);
        // A model of one's own, or arcs, have no address.
        if (!found.canonical.empty() &&
            (found.canonical.size() > longest_target || !is_address(found.canonical)))
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
    // Each upload is its own piece of work: a number makes the key, not a hash of up to 64 MB.
    return Job{"inspection " + std::to_string(context.store.inspections++), cost, std::move(run)};
}

}  // namespace sporeprint::api
