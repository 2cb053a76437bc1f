#include <utility>

#include "api/endpoints.h"
#include "api/query.h"
#include "api/routes.h"
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

Plan plan_inspection(Context& context, const Request& request, Faults& faults) {
    if (!faults.empty()) return context.answers.problem(request, faults);
    auto file = std::make_shared<const std::string>(request.body);
    const std::size_t bytes = file->size();
    auto run = [file](std::stop_token, const Observer& observer, const Parallel&) {
        observer(Step::resolve);
        const Inspection found =
            inspect_glb({reinterpret_cast<const std::uint8_t*>(file->data()), file->size()});
        // A model of one's own, or arcs, have no address.
        if (!found.canonical.empty() && !is_address(found.canonical))
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
            .set("bytes", found.bytes);
        Value body = Value::object();
        body.set("generator", found.generator);
        body.set("canonical", found.canonical.empty() ? Value() : Value(found.canonical));
        body.set("effective", std::move(effective));
        body.set("counts", std::move(counts));
        Answer answer;
        answer.headers = {{"Content-Type", "application/json"}, {"Cache-Control", "no-store"}};
        answer.body = {slice_of(dump(body))};
        return answer;
    };
    // Each upload is its own piece of work: a number makes the key, not a hash of up to 64 MB.
    return Job{"inspection " + std::to_string(context.store.inspections++), Cost{0, 0, bytes},
               std::move(run)};
}

}  // namespace sporeprint::api
