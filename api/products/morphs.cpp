#include "api/products/morphs.h"

#include <algorithm>
#include <tuple>

#include "api/http/schemas.h"
#include "api/products/catalogue.h"
#include "api/products/mix.h"
#include "api/products/plan_product.h"
#include "core/grow/mushroom.h"
#include "core/grow/species_morph.h"
#include "core/params/canonical.h"
#include "core/params/messages.h"
#include "core/params/query.h"
#include "core/params/reader.h"
#include "core/params/schema.h"

namespace sporeprint::api {

static_assert(well_described<MorphParams>());
static_assert(well_described<MorphSpec>());

namespace {

/// Returns true if one monotone map can contain both arcs: their order is the same on both
/// outlines.
bool agree(const Arc& one, const Arc& other) {
    return one.curve != other.curve || (one.a < other.a && one.b < other.b) ||
           (one.a > other.a && one.b > other.b);
}

/// Returns true if an arc connects an end of a sub-curve with a point that is no end.
bool leaves_end(const Arc& arc) {
    return (arc.a <= 0.0) != (arc.b <= 0.0) || (arc.a >= 1.0) != (arc.b >= 1.0);
}

std::string description(const Arc& arc) {
    return std::string(name(arc.curve)) + ' ' + number_text(arc.a) + " to " + number_text(arc.b);
}

/// Adds an error for each arc that crosses another one or an end.
void refuse_crossings(const std::vector<Arc>& arcs, ValidationErrors& errors) {
    for (std::size_t i = 0; i < arcs.size(); ++i) {
        const std::string path = "/arcs/" + std::to_string(i);
        if (leaves_end(arcs[i])) {
            errors.add(422, path,
                       "the arc " + description(arcs[i]) +
                           " parts the ends of the two curves, which belong together");
            continue;
        }
        for (std::size_t k = 0; k < arcs.size(); ++k) {
            if (k == i || agree(arcs[i], arcs[k])) continue;
            errors.add(422, path,
                       "the arc " + description(arcs[i]) + " crosses /arcs/" + std::to_string(k) +
                           ", " + description(arcs[k]));
            break;
        }
    }
}

}  // namespace

SpeciesPair read_pair(std::string_view a, std::string_view b, const Atlas& atlas,
                      ValidationErrors& errors) {
    SpeciesPair species = {std::string(a), std::string(b)};
    const AtlasEntry* first = find_species(species[0], atlas);
    const AtlasEntry* second = find_species(species[1], atlas);
    if (!first) errors.add(404, "a", unknown_species(a, atlas));
    if (!second) errors.add(404, "b", unknown_species(b, atlas));
    if (!first || !second) return species;
    species = {first->species.id.string(), second->species.id.string()};
    if (first == second)
        errors.add(
            422, "b",
            in_quotes(b) + " cannot be morphed into itself; name two species. Its growth is age");
    const Family family = family_of(first->species), other = family_of(second->species);
    if (family != other)
        errors.add(422, "b",
                   in_quotes(b) + " is " + name(other) + " and " + in_quotes(a) + " is " +
                       name(family) + "; only species of one family can be morphed");
    return species;
}

MorphRequest read_morph(SpeciesPair species, Query query, ValidationErrors& errors) {
    MorphRequest request;
    request.species = std::move(species);
    std::vector<std::pair<std::string, std::string>> rest;
    request.version = take_version(query, rest, errors);
    std::vector<Problem> problems;
    read_query(rest, request.params, problems);
    errors.add(400, problems);
    request.params.age += 0.0;  // -0 is 0
    return request;
}

MushroomRequest read_morph(const SpeciesPair& species, std::string_view body,
                           ValidationErrors& errors) {
    MushroomRequest request;
    std::optional<Value> json = read_body(body, errors);
    if (!json) return request;
    std::vector<Problem> problems;
    request.version = take_version(*json, problems);
    MorphSpec spec;
    apply_profile(requested_profile(*json), spec.params);
    read(*json, spec, Info{.name = ""}, "", problems);
    drop_excluded_defaults(spec.params, named_options(*json));
    add_problems(problems, spec, "", true, errors);
    refuse_crossings(spec.arcs, errors);
    without_negative_zero(spec);

    Weights weights;
    if (spec.t < 1.0) weights.emplace_back(species[0], 1.0 - spec.t);
    if (spec.t > 0.0) weights.emplace_back(species[1], spec.t);
    request.spec.mix = canonical_mix(std::move(weights));
    request.spec.params = spec.params;
    request.spec.params.drop_equal_seeds();
    if (request.spec.mix.size() < 2) return request;  // arcs have no meaning for a single species
    for (Arc arc : spec.arcs) {
        if (arc.a <= 0.0 || arc.a >= 1.0) continue;  // ends always correspond
        if (species[1] < species[0]) std::swap(arc.a, arc.b);
        request.spec.arcs.push_back(arc);
    }
    std::sort(request.spec.arcs.begin(), request.spec.arcs.end(),
              [](const Arc& one, const Arc& other) {
                  return std::tie(one.curve, one.a) < std::tie(other.curve, other.a);
              });
    return request;
}

std::string canonical_address(const MorphRequest& request) {
    return with_query("/v1/morphs/" + request.species[0] + '/' + request.species[1],
                      query_text(request.params));
}

std::string version_token(const SpeciesPair& species, const Atlas& atlas) {
    return version_token(canonical_mix({{species[0], 1.0}, {species[1], 1.0}}), atlas);
}

std::string key_of(const MorphRequest& request, std::string_view version) {
    std::string key = "morph.json ";
    ((key += version) += '\n') += request.species[0];
    ((key += ' ') += request.species[1]) += '\n';
    canonical(request.params, key);
    return key;
}

namespace {

Value polyline(const std::vector<OutlineSample>& rings) {
    Value points = Value::array();
    for (const OutlineSample& ring : rings) points.push(Value(Value::Array{ring.r, ring.y}));
    return points;
}

Body morph_description(const Context& context, const MorphRequest& requested,
                       const std::string& version, JobContext& job_context) {
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

Plan plan_from_url(RouteCall& call) {
    Context& context = call.context;
    const Request& request = call.request;
    ValidationErrors& errors = call.errors;
    const MorphRequest requested =
        read_morph(read_pair(call.captured[0], call.captured[1], *context.atlas, errors),
                   call.target.query, errors);
    if (!errors.empty()) return context.responses.problem(request, errors);
    Resource resource;
    resource.version = version_token(requested.species, *context.atlas);
    resource.address = with_version(canonical_address(requested), resource.version);
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
        return morph_description(context, requested, version, job_context);
    };
    return plan_resource(context, request, std::move(resource), errors);
}

Plan plan_from_body(RouteCall& call) {
    refuse_query(call.target, call.errors);
    const SpeciesPair pair =
        read_pair(call.captured[0], call.captured[1], *call.context.atlas, call.errors);
    return plan_product<Mushrooms>(call.context, call.request,
                                   read_morph(pair, call.request.body, call.errors), call.errors);
}

constexpr const char* json = "application/json";

constexpr Route routes[] = {
    {.kind = RouteKind::product,
     .method = "POST",
     .pattern = "/v1/morphs/{a}/{b}.glb",
     .id = "post_morph",
     .summary = "Grows a mushroom between two species, with your own arcs from one outline to the "
                "other.",
     .media_type = "model/gltf-binary",
     .body_type = json,
     .request_body = "morph_order",
     .plan = plan_from_body},
    {.kind = RouteKind::product,
     .method = "GET",
     .pattern = "/v1/morphs/{a}/{b}",
     .id = "get_morph",
     .summary = "Correspondence of two species: both outlines, what of one becomes what of the "
                "other, and whether any morph between them crosses itself; of two that branch the "
                "limbs of both, fork on fork.",
     .media_type = json,
     .response_schema = "morph",
     .query_schema = [](const Atlas&) { return schema<MorphParams>(); },
     .plan = plan_from_url},
};

void add_links(Value& links, const Atlas& atlas) {
    if (atlas.entries().size() > 1)  // an example of two species
        links.set("morph", "/v1/morphs/" + atlas.entries()[0].species.id.string() + '/' +
                               atlas.entries()[1].species.id.string());
}

Value morph_schema() {
    Value polyline = list_of(
        object({{"type", "array"}, {"items", typed("number")}, {"minItems", 2}, {"maxItems", 2}}));
    polyline.set("description",
                 "Points [r, y] in metres from base to apex. Point k of one species becomes point "
                 "k of the other.");
    const Value outline =
        objects({{"stem", polyline}, {"hymenium", polyline}, {"cap", std::move(polyline)}});
    Value arcs = list_of(as_written(schema<Arc>()));
    arcs.set("description", "Some of the pairs as shares of arc length, landmarks among them.");
    Value segments = list_of(as_written(schema<SegmentPair>()));
    segments.set(
        "description",
        "The limbs of both, fork on fork: entry k of one species becomes entry k of the other. "
        "Each as its template is, branching as that of seed 1.");
    const auto response = [&](Family family, std::initializer_list<Value::Member> correspondence) {
        Value out = objects({{"canonical", typed("string")},
                             {"v", typed("string")},
                             {"a", typed("string")},
                             {"b", typed("string")},
                             {"age", typed("number")},
                             {"family", object({{"const", name(family)}})}});
        for (const auto& [key, value] : correspondence) {
            out.find("properties")->set(key, value);
            out.find("required")->push(key);
        }
        return out;
    };
    return object(
        {{"oneOf",
          Value(Value::Array{
              response(Family::swept, {{"outlines", objects({{"a", outline}, {"b", outline}})},
                                       {"arcs", arcs},
                                       {"certificate", reference("schemas/certificate")}}),
              response(Family::branched,
                       {{"limbs", segments},
                        {"certificate", as_written(schema<SegmentCertificate>())}})})}});
}

void add_schemas(Value& schemas, const Atlas&) { schemas.set("morph", morph_schema()); }

void add_bodies(Value& bodies, const Atlas&) {
    Value spec = schema<MorphSpec>();
    spec.find("properties")->set("v", version_member());
    bodies.set(
        "morph_order",
        json_body(
            "How far from the first species to the second, and arcs of your own.", std::move(spec),
            object({{"t", 0.4},
                    {"arcs", Value(Value::Array{object(
                                 {{"curve", name(CurveName::cap)}, {"a", 0.25}, {"b", 0.4}})})},
                    {"age", 0.6}})));
}

}  // namespace

const RouteGroup morph_routes = {.tag = "morphs",
                                 .description = "What lies between two species.",
                                 .routes = routes,
                                 .add_links = add_links,
                                 .add_schemas = add_schemas,
                                 .add_bodies = add_bodies};

}  // namespace sporeprint::api
