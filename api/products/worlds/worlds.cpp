#include "api/products/worlds/worlds.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "api/products/mix.h"
#include "api/products/presets.h"
#include "api/products/resource.h"
#include "core/params/canonical.h"
#include "core/params/query.h"
#include "core/params/schema.h"

namespace sporeprint::api {

namespace {

constexpr const char* json = "application/json";

using Pairs = std::vector<std::pair<std::string, std::string>>;

/// Returns the pairs behind the preset of a world's text. A part without '=' is an error.
Pairs pairs_of(std::string_view text, ValidationErrors& errors) {
    Pairs pairs;
    while (!text.empty()) {
        text.remove_prefix(1);  // the comma
        const std::string_view part = text.substr(0, text.find(','));
        const std::size_t equals = part.find('=');
        if (equals == std::string_view::npos || equals == 0)
            errors.add(400, "world",
                       in_quotes(part) +
                           " is not name=value; a world is a preset and such pairs "
                           "behind it, as in 'beech,seed=7'");
        else
            pairs.emplace_back(part.substr(0, equals), part.substr(equals + 1));
        text.remove_prefix(part.size());
    }
    return pairs;
}

void replace_all(std::string& text, std::string_view old, std::string_view by) {
    for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += by.size())
        text.replace(at, old.size(), by);
}

/// Reports kinds of trees that the atlas does not have.
void check_kinds(const StandParams& stand, const Atlas& atlas, std::vector<Problem>& problems) {
    std::vector<std::string> ids;
    for (const TreePreset& tree : atlas.trees()) ids.push_back(tree.id.string());
    const auto check = [&](std::string_view id, const char* name) {
        if (atlas.find_tree(id)) return;
        const std::string_view meant = closest(id, ids);
        report(problems, name,
               "unknown tree " + in_quotes(id) +
                   (meant.empty() ? "; those of /v1/trees are known"
                                  : "; did you mean " + in_quotes(meant) + '?'));
    };
    for (const auto& [id, weight] : kinds_in(stand.kinds, "stand.kinds", problems))
        check(id, "stand.kinds");
    if (!stand.lone.empty()) check(stand.lone, "stand.lone");
}

/// Reports a terrain that is not stored, and parameters that have no meaning beside one.
void check_terrain(const WorldSpec& spec, const Context& context, ValidationErrors& errors) {
    const TerrainParams& terrain = spec.params.terrain;
    if (terrain.id.empty() || !is_terrain_id(terrain.id.view())) return;
    if (!context.store.terrains)
        errors.add(404, "terrain.id",
                   "this service stores no terrains; its operator can give it a --store");
    else if (!context.store.terrains->holds(terrain.id.view()))
        errors.add(404, "terrain.id",
                   "there is no terrain " + terrain.id.string() +
                       ", or no longer; upload it to /v1/terrains again");
    TerrainParams grown = context.atlas->find_world(spec.preset)->terrain;
    grown.id = terrain.id;
    grown.micro = terrain.micro;
    TerrainParams::fields([&](auto member, const Info& info) {
        if (terrain.*member != grown.*member)
            errors.add(400, std::string("terrain.") + info.name,
                       "has no meaning beside terrain.id, whose heights are as they were sent; "
                       "leave it out");
    });
}

/// Reports species that the atlas does not have.
void check_species(const FungiParams& fungi, const Atlas& atlas, std::vector<Problem>& problems) {
    for (const std::string& id : species_in(fungi.species, "fungi.species", problems))
        if (!atlas.find(id)) report(problems, "fungi.species", unknown_species(id, atlas));
}

}  // namespace

WorldRequest read_world(std::string_view text, const Context& context, ValidationErrors& errors) {
    WorldRequest request = read_world(text, *context.atlas, errors);
    check_terrain(request.spec, context, errors);
    return request;
}

WorldRequest read_world(std::string_view text, const Atlas& atlas, ValidationErrors& errors) {
    WorldRequest request;
    if (text.size() > longest_world) {
        errors.add(400, "world",
                   "has " + std::to_string(text.size()) + " bytes; at most " +
                       std::to_string(longest_world) + " are allowed");
        text = {};
    }
    const std::string_view id = text.substr(0, text.find(','));
    const WorldPreset& preset = preset_of<Worlds>(atlas, id, "world", errors);
    request.spec = {preset.id.string(), params_of(preset, atlas)};
    Pairs rest;
    request.version = take_version(pairs_of(text.substr(id.size()), errors), rest, errors);
    std::vector<Problem> problems;
    read_query(rest, request.spec.params, problems);
    if (problems.empty()) check_kinds(request.spec.params.stand, atlas, problems);
    if (problems.empty()) check_species(request.spec.params.fungi, atlas, problems);
    errors.add(400, problems);
    StandParams& stand = request.spec.params.stand;
    stand.kinds = Text<256>(canonical_kinds(stand.kinds));
    FungiParams& fungi = request.spec.params.fungi;
    fungi.species = Text<620>(canonical_species(fungi.species));
    without_negative_zero(request.spec.params);
    return request;
}

std::string world_text(const WorldSpec& spec, const Atlas& atlas, std::string_view version) {
    std::string query = query_text(spec.params, own_params<Worlds>(atlas, spec.preset));
    std::replace(query.begin(), query.end(), '&', ',');
    // Signs of the list of kinds, which a path may have as they are.
    replace_all(query, "%3A", ":");
    replace_all(query, "%2B", "+");
    std::string text = spec.preset;
    if (!query.empty()) (text += ',') += query;
    if (!version.empty()) (text += ",v=") += version;
    return text;
}

std::vector<std::pair<std::string, std::string>> query_of_world(const Target& target,
                                                                ValidationErrors& errors) {
    Pairs query;
    for (const auto& pair : target.query) {
        if (pair.first == "v")
            errors.add(400, "v", "of a world ends its text in the path: ',v=' and the token");
        else
            query.push_back(pair);
    }
    return query;
}

void refuse_query_of_world(const Target& target, ValidationErrors& errors) {
    std::vector<Problem> problems;
    const Pairs query = query_of_world(target, errors);
    QueryReader(query, problems).refuse_the_rest();
    errors.add(400, problems);
}

std::string not_of_world(std::string_view id, std::span<const std::string> known) {
    std::string list;
    for (const std::string& one : known) (list += list.empty() ? "" : ", ") += one;
    return in_quotes(id) + " does not live in this world; its fungi are " +
           (list.empty() ? "none" : list);
}

Resource world_resource(const Context& context, const WorldRequest& requested,
                        const std::string& ending, const std::string& query) {
    Resource resource;
    resource.version = preset_token<Worlds>(*context.atlas, requested.spec.preset);
    const std::string text = world_text(requested.spec, *context.atlas, resource.version);
    resource.address = with_query(folder_of(Worlds::all) + text + ending, query);
    resource.key = Worlds::one + with_query(ending, query) + ' ' + resource.version + '\n' +
                   requested.spec.preset + '\n' + canonical_text(requested.spec.params);
    if (requested.edits) {
        resource.address.clear();
        resource.key += '\n' + requested.edits->text;
    }
    resource.type = json;
    resource.requested_version = requested.version;
    return resource;
}

}  // namespace sporeprint::api
