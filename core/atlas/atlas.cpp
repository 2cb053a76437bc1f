#include "core/atlas/atlas.h"

#include <xxhash.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <tuple>
#include <utility>

#include "core/params/canonical.h"
#include "core/params/messages.h"
#include "core/params/reader.h"
#include "core/plant/leaf_spec.h"

namespace sporeprint {

namespace {

/// Reads one text and adds its problems, with paths prefixed by its id.
///
/// returns  false if there are any
template <class T>
bool read_template(const std::string& text, T& out, std::vector<Problem>& problems) {
    std::vector<Problem> found;
    out = read_json<T>(text, found);
    const std::string id = out.id.empty() ? "a template without id" : out.id.string();
    for (Problem& problem : found)
        report(problems, id + ":" + problem.path, std::move(problem.message));
    return found.empty();
}

std::uint64_t hash_of(const std::string& text) { return XXH3_64bits(text.data(), text.size()); }

void report_repeated(const std::string& id, std::vector<Problem>& problems) {
    report(problems, id + ":/id", "two templates have this id");
}

/// Returns the presets of the valid texts, sorted by rank and id.
template <class Preset>
std::vector<Preset> presets_of(const std::vector<std::string>& texts,
                               std::vector<Problem>& problems) {
    std::vector<Preset> presets;
    for (const std::string& text : texts) {
        Preset preset;
        if (!read_template(text, preset, problems)) continue;
        const bool is_repeated = std::any_of(
            presets.begin(), presets.end(), [&](const Preset& one) { return one.id == preset.id; });
        if (is_repeated) report_repeated(preset.id.string(), problems);
        presets.push_back(std::move(preset));
    }
    std::sort(presets.begin(), presets.end(), [](const Preset& a, const Preset& b) {
        return std::tuple(a.rank, a.id.view()) < std::tuple(b.rank, b.id.view());
    });
    return presets;
}

template <class Preset>
const Preset* preset_in(const std::vector<Preset>& presets, std::string_view id) {
    const auto found = std::find_if(presets.begin(), presets.end(),
                                    [&](const Preset& one) { return one.id.view() == id; });
    return found == presets.end() ? nullptr : &*found;
}

/// Reports a tree whose leaf is not among those of the atlas.
void check_leaf(const TreePreset& tree, std::vector<Problem>& problems) {
    const std::string path = tree.id.string() + ":/leaf";
    if (tree.leaf.among.empty()) return report(problems, path, "there are no leaves");
    if (tree.leaf.allows(tree.leaf.id)) return;
    const std::string_view meant = closest(tree.leaf.id, tree.leaf.among);
    report(problems, path,
           not_allowed_message(in_quotes(tree.leaf.id), tree.leaf) +
               (meant.empty() ? "" : "; did you mean " + in_quotes(meant) + "?"));
}

/// Reports kinds of trees and species of a world that are not among those of the atlas.
void check_contents(const WorldPreset& world, const Atlas& atlas, std::vector<Problem>& problems) {
    const std::string path = world.id.string() + ":/stand";
    std::vector<Problem> reported;  // of the text itself, when it was read
    // A world that names no kinds has the default, which an atlas of other trees need not have.
    const bool names_kinds = world.stand.kinds != StandParams{}.kinds;
    for (const auto& [id, weight] : kinds_in(world.stand.kinds, path, reported))
        if (names_kinds && !atlas.find_tree(id))
            report(problems, path + "/kinds", "there is no tree " + in_quotes(id));
    if (!world.stand.lone.empty() && !atlas.find_tree(world.stand.lone))
        report(problems, path + "/lone", "there is no tree " + in_quotes(world.stand.lone));
    for (const std::string& id : species_in(world.fungi.species, path, reported))
        if (!atlas.find(id))
            report(problems, world.id.string() + ":/fungi/species",
                   "there is no species " + in_quotes(id));
}

/// Returns the names of the *.json files in a folder, sorted.
///
/// throws  InvalidInput if the folder cannot be read
std::vector<std::filesystem::path> json_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    std::error_code error;
    for (std::filesystem::directory_iterator i(folder, error), end; !error && i != end;
         i.increment(error))
        if (i->path().extension() == ".json") files.push_back(i->path());
    if (error) throw InvalidInput(folder.string(), "the folder cannot be read: " + error.message());
    std::sort(files.begin(), files.end());
    return files;
}

/// Returns the texts of the *.json files in a folder, each a valid T.
///
/// throws  InvalidInput if the folder or a file cannot be read, or with the problems of the first
///         invalid file
template <class T>
std::vector<std::string> texts_in(const std::filesystem::path& folder) {
    std::vector<std::string> texts;
    for (const std::filesystem::path& path : json_files(folder)) {
        std::ifstream file(path, std::ios::binary);
        std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
        if (!file) throw InvalidInput(path.string(), "the file cannot be read");
        std::vector<Problem> problems;
        (void)read_json<T>(text, problems);
        for (Problem& problem : problems) problem.path = path.string() + ":" + problem.path;
        if (!problems.empty()) throw InvalidInput(std::move(problems));
        texts.push_back(std::move(text));
    }
    return texts;
}

/// Returns the texts of a subfolder, or nothing if it does not exist.
template <class T>
std::vector<std::string> texts_in_subfolder(const std::filesystem::path& folder) {
    std::error_code error;
    const bool exists = std::filesystem::exists(folder, error);
    return exists || error ? texts_in<T>(folder) : std::vector<std::string>();
}

}  // namespace

