#include "api/products/morphs.h"

#include <algorithm>
#include <tuple>

#include "api/products/catalogue.h"
#include "api/products/mix.h"
#include "core/grow/mushroom.h"
#include "core/params/canonical.h"
#include "core/params/messages.h"
#include "core/params/query.h"
#include "core/params/reader.h"

namespace sporeprint::api {

static_assert(well_described<MorphParams>());
static_assert(well_described<MorphSpec>());

namespace {

/// Whether both arcs can hold in one rising map: they lie in the same order on both outlines.
bool agree(const Arc& one, const Arc& other) {
    return one.curve != other.curve || (one.a < other.a && one.b < other.b) ||
           (one.a > other.a && one.b > other.b);
}

/// Whether an arc leads from an end of a sub-curve to where no end is.
bool leaves_end(const Arc& arc) {
    return (arc.a <= 0.0) != (arc.b <= 0.0) || (arc.a >= 1.0) != (arc.b >= 1.0);
}

std::string description(const Arc& arc) {
    return std::string(name(arc.curve)) + ' ' + number_text(arc.a) + " to " + number_text(arc.b);
}

/// Names each arc that crosses another or an end.
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
    const AtlasEntry* first = atlas.find(species[0]);
    const AtlasEntry* second = atlas.find(species[1]);
    if (!first) errors.add(404, "a", unknown_species(a, atlas));
    if (!second) errors.add(404, "b", unknown_species(b, atlas));
    if (!first || !second) return species;
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
    read(*json, spec, Info{.name = ""}, "", problems);
    add_problems(problems, spec, "", true, errors);
    refuse_crossings(spec.arcs, errors);
    without_negative_zero(spec);

    Weights weights;
    if (spec.t < 1.0) weights.emplace_back(species[0], 1.0 - spec.t);
    if (spec.t > 0.0) weights.emplace_back(species[1], spec.t);
    request.spec.mix = canonical_mix(std::move(weights));
    request.spec.params = spec.params;
    if (request.spec.mix.size() < 2) return request;  // a lone species: no arc leads anywhere
    for (Arc arc : spec.arcs) {
        if (arc.a <= 0.0 || arc.a >= 1.0) continue;  // the ends belong together anyway
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

}  // namespace sporeprint::api
