// The atlas of species: compiled in, or read from a folder. It is immutable.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/species.h"

namespace sporeprint {

/// One species with its canonical text.
struct AtlasEntry {
    Species species;
    std::string json;        ///< the template as served: canonical JSON
    std::uint64_t hash = 0;  ///< of `json`
};

/// The species of an atlas, sorted by id.
class Atlas {
  public:
    /// Parses and validates the templates.
    ///
    /// throws  InvalidInput with all problems of all texts, paths prefixed by the species' id
    explicit Atlas(const std::vector<std::string>& json_texts);

    [[nodiscard]] const AtlasEntry* find(std::string_view id) const;
    [[nodiscard]] const std::vector<AtlasEntry>& entries() const {
        return entries_;
    }  ///< sorted by id

  private:
    std::vector<AtlasEntry> entries_;
};

/// Returns the species that are compiled in.
[[nodiscard]] std::shared_ptr<const Atlas> built_in_atlas();

/// Reads every *.json file of a folder.
///
/// throws  InvalidInput naming the file
[[nodiscard]] std::shared_ptr<const Atlas> atlas_from(const std::filesystem::path& folder);

}  // namespace sporeprint