AtlasEntry atlas_entry(Species species) {
    Value value = write(species);
    std::string json = dump(value);
    value.erase("ecology");
    const std::uint64_t hash = hash_of(dump(value)),
                        ecology_hash = hash_of(dump(write(species.ecology)));
    return {std::move(species), std::move(json), hash, ecology_hash};
}

Atlas::Atlas(std::shared_ptr<const Atlas> host, std::vector<AtlasGuest> guests)
    : host_(std::move(host)), guests_(std::move(guests)) {}

Atlas::Atlas(const AtlasTexts& texts) {
    std::vector<Problem> problems;
    for (const std::string& text : texts.species) {
        Species species;
        if (!read_template(text, species, problems)) continue;
        if (find(species.id.view())) report_repeated(species.id.string(), problems);
        const auto place = std::lower_bound(entries_.begin(), entries_.end(), species.id.view(),
                                            [](const AtlasEntry& entry, std::string_view wanted) {
                                                return entry.species.id.view() < wanted;
                                            });
        entries_.insert(place, atlas_entry(std::move(species)));
    }
    leaves_ = presets_of<LeafPreset>(texts.leaves, problems);
    for (const LeafPreset& leaf : leaves_) {
        leaf_ids_.push_back(leaf.id.string());
        (leaf_text_ += ' ') += leaf_ids_.back() + canonical_text(params_of(leaf));
    }
    trees_ = presets_of<TreePreset>(texts.trees, problems);
    for (TreePreset& tree : trees_) {
        tree.leaf.among = leaf_ids_;
        check_leaf(tree, problems);
    }
    worlds_ = presets_of<WorldPreset>(texts.worlds, problems);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
}

const AtlasEntry* Atlas::find(std::string_view id) const {
    for (const AtlasGuest& guest : guests_)
        if (guest.name == id || guest.entry->species.id.view() == id) return guest.entry.get();
    if (host_) return host_->find(id);
    const auto place = std::lower_bound(entries_.begin(), entries_.end(), id,
                                        [](const AtlasEntry& entry, std::string_view wanted) {
                                            return entry.species.id.view() < wanted;
                                        });
    return place != entries_.end() && place->species.id.view() == id ? &*place : nullptr;
}

const LeafPreset* Atlas::find_leaf(std::string_view id) const {
    return host_ ? host_->find_leaf(id) : preset_in(leaves_, id);
}

const TreePreset* Atlas::find_tree(std::string_view id) const {
    return host_ ? host_->find_tree(id) : preset_in(trees_, id);
}

const WorldPreset* Atlas::find_world(std::string_view id) const {
    return host_ ? host_->find_world(id) : preset_in(worlds_, id);
}

WorldParams params_of(const WorldPreset& preset, const Atlas& atlas) {
    WorldParams params = params_of(preset);
    std::vector<Problem> ignored;
    std::string kinds, species;
    for (const auto& [id, weight] : kinds_in(params.stand.kinds, "", ignored))
        if (atlas.find_tree(id))
            kinds += (kinds.empty() ? "" : "+") + id + ':' + number_text(weight);
    if (kinds.empty()) kinds = atlas.trees().front().id.string();
    params.stand.kinds = Text<256>(canonical_kinds(kinds));
    if (!params.stand.lone.empty() && !atlas.find_tree(params.stand.lone)) params.stand.lone = {};
    for (const std::string& id : species_in(params.fungi.species, "", ignored))
        if (atlas.find(id)) species += (species.empty() ? "" : "+") + id;
    params.fungi.species = Text<620>(species);
    return params;
}

std::shared_ptr<const Atlas> built_in_atlas() {
    return std::make_shared<const Atlas>(built_in_texts());
}

std::shared_ptr<const Atlas> atlas_from(const std::filesystem::path& folder) {
    AtlasTexts texts{.species = texts_in<Species>(folder),
                     .leaves = texts_in_subfolder<LeafPreset>(folder / "leaves"),
                     .trees = texts_in_subfolder<TreePreset>(folder / "trees"),
                     .worlds = texts_in_subfolder<WorldPreset>(folder / "worlds")};
    for (std::string& text : texts_in_subfolder<Species>(folder / "species"))
        texts.species.push_back(std::move(text));
    if (texts.species.empty() && texts.leaves.empty() && texts.trees.empty() &&
        texts.worlds.empty())
        throw InvalidInput(folder.string(), "the folder holds no *.json template");
    const bool has_worlds = !texts.worlds.empty();
    const AtlasTexts& built_in = built_in_texts();
    if (texts.species.empty()) texts.species = built_in.species;
    if (texts.leaves.empty()) texts.leaves = built_in.leaves;
    if (texts.trees.empty()) texts.trees = built_in.trees;
    if (texts.worlds.empty()) texts.worlds = built_in.worlds;
    auto atlas = std::make_shared<const Atlas>(texts);
    // Built-in worlds have what is left of their trees and species; worlds of one's own are meant as they are.
    std::vector<Problem> problems;
    if (has_worlds)
        for (const WorldPreset& world : atlas->worlds()) check_contents(world, *atlas, problems);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    return atlas;
}

}  // namespace sporeprint
