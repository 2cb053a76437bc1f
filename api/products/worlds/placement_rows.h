// The rows of placements as CSV, JSON and a binary table.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "api/products/worlds/placements.h"
#include "core/grow/world/placements.h"
#include "core/model/ecology.h"
#include "core/params/value.h"

namespace sporeprint::api {

/// What the rows of a file refer to.
struct PlacementNames {
    std::vector<std::string> kinds, species, substrates;
    std::vector<std::string> trees;  ///< addresses, as Placements::trees
    std::string folder;              ///< of the addresses of mushrooms
};

/// Returns what fungi of a guild that are not on a trunk stand on.
[[nodiscard]] const char* ground_of_guild(Guild guild);

/// Returns what follows the id of a species in the address of the model of a fruit body: without wood of its own, since
/// that of the world is there.
[[nodiscard]] std::string model_of_body(std::uint32_t seed, double age);

/// Return rows as text, one line each after a head; as the members of a JSON object whose others `head` has; and as a
/// table: a head of 24 bytes, rows of 88 bytes, and JSON with the names that they refer to.
[[nodiscard]] std::string csv_of(std::span<const Placement> rows, const PlacementNames& names);
[[nodiscard]] std::string json_of(std::span<const Placement> rows, const PlacementNames& names,
                                  Value head);
[[nodiscard]] std::string bin_of(std::span<const Placement> rows, const PlacementNames& names);

/// Returns the ending and the media type of a file.
[[nodiscard]] const char* ending_of(PlacementFile file);
[[nodiscard]] const char* type_of(PlacementFile file);

}  // namespace sporeprint::api
