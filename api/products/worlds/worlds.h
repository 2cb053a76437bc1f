// Worlds: the text that names one in a URL, and its resources.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/http/errors.h"
#include "api/products/product.h"
#include "api/products/resource.h"
#include "core/atlas/atlas.h"
#include "core/params/canonical.h"
#include "core/world/world_edits.h"
#include "core/world/world_params.h"

namespace sporeprint::api {

/// What the numbers of `place_m` and `bbox` are.
inline constexpr const char* axes_of_places =
    "x to the east, y to the north, then the height, metres from the centre of the world";

/// Longest text of a world in a URL, bytes.
inline constexpr int longest_world = 2048;

/// The Kind of presets.h for worlds, as far as they have presets like other products.
struct Worlds {
    using Preset = WorldPreset;
    using Params = WorldParams;
    static constexpr const char *one = "world", *all = "worlds";
    static std::span<const Preset> presets(const Atlas& atlas) { return atlas.worlds(); }
    static const Preset* find(const Atlas& atlas, std::string_view id) {
        return atlas.find_world(id);
    }
    /// What trees and species live on is part of every world.
    static std::string more_templates(const Atlas& atlas) {
        std::string text;
        for (const TreePreset& tree : atlas.trees())
            (text += ' ') += tree.id.string() + canonical_text(tree.ecology);
        for (const AtlasEntry& entry : atlas.entries())
            (text += ' ') += std::to_string(entry.ecology_hash);
        return text;
    }
};

/// A world that a URL or a body names, and the version token of the request.
struct WorldRequest {
    WorldSpec spec;
    std::optional<std::string> version;
    SharedEdits edits{};  ///< of a body; null if there are none
};

/// Reads the {world} of a URL: "beech,seed=7,climate.rain=600,v=35-1a2b3c4d". Errors name the parameters of the text,
/// or "world" for its form and its preset: 400 for syntax and values, 404 for an unknown preset. Whether its terrain is
/// stored remains open.
[[nodiscard]] WorldRequest read_world(std::string_view text, const Atlas& atlas,
                                      ValidationErrors& errors);

/// Reads the {world} of a request. Its terrain is looked up too: 404 if it is not stored, 400 for parameters that have no
/// meaning beside one.
[[nodiscard]] WorldRequest read_world(std::string_view text, const Context& context,
                                      ValidationErrors& errors);

/// Returns the canonical text of a world: its preset, then parameters that differ from it in the order of the schema.
///
/// version  token that ends it; none if empty
[[nodiscard]] std::string world_text(const WorldSpec& spec, const Atlas& atlas,
                                     std::string_view version = {});

/// Returns the query of a route of worlds; `v` is refused with the place where it belongs.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> query_of_world(
    const Target& target, ValidationErrors& errors);

/// Refuses the query of a route of worlds that has none.
void refuse_query_of_world(const Target& target, ValidationErrors& errors);

/// Returns why a species is refused that is not among the fungi of a world.
///
/// known  its fungi
[[nodiscard]] std::string not_of_world(std::string_view id, std::span<const std::string> known);

/// Returns the JSON resource of a world that has an ending, such as "/weather.json", and a canonical query. It has no
/// address if the world has edits.
[[nodiscard]] Resource world_resource(const Context& context, const WorldRequest& requested,
                                      const std::string& ending, const std::string& query);

}  // namespace sporeprint::api
