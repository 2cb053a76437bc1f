// Where the fruit bodies of a scene stand on a day, as rows like those of worlds.
#pragma once

#include <string>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/gltf/glb.h"
#include "core/grow/world/placements.h"
#include "core/scene/scene_season.h"

namespace sporeprint {

/// Returns the place of the model of a body. On wood the models of species that grow from their side face away from it;
/// all others stand upright, turned at random.
[[nodiscard]] GlbTransform place_of(const SceneBody& body, bool is_lateral);

/// Returns whether the models of species grow from their side.
///
/// ids  of species of the atlas; others do not
[[nodiscard]] std::vector<bool> lateral_species(const std::vector<std::string>& ids,
                                                const Atlas& atlas);

/// A fruit body of a scene as a row, and what it stands on.
struct ScenePlacement {
    Placement
        row;  ///< its place is in the coordinates of the scene; host and trunk are pieces of wood
    Soil soil = Soil::none;
    std::uint16_t material = 0;  ///< of the scene
};

/// Returns the fruit bodies of a scene at a moment, by ascending ids.
///
/// bodies   scene_bodies() of the year of the moment
/// lateral  lateral_species() of the fungi
/// chosen   which species are listed; empty for all
[[nodiscard]] std::vector<ScenePlacement> placements_on(const SceneFungi& fungi,
                                                        const std::vector<SceneBody>& bodies,
                                                        WorldTime time,
                                                        const std::vector<bool>& lateral,
                                                        const std::vector<bool>& chosen = {});

}  // namespace sporeprint
