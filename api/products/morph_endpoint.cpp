#include <utility>

#include "api/products/catalogue.h"
#include "api/products/endpoints.h"
#include "core/grow/species_morph.h"
#include "core/params/reader.h"

namespace sporeprint::api {

namespace {

Value polyline(const std::vector<OutlineSample>& rings) {
    Value points = Value::array();
    for (const OutlineSample& ring : rings) points.push(Value(Value::Array{ring.r, ring.y}));
    return points;
}

Body description(const Context& context, const MorphRequest& requested, const std::string& version,
                 JobContext& job_context) {
    const SpeciesMorph found = species_morph(requested.species, requested.params.age,
                                             *context.atlas, job_context.execution());
    job_context.execution().observer(Step::pack);
    Value body = Value::object();
    body.set("canonical", canonical_address(requested));
    body.set("v", version);
    body.set("a", requested.species[0]);
    body.set("b", requested.species[1]);
    body.set("age", requested.params.age);
    if (!found.segments.empty()) {
        body.set("family", name(Family::branched));
        body.set("limbs", write(found.segments));
        body.set("certificate", write(found.segment_certificate));
        return {slice_of(dump(body))};
    }
    Value outlines = Value::object();
    for (std::size_t side = 0; side < 2; ++side) {
        Value outline = Value::object();
        for (const CurveName curve : curve_names)
            outline.set(name(curve),
                        polyline(found.outlines[side][static_cast<std::size_t>(curve)]));
        outlines.set(side == 0 ? "a" : "b", std::move(outline));
    }
    body.set("family", name(Family::swept));
    body.set("outlines", std::move(outlines));
    body.set("arcs", write(found.arcs));
    body.set("certificate", write(found.certificate));
    return {slice_of(dump(body))};
}

}  // namespace

Plan plan_morph(Context& context, const Request& request, const MorphRequest& requested,
                ValidationErrors& errors) {
    if (!errors.empty()) return context.responses.problem(request, errors);
    Resource resource;
    resource.version = version_token(requested.species, *context.atlas);
    resource.address = canonical_address(requested);
    resource.key = key_of(requested, resource.version);
    resource.type = "application/json";
    resource.file_name = requested.species[0] + '-' + requested.species[1] + ".json";
    resource.requested_version = requested.version;
    const bool has_segments =
        family_of(context.atlas->find(requested.species[0])->species) == Family::branched;
    const Mix both = {{requested.species[0], 500}, {requested.species[1], 500}};
    const Cost cost = Cost{.base = has_segments ? 1000u : 500u, .bytes = 64u << 10} +
                      cost_of_individuals(both, has_segments, 1) +
                      cost_of_search(both, *context.atlas);
    resource.estimate_cost = [cost](const Caches&) { return cost; };
    resource.make = [&context, requested, version = resource.version](JobContext& job_context) {
        return description(context, requested, version, job_context);
    };
    return plan_resource(context, request, std::move(resource), errors);
}

}  // namespace sporeprint::api
