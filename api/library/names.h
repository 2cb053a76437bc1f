// Names of users' species: "~kaja.red_bolete@3", wherever the id of a species may stand.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sporeprint::api {

/// Longest names; with '~', '.' and "@draft" they are ids of 48 characters at most.
inline constexpr std::size_t longest_owner = 16, longest_name = 24;

/// The name of a species in the library, or of one of its versions.
struct LibraryName {
    std::string owner, name;
    int number = 0;         ///< of a published version; 0 for none
    bool is_draft = false;  ///< "@draft"

    bool operator==(const LibraryName&) const = default;
};

/// Returns true for [a-z][a-z0-9_]{0,15}.
[[nodiscard]] bool is_owner_name(std::string_view text);

/// Returns true for [a-z][a-z0-9_]{0,23}.
[[nodiscard]] bool is_species_name(std::string_view text);

/// What a name has to be, for messages.
inline constexpr const char* owner_grammar =
    "1 to 16 characters a-z, 0-9 and _, the first a letter";
inline constexpr const char* name_grammar = "1 to 24 characters a-z, 0-9 and _, the first a letter";

/// Returns true if an id is meant to be that of a species in the library: it begins with '~'.
[[nodiscard]] constexpr bool is_of_library(std::string_view id) { return id.starts_with('~'); }

/// Reads "~owner.name", "~owner.name@3" or "~owner.name@draft". Returns nothing for any other text.
[[nodiscard]] std::optional<LibraryName> read_library_name(std::string_view text);

/// Returns "~owner.name", and "@3" or "@draft" after it for a version.
[[nodiscard]] std::string text_of(const LibraryName& name);

/// Returns what is said of a species that its owner has purged.
[[nodiscard]] std::string withdrawn_message(const LibraryName& name);

/// Thrown where a request names species of the library that its atlas does not have. The service loads them and plans
/// the request again.
class SpeciesOfLibrary : public std::runtime_error {
  public:
    explicit SpeciesOfLibrary(std::vector<std::string> ids)
        : std::runtime_error("species of the library have to be loaded"), ids_(std::move(ids)) {}

    [[nodiscard]] const std::vector<std::string>& ids() const { return ids_; }

  private:
    std::vector<std::string> ids_;
};

}  // namespace sporeprint::api
