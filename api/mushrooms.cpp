#include "api/mushrooms.h"

#include <algorithm>

#include "api/encoding.h"
#include "api/mix.h"
#include "core/grow/mushroom.h"
#include "core/params/canonical.h"
#include "core/params/messages.h"
#include "core/params/query.h"
#include "core/params/reader.h"

namespace sporeprint::api {

std::optional<std::string> take_version(std::span<const std::pair<std::string, std::string>> query,
                                        std::vector<std::pair<std::string, std::string>>& rest,
                                        Faults& faults) {
    std::optional<std::string> version;
    for (const auto& pair : query) {
        if (pair.first != "v")
            rest.push_back(pair);
        else if (version)
            faults.add(400, "v", "given more than once");
        else
            version = pair.second;
    }
    return version;
}

std::optional<std::string> take_version(Value& body, std::vector<Problem>& problems) {
    std::optional<std::string> version;
    if (const Value* given = body.find("v")) {
        if (given->is_string())
            version = given->as_string();
        else
            report(problems, "/v", "expected text, got " + shown(*given));
    }
    body.erase("v");
    return version;
}

MushroomRequest read_mushroom(std::string_view mix,
                              std::span<const std::pair<std::string, std::string>> query,
                              const Atlas& atlas, Faults& faults) {
    MushroomRequest request;
    request.order.mix = read_mix(mix, atlas, faults);
    std::vector<std::pair<std::string, std::string>> rest;
    request.version = take_version(query, rest, faults);
    std::vector<Problem> problems;
    read_query(rest, request.order.params, problems);
    faults.add(400, problems);
    without_negative_zero(request.order.params);
    return request;
}

MushroomRequest read_mushroom(std::string_view body, const Atlas& atlas, Faults& faults) {
    MushroomRequest request;
    std::vector<Problem> problems;
    Value json = parse(body, problems);
    if (!problems.empty()) {
        faults.add(400, problems);
        return request;
    }
    if (!json.is_object()) {
        faults.add(400, "", "expected an object, got " + shown(json));
        return request;
    }
    const Value* mix = json.find("mix");
    const Value* model = json.find("model");
    if (mix && model)
        faults.add(400, "mix", "give either mix or model, not both");
    else if (!mix && !model)
        faults.add(400, "mix",
                   "is missing; give {\"mix\":{\"species id\":1}} or a whole {\"model\":{...}}");
    else if (mix)
        request.order.mix = read_mix_object(*mix, atlas, faults);
    else
        read(*model, request.order.model.emplace(), Info{.name = ""}, "/model", problems);
    request.version = take_version(json, problems);
    for (const char* taken : {"mix", "model"}) json.erase(taken);
    read(json, request.order.params, Info{.name = ""}, "", problems);
    faults.add(400, problems);
    without_negative_zero(request.order.params);
    if (request.order.model) without_negative_zero(*request.order.model);
    return request;
}

std::string version_token(const Mix& mix, const Atlas& atlas) {
    std::string templates;
    for (const MixPart& part : mix)
        if (const AtlasEntry* entry = atlas.find(part.id))
            templates += part.id + ' ' + std::to_string(entry->hash) + '\n';
    return std::to_string(generator_version) + '-' + digest_of(templates).substr(0, 8);
}

std::string canonical_address(const MushroomOrder& order, Product product) {
    std::string address =
        "/v1/mushrooms/" + mix_text(order.mix) + (product == Product::glb ? ".glb" : ".json");
    const std::string query = query_text(order.params);
    return query.empty() ? address : address + '?' + query;
}

std::string with_version(std::string address, std::string_view version) {
    address += address.find('?') == std::string::npos ? '?' : '&';
    return (address += "v=") += version;
}

std::string key_of(const MushroomOrder& order, Product product, std::string_view version) {
    std::string key = product == Product::glb ? "mushroom.glb " : "mushroom.json ";
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
    return out + std::to_string(order.params.seed) + (product == Product::glb ? ".glb" : ".json");
}

}  // namespace sporeprint::api
