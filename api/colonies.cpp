#include "api/colonies.h"

#include "api/mix.h"
#include "core/params/canonical.h"
#include "core/params/query.h"
#include "core/params/reader.h"

namespace sporeprint::api {

ColonyRequest read_colony(std::string_view mix, Query query, const Atlas& atlas, Faults& faults) {
    ColonyRequest request;
    request.order.mix = read_mix(mix, atlas, faults);
    std::vector<std::pair<std::string, std::string>> rest;
    request.version = take_version(query, rest, faults);
    std::vector<Problem> problems;
    read_query(rest, request.order.params, problems);
    add_problems(problems, request.order.params, "", false, faults);
    without_negative_zero(request.order.params);
    return request;
}

ColonyRequest read_colony(std::string_view body, const Atlas& atlas, Faults& faults) {
    ColonyRequest request;
    std::optional<Value> body_read = read_body(body, faults);
    if (!body_read) return request;
    Value& json = *body_read;
    std::vector<Problem> problems;
    if (const Value* mix = json.find("mix"))
        request.order.mix = read_mix_object(*mix, atlas, faults);
    else
        faults.add(400, "mix", "is missing; give {\"mix\":{\"species id\":1}}");
    request.version = take_version(json, problems);
    json.erase("mix");
    read(json, request.order.params, Info{.name = ""}, "", problems);
    add_problems(problems, request.order.params, "", true, faults);
    without_negative_zero(request.order.params);
    return request;
}

std::string canonical_address(const ColonyOrder& order, Product product) {
    return with_query("/v1/colonies/" + mix_text(order.mix) + ending_of(product),
                      query_text(order.params));
}

std::string key_of(const ColonyOrder& order, Product product, std::string_view version) {
    std::string key = std::string("colony") + ending_of(product) + ' ';
    ((key += version) += '\n') += mix_text(order.mix);
    key += '\n';
    canonical(order.params, key);
    return key;
}

std::string file_name(const ColonyOrder& order, Product product) {
    std::string out;
    for (const MixPart& part : order.mix) (out += part.id) += '-';
    return out + "colony-" + std::to_string(order.params.seed) + ending_of(product);
}

}  // namespace sporeprint::api
