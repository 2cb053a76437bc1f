// The atlas of species: compiled in, or read from a folder. Immutable once made.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/species.h"

namespace sporeprint {

struct AtlasEntry {
    Species species;
    std::string json;        ///< the template as served: canonical JSON
    std::uint64_t hash = 0;  ///< of `json`
};

class Atlas {
  public:
    /// throws InvalidInput with all problems of all texts, paths prefixed by the species' id
    explicit Atlas(const std::vector<std::string>& json_texts);

    [[nodiscard]] const AtlasEntry* find(std::string_view id) const;
    [[nodiscard]] const std::vector<AtlasEntry>& entries() const {
        return entries_;
    }  ///< sorted by id

  private:
    std::vector<AtlasEntry> entries_;
};

/// The species compiled in.
[[nodiscard]] std::shared_ptr<const Atlas> built_in_atlas();

/// Every *.json of a folder. throws InvalidInput naming the file
[[nodiscard]] std::shared_ptr<const Atlas> atlas_from(const std::filesystem::path& folder);

}  // namespace sporeprint
