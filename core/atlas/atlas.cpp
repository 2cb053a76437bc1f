#include "core/atlas/atlas.h"

#include <xxhash.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "core/params/reader.h"

namespace sporeprint {

// generated from core/atlas/*.json at build time
const std::vector<std::string>& built_in_templates();

Atlas::Atlas(const std::vector<std::string>& json_texts) {
    std::vector<Problem> problems;
    for (const std::string& text : json_texts) {
        std::vector<Problem> found;
        Species species = read_json<Species>(text, found);
        const std::string id = species.id.empty() ? "a template without id" : species.id.string();
        for (Problem& problem : found)
            report(problems, id + ":" + problem.path, std::move(problem.message));
        if (!found.empty()) continue;
        if (find(species.id.view())) report(problems, id + ":/id", "two templates have this id");
        std::string json = dump(write(species));
        const std::uint64_t hash = XXH3_64bits(json.data(), json.size());
        const auto place = std::lower_bound(entries_.begin(), entries_.end(), species.id.view(),
                                            [](const AtlasEntry& entry, std::string_view wanted) {
                                                return entry.species.id.view() < wanted;
                                            });
        entries_.insert(place, {std::move(species), std::move(json), hash});
    }
    if (!problems.empty()) throw InvalidInput(std::move(problems));
}

const AtlasEntry* Atlas::find(std::string_view id) const {
    const auto place = std::lower_bound(entries_.begin(), entries_.end(), id,
                                        [](const AtlasEntry& entry, std::string_view wanted) {
                                            return entry.species.id.view() < wanted;
                                        });
    return place != entries_.end() && place->species.id.view() == id ? &*place : nullptr;
}

std::shared_ptr<const Atlas> built_in_atlas() {
    return std::make_shared<const Atlas>(built_in_templates());
}

std::shared_ptr<const Atlas> atlas_from(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    std::error_code error;
    for (std::filesystem::directory_iterator i(folder, error), end; !error && i != end;
         i.increment(error))
        if (i->path().extension() == ".json") files.push_back(i->path());
    if (error) throw InvalidInput(folder.string(), "the folder cannot be read: " + error.message());
    if (files.empty()) throw InvalidInput(folder.string(), "the folder holds no *.json template");
    std::sort(files.begin(), files.end());
    std::vector<std::string> texts;
    for (const auto& path : files) {
        std::ifstream file(path, std::ios::binary);
        std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
        if (!file) throw InvalidInput(path.string(), "the file cannot be read");
        std::vector<Problem> problems;
        (void)read_json<Species>(text, problems);
        for (Problem& problem : problems) problem.path = path.string() + ":" + problem.path;
        if (!problems.empty()) throw InvalidInput(std::move(problems));
        texts.push_back(std::move(text));
    }
    return std::make_shared<const Atlas>(texts);
}

}  // namespace sporeprint
