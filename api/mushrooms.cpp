#include "api/mushrooms.h"

#include "api/mix.h"
#include "core/params/canonical.h"
#include "core/params/messages.h"
#include "core/params/query.h"
#include "core/params/reader.h"

namespace sporeprint::api {

MushroomRequest read_mushroom(std::string_view mix, Query query, const Atlas& atlas,
                              Faults& faults) {
    MushroomRequest request;
    request.order.mix = read_mix(mix, atlas, faults);
    std::vector<std::pair<std::string, std::string>> rest;
    request.version = take_version(query, rest, faults);
    std::vector<Problem> problems;
    read_query(rest, request.order.params, problems);
    add_problems(problems, request.order.params, "", false, faults);
    without_negative_zero(request.order.params);
    return request;
}

MushroomRequest read_mushroom(std::string_view body, const Atlas& atlas, Faults& faults) {
    MushroomRequest request;
    std::optional<Value> body_read = read_body(body, faults);
    if (!body_read) return request;
    Value& json = *body_read;
    std::vector<Problem> problems;
    const Value* mix = json.find("mix");
    const Value* model = json.find("model");
    if (mix && model)
        faults.add(400, "mix", "give either mix or model, not both");
    else if (!mix && !model)
        faults.add(400, "mix",
                   "is missing; give {\"mix\":{\"species id\":1}} or a whole {\"model\":{...}}");
    else if (mix)
        request.order.mix = read_mix_object(*mix, atlas, faults);
    else {
        std::vector<Problem> of_model;
        read(*model, request.order.model.emplace(), Info{.name = ""}, "/model", of_model);
        // What is left out may be what makes it impossible: an outline without points.
        if (of_model.empty()) check(*request.order.model, Info{.name = ""}, "/model", of_model);
        add_problems(of_model, *request.order.model, "/model", true, faults);
    }
    request.version = take_version(json, problems);
    for (const char* taken : {"mix", "model"}) json.erase(taken);
    read(json, request.order.params, Info{.name = ""}, "", problems);
    add_problems(problems, request.order.params, "", true, faults);
    without_negative_zero(request.order.params);
    if (request.order.model) without_negative_zero(*request.order.model);
    return request;
}

std::string version_token(const Mix& mix, const Atlas& atlas) {
    std::string templates;
    for (const MixPart& part : mix)
        if (const AtlasEntry* entry = atlas.find(part.id))
            templates += part.id + ' ' + std::to_string(entry->hash) + '\n';
    return token_of(templates);
}

std::string canonical_address(const MushroomOrder& order, Product product) {
    return with_query("/v1/mushrooms/" + mix_text(order.mix) + ending_of(product),
                      query_text(order.params));
}

std::string key_of(const MushroomOrder& order, Product product, std::string_view version) {
    std::string key = std::string("mushroom") + ending_of(product) + ' ';
    (key += version) += '\n';
    if (order.model)
        canonical(*order.model, key);
    else
        key += mix_text(order.mix);
    for (const Arc& arc : order.arcs) {
        key += ' ';
        canonical(arc, key);
    }
    key += '\n';
    canonical(order.params, key);
    return key;
}

std::string file_name(const MushroomOrder& order, Product product) {
    std::string out;
    for (const MixPart& part : order.mix) (out += part.id) += '-';
    if (order.mix.empty()) out = "model-";
    return out + std::to_string(order.params.seed) + ending_of(product);
}

}  // namespace sporeprint::api
