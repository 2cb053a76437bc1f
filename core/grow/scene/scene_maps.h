// Maps of a scene: a number for each of its surfels or vertices, for shaders and tools of its author.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/images.h"
#include "core/scene/scene_season.h"

namespace sporeprint {

/// What a map shows. All values are 0..1 but those of rain.
enum class SceneMap {
    sky,      ///< share of the light of an overcast sky
    light,    ///< share of the light of an open place in the month of the day
    rain,     ///< what of the rain falls on the surface, as a multiple of that on open level ground
    water,    ///< that and what runs there, likewise
    wetness,  ///< on the day
    spores,   ///< how far a species has spread in the year
    probability,  ///< how likely a species fruits in autumn of the year
};
inline constexpr std::size_t scene_map_count = 7;

constexpr const char* name(SceneMap map) {
    switch (map) {
        case SceneMap::sky:
            return "sky";
        case SceneMap::light:
            return "light";
        case SceneMap::rain:
            return "rain";
        case SceneMap::water:
            return "water";
        case SceneMap::wetness:
            return "wetness";
        case SceneMap::spores:
            return "spores";
        case SceneMap::probability:
            return "probability";
    }
    return nullptr;
}

/// Returns whether a map is of one species.
[[nodiscard]] constexpr bool is_of_species(SceneMap map) {
    return map == SceneMap::spores || map == SceneMap::probability;
}

/// A map and the day that it shows.
struct SceneMapChoice {
    SceneMap map = SceneMap::light;
    std::size_t species = 0;  ///< of those of the scene
    int year = 0, day = 1;    ///< 0 to last_year, 1 to 365
};

/// Returns the values of a map, one for each surfel.
[[nodiscard]] std::vector<float> scene_map(const SceneFungi& fungi, const SceneMapChoice& choice,
                                           const Parallel& parallel = in_turn);

/// Returns values of surfels on the vertices of the scene, in the order of Scene::positions: the mean of those near a
/// vertex that face as the triangles of the vertex do. Vertices of no triangle have 0.
[[nodiscard]] std::vector<float> on_vertices(const SceneShape& shape,
                                             const std::vector<float>& values);

}  // namespace sporeprint
