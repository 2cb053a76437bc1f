#include "api/products/mix.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "api/http/schemas.h"
#include "api/http/text.h"
#include "api/library/names.h"
#include "core/params/messages.h"

namespace sporeprint::api {

namespace {

/// Reads a number in JSON's grammar, without white space around it. Returns false for other text.
bool number_of(std::string_view text, double& number) {
    if (text.empty() || text.find_first_not_of("+-.0123456789eE") != std::string_view::npos)
        return false;
    std::vector<Problem> problems;
    const Value value = parse(text, problems);
    if (!problems.empty() || !value.is_number()) return false;
    number = value.as_number();
    return true;
}

/// Replaces names of species by their ids.
///
/// throws  SpeciesOfLibrary
void find_species(Weights& weights, const Atlas& atlas) {
    std::vector<std::string> to_load;
    for (auto& [id, weight] : weights)
        if (const AtlasEntry* const entry = atlas.find(id))
            id = entry->species.id.string();
        else if (is_of_library(id))
            to_load.push_back(id);
    if (!to_load.empty()) throw SpeciesOfLibrary(std::move(to_load));
}

/// Checks ids and weights, which is common to both notations, and returns the canonical form.
Mix checked(Weights weights, const Atlas& atlas, ValidationErrors& errors, bool clean) {
    if (weights.size() > most_species) {
        errors.add(400, "mix",
                   std::to_string(weights.size()) + " species; at most " +
                       std::to_string(most_species) + " can be mixed");
        return {};
    }
    find_species(weights, atlas);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const std::string& id = weights[i].first;
        const double weight = weights[i].second;
        const bool repeated =
            std::any_of(weights.begin(), weights.begin() + static_cast<std::ptrdiff_t>(i),
                        [&](const auto& other) { return other.first == id; });
        if (repeated) {
            errors.add(400, "mix", in_quotes(id) + " is named twice");
            clean = false;
        } else if (!atlas.find(id)) {
            errors.add(404, "mix", unknown_species(id, atlas));
            clean = false;
        }
        if (!(weight > 0.0)) {
            errors.add(400, "mix",
                       "the weight of " + in_quotes(id) + " is " + number_text(weight) +
                           "; weights are greater than 0");
            clean = false;
        }
    }
    return clean && !weights.empty() ? canonical_mix(std::move(weights)) : Mix{};
}

}  // namespace

const AtlasEntry* find_species(std::string_view id, const Atlas& atlas) {
    const AtlasEntry* const entry = atlas.find(id);
    if (!entry && is_of_library(id)) throw SpeciesOfLibrary({std::string(id)});
    return entry;
}

std::string unknown_species(std::string_view id, const Atlas& atlas) {
    std::vector<std::string> ids;
    for (const AtlasEntry& entry : atlas.entries()) ids.push_back(entry.species.id.string());
    std::string out = "unknown species " + in_quotes(id);
    const std::string_view meant = closest(id, ids);
    if (!meant.empty()) return out + "; did you mean " + in_quotes(meant) + "?";
    // For a genus alone, or another spelling, suggest the species whose id begins with it.
    for (const std::string& known : ids)
        if (id.size() >= 3 && known.starts_with(lower(id)))
            return out + "; did you mean " + in_quotes(known) + "?";
    return out + "; /v1/species lists all that there are";
}

Mix read_mix(std::string_view text, const Atlas& atlas, ValidationErrors& errors) {
    Weights weights;
    bool clean = true;
    std::size_t parts = 1 + static_cast<std::size_t>(std::count(text.begin(), text.end(), ','));
    if (parts > most_species) {
        errors.add(400, "mix",
                   std::to_string(parts) + " species; at most " + std::to_string(most_species) +
                       " can be mixed");
        return {};
    }
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string_view part = text.substr(begin, end - begin);
        begin = end + 1;
        const std::size_t colon = part.find(':');
        const std::string id(part.substr(0, colon));
        double weight = 1.0;
        if (id.empty()) {
            errors.add(400, "mix", "a species is missing; write id or id:weight,id:weight");
            clean = false;
            continue;
        }
        if (colon == std::string_view::npos) {
            if (parts > 1) {
                errors.add(
                    400, "mix",
                    in_quotes(id) +
                        " has no weight; in a mix each species has one, as in id:0.7,id:0.3");
                clean = false;
            }
        } else if (!number_of(part.substr(colon + 1), weight)) {
            errors.add(400, "mix",
                       "the weight of " + in_quotes(id) + " is " +
                           in_quotes(part.substr(colon + 1)) + ", which is not a number");
            clean = false;
            weight = 1.0;
        }
        weights.emplace_back(id, weight);
    }
    return checked(std::move(weights), atlas, errors, clean);
}

Mix read_mix_object(const Value& json, const Atlas& atlas, ValidationErrors& errors) {
    if (!json.is_object() || json.members().empty()) {
        errors.add(
            400, "mix",
            "expected an object of species and weights, as in {\"amanita_muscaria\":1}, got " +
                shown(json));
        return {};
    }
    Weights weights;
    bool clean = true;
    for (const auto& [id, weight] : json.members()) {
        if (!weight.is_number()) {
            errors.add(400, "mix",
                       "the weight of " + in_quotes(id) + " is " + shown(weight) +
                           ", which is not a number");
            clean = false;
        }
        weights.emplace_back(id, weight.is_number() ? weight.as_number() : 1.0);
    }
    return checked(std::move(weights), atlas, errors, clean);
}

Value mix_value(const Mix& mix) {
    Value list = Value::array();
    for (const MixPart& part : mix)
        list.push(Value::object().set("id", part.id).set("weight", part.weight / 1000.0));
    return list;
}

Value mix_schema() {
    return object({{"type", "object"},
                   {"minProperties", 1},
                   {"maxProperties", most_species},
                   {"additionalProperties", object({{"type", "number"}, {"exclusiveMinimum", 0}})},
                   {"description", "Species ids and their weights."}});
}

Value mix_list_schema() {
    return list_of(objects({{"id", typed("string")}, {"weight", typed("number")}}));
}

}  // namespace sporeprint::api
