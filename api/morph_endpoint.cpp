#include <utility>

#include "api/catalogue.h"
#include "api/endpoints.h"
#include "core/grow/species_morph.h"
#include "core/params/reader.h"

namespace sporeprint::api {

namespace {

Value polyline(const std::vector<OutlineSample>& rings) {
    Value points = Value::array();
    for (const OutlineSample& ring : rings) points.push(Value(Value::Array{ring.r, ring.y}));
    return points;
}

Body told(const Context& context, const MorphRequest& asked, const std::string& version,
          Loan& loan) {
    const SpeciesMorph found =
        species_morph(asked.species, asked.params.age, *context.atlas, loan.workshop());
    loan.workshop().observer(Step::pack);
    Value body = Value::object();
    body.set("canonical", canonical_address(asked));
    body.set("v", version);
    body.set("a", asked.species[0]);
    body.set("b", asked.species[1]);
    body.set("age", asked.params.age);
    if (!found.limbs.empty()) {
        body.set("family", name(Family::branched));
        body.set("limbs", write(found.limbs));
        body.set("certificate", write(found.limb_certificate));
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

Plan plan_morph(Context& context, const Request& request, const MorphRequest& asked,
                Faults& faults) {
    if (!faults.empty()) return context.answers.problem(request, faults);
    Resource resource;
    resource.version = version_token(asked.species, *context.atlas);
    resource.address = canonical_address(asked);
    resource.key = key_of(asked, resource.version);
    resource.type = "application/json";
    resource.file_name = asked.species[0] + '-' + asked.species[1] + ".json";
    resource.asked_version = asked.version;
    const bool has_limbs =
        family_of(context.atlas->find(asked.species[0])->species) == Family::branched;
    const Mix both = {{asked.species[0], 500}, {asked.species[1], 500}};
    const Cost cost = Cost{.base = has_limbs ? 1000u : 500u, .bytes = 64u << 10} +
                      cost_of_individuals(both, has_limbs, 1) +
                      cost_of_search(both, *context.atlas);
    resource.weigh = [cost](const Memo&) { return cost; };
    resource.make = [&context, asked, version = resource.version](Loan& loan) {
        return told(context, asked, version, loan);
    };
    return plan_resource(context, request, std::move(resource), faults);
}

}  // namespace sporeprint::api
