#include "api/products/mushrooms.h"

#include "api/products/mix.h"
#include "core/params/canonical.h"
#include "core/params/messages.h"
#include "core/params/query.h"
#include "core/params/reader.h"

namespace sporeprint::api {

MushroomRequest read_mushroom(std::string_view mix, Query query, const Atlas& atlas,
                              ValidationErrors& errors) {
    MushroomRequest request;
    request.spec.mix = read_mix(mix, atlas, errors);
    std::vector<std::pair<std::string, std::string>> rest;
    request.version = take_version(query, rest, errors);
    std::vector<Problem> problems;
    read_query(rest, request.spec.params, problems);
    add_problems(problems, request.spec.params, "", false, errors);
    without_negative_zero(request.spec.params);
    return request;
}

MushroomRequest read_mushroom(std::string_view body, const Atlas& atlas, ValidationErrors& errors) {
    MushroomRequest request;
    std::optional<Value> body_read = read_body(body, errors);
    if (!body_read) return request;
    Value& json = *body_read;
    std::vector<Problem> problems;
    const Value* mix = json.find("mix");
    const Value* model = json.find("model");
    if (mix && model)
        errors.add(400, "mix", "give either mix or model, not both");
    else if (!mix && !model)
        errors.add(400, "mix",
                   "is missing; give {\"mix\":{\"species id\":1}} or a whole {\"model\":{...}}");
    else if (mix)
        request.spec.mix = read_mix_object(*mix, atlas, errors);
    else {
        std::vector<Problem> of_model;
        read(*model, request.spec.model.emplace(), Info{.name = ""}, "/model", of_model);
        // What is left out may be what makes it impossible: an outline without points.
        if (of_model.empty()) check(*request.spec.model, Info{.name = ""}, "/model", of_model);
        add_problems(of_model, *request.spec.model, "/model", true, errors);
    }
    request.version = take_version(json, problems);
    for (const char* taken : {"mix", "model"}) json.erase(taken);
    read(json, request.spec.params, Info{.name = ""}, "", problems);
    add_problems(problems, request.spec.params, "", true, errors);
    without_negative_zero(request.spec.params);
    if (request.spec.model) without_negative_zero(*request.spec.model);
    return request;
}

std::string version_token(const Mix& mix, const Atlas& atlas) {
    std::string templates;
    for (const MixPart& part : mix)
        if (const AtlasEntry* entry = atlas.find(part.id))
            templates += part.id + ' ' + std::to_string(entry->hash) + '\n';
    return token_of(templates);
}

std::string canonical_address(const MushroomSpec& spec, Product product) {
    return with_query("/v1/mushrooms/" + mix_text(spec.mix) + ending_of(product),
                      query_text(spec.params));
}

std::string key_of(const MushroomSpec& spec, Product product, std::string_view version) {
    std::string key = std::string("mushroom") + ending_of(product) + ' ';
    (key += version) += '\n';
    if (spec.model)
        canonical(*spec.model, key);
    else
        key += mix_text(spec.mix);
    for (const Arc& arc : spec.arcs) {
        key += ' ';
        canonical(arc, key);
    }
    key += '\n';
    canonical(spec.params, key);
    return key;
}

std::string file_name(const MushroomSpec& spec, Product product) {
    std::string out;
    for (const MixPart& part : spec.mix) (out += part.id) += '-';
    if (spec.mix.empty()) out = "model-";
    return out + std::to_string(spec.params.seed) + ending_of(product);
}

}  // namespace sporeprint::api
