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
    std::uint64_t hash = 0;  ///< XXH3 of `json`, 64 bits
};

/// The species of an atlas, sorted by id.
class Atlas {
  public:
    /// Parses and validates the templates, one JSON text per species.
    ///
    /// throws  InvalidInput with the problems of all texts, repeated ids included; paths are
    ///         prefixed by the species' id
    explicit Atlas(const std::vector<std::string>& json_texts);

    /// Returns the entry of a species, or nullptr if the atlas has no species with this id.
    [[nodiscard]] const AtlasEntry* find(std::string_view id) const;

    /// Returns all entries, sorted by id.
    [[nodiscard]] const std::vector<AtlasEntry>& entries() const { return entries_; }

  private:
    std::vector<AtlasEntry> entries_;
};

/// Returns the species that are compiled in.
[[nodiscard]] std::shared_ptr<const Atlas> built_in_atlas();

/// Reads an atlas from the *.json files of a folder, one species each; subfolders are not read.
///
/// throws  InvalidInput if the folder cannot be read or has no such file, or with the problems of
///         the first invalid file, paths prefixed by its name
[[nodiscard]] std::shared_ptr<const Atlas> atlas_from(const std::filesystem::path& folder);

}  // namespace sporeprint
