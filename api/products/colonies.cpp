#include "api/products/colonies.h"

#include "api/products/mix.h"
#include "core/params/canonical.h"
#include "core/params/query.h"
#include "core/params/reader.h"

namespace sporeprint::api {

ColonyRequest read_colony(std::string_view mix, Query query, const Atlas& atlas,
                          ValidationErrors& errors) {
    ColonyRequest request;
    request.spec.mix = read_mix(mix, atlas, errors);
    std::vector<std::pair<std::string, std::string>> rest;
    request.version = take_version(query, rest, errors);
    std::vector<Problem> problems;
    read_query(rest, request.spec.params, problems);
    add_problems(problems, request.spec.params, "", false, errors);
    without_negative_zero(request.spec.params);
    return request;
}

ColonyRequest read_colony(std::string_view body, const Atlas& atlas, ValidationErrors& errors) {
    ColonyRequest request;
    std::optional<Value> body_read = read_body(body, errors);
    if (!body_read) return request;
    Value& json = *body_read;
    std::vector<Problem> problems;
    if (const Value* mix = json.find("mix"))
        request.spec.mix = read_mix_object(*mix, atlas, errors);
    else
        errors.add(400, "mix", "is missing; give {\"mix\":{\"species id\":1}}");
    request.version = take_version(json, problems);
    json.erase("mix");
    read(json, request.spec.params, Info{.name = ""}, "", problems);
    add_problems(problems, request.spec.params, "", true, errors);
    without_negative_zero(request.spec.params);
    return request;
}

std::string canonical_address(const ColonySpec& spec, Product product) {
    return with_query("/v1/colonies/" + mix_text(spec.mix) + ending_of(product),
                      query_text(spec.params));
}

std::string key_of(const ColonySpec& spec, Product product, std::string_view version) {
    std::string key = std::string("colony") + ending_of(product) + ' ';
    ((key += version) += '\n') += mix_text(spec.mix);
    key += '\n';
    canonical(spec.params, key);
    return key;
}

std::string file_name(const ColonySpec& spec, Product product) {
    std::string out;
    for (const MixPart& part : spec.mix) (out += part.id) += '-';
    return out + "colony-" + std::to_string(spec.params.seed) + ending_of(product);
}

}  // namespace sporeprint::api
