// The atlas: the species, leaves, trees and worlds that are compiled in or read from a folder. It is
// immutable.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/species.h"
#include "core/plant/leaf.h"
#include "core/plant/tree.h"
#include "core/world/world_params.h"

namespace sporeprint {

/// One species with its canonical text.
struct AtlasEntry {
    Species species;
    std::string json;  ///< the template as served: canonical JSON
    /// XXH3 of `json` without the ecology, 64 bits: no mesh or image depends on that, so addresses of
    /// mushrooms stay valid when it changes.
    std::uint64_t hash = 0;
    std::uint64_t ecology_hash = 0;  ///< XXH3 of the canonical JSON of the ecology, 64 bits
};

/// Returns the entry of a species.
[[nodiscard]] AtlasEntry atlas_entry(Species species);

/// A species that is not of the atlas itself, and the name by which it is found.
struct AtlasGuest {
    std::string name;
    std::shared_ptr<const AtlasEntry> entry;
};

/// The JSON texts of an atlas, one per species, leaf, tree or world, in any order.
struct AtlasTexts {
    std::vector<std::string> species{}, leaves{}, trees{}, worlds{};
};

/// Species, leaves, trees and worlds; each kind has its own ids.
class Atlas {
  public:
    /// Parses and validates the texts.
    ///
    /// throws  InvalidInput with the problems of all texts, repeated ids and trees with unknown
    ///         leaves included; paths are prefixed by the id of the species, leaf, tree or world
    explicit Atlas(const AtlasTexts& texts);

    /// Makes an atlas that has what another one has, and finds guests as well; they are in none of its lists.
    ///
    /// guests  found by their names and by the ids of their species
    Atlas(std::shared_ptr<const Atlas> host, std::vector<AtlasGuest> guests);

    // Trees refer to the ids of the leaves, which a copy would leave behind.
    Atlas(const Atlas&) = delete;
    Atlas& operator=(const Atlas&) = delete;
    Atlas(Atlas&&) = default;
    Atlas& operator=(Atlas&&) = default;
    ~Atlas() = default;

    /// Returns the entry of a species, or nullptr if the atlas has no species with this id.
    [[nodiscard]] const AtlasEntry* find(std::string_view id) const;

    /// Returns all entries of species, sorted by id.
    [[nodiscard]] const std::vector<AtlasEntry>& entries() const {
        return host_ ? host_->entries() : entries_;
    }

    /// Returns a leaf, or nullptr if the atlas has no leaf with this id.
    [[nodiscard]] const LeafPreset* find_leaf(std::string_view id) const;

    /// Returns a tree, or nullptr if the atlas has no tree with this id.
    [[nodiscard]] const TreePreset* find_tree(std::string_view id) const;

    /// Returns all leaves, sorted by rank and id.
    [[nodiscard]] std::span<const LeafPreset> leaves() const {
        return host_ ? host_->leaves() : leaves_;
    }

    /// Returns all trees, sorted by rank and id. Each allows the leaves of the atlas.
    [[nodiscard]] std::span<const TreePreset> trees() const {
        return host_ ? host_->trees() : trees_;
    }

    /// Returns a world, or nullptr if the atlas has no world with this id.
    [[nodiscard]] const WorldPreset* find_world(std::string_view id) const;

    /// Returns all worlds, sorted by rank and id.
    [[nodiscard]] std::span<const WorldPreset> worlds() const {
        return host_ ? host_->worlds() : worlds_;
    }

    /// Returns the ids of leaves(), in their order. They live as long as the atlas, even if it is
    /// moved.
    [[nodiscard]] std::span<const std::string> leaf_ids() const {
        return host_ ? host_->leaf_ids() : leaf_ids_;
    }

    /// Returns the ids and canonical texts of the parameters of all leaves, in their order. A tree
    /// may bear any of them, so its version depends on this text.
    [[nodiscard]] const std::string& leaf_text() const {
        return host_ ? host_->leaf_text() : leaf_text_;
    }

  private:
    std::shared_ptr<const Atlas> host_;
    std::vector<AtlasGuest> guests_;
    std::vector<AtlasEntry> entries_;
    std::vector<LeafPreset> leaves_;
    std::vector<TreePreset> trees_;
    std::vector<WorldPreset> worlds_;
    std::vector<std::string> leaf_ids_;
    std::string leaf_text_;
};

/// Returns the parameters of a world's preset without overrides. Trees and species that the atlas does not have are
/// left out; a wood without any of its trees has the first one of the atlas.
///
/// pre  the atlas has a tree
[[nodiscard]] WorldParams params_of(const WorldPreset& preset, const Atlas& atlas);

/// Returns the texts that are compiled in.
[[nodiscard]] const AtlasTexts& built_in_texts();

/// Returns the atlas that is compiled in.
[[nodiscard]] std::shared_ptr<const Atlas> built_in_atlas();

/// Reads an atlas from the *.json files of a folder: species from the folder itself and its
/// subfolder species/, leaves from leaves/, trees from trees/, worlds from worlds/. Other files and subfolders are not
/// read. A kind without files is taken from the built-in atlas; files of a kind replace all
/// built-in ones of this kind.
///
/// throws  InvalidInput if the folder cannot be read or has no such file, with the problems of the
///         first invalid file, paths prefixed by its name, for worlds of the folder with trees or
///         species that the atlas does not have, or as the constructor does
[[nodiscard]] std::shared_ptr<const Atlas> atlas_from(const std::filesystem::path& folder);

}  // namespace sporeprint
