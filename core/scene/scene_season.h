// The fruit bodies of a scene: on which days its mycelia fruit, and where on its surface the bodies stand.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/images.h"
#include "core/scene/scene_habitat.h"
#include "core/scene/scene_mycelia.h"
#include "core/scene/scene_spores.h"
#include "core/world/season.h"

namespace sporeprint {

/// The fungi of a scene in all years.
struct SceneFungi {
    std::shared_ptr<const SceneHabitat> habitat;
    std::vector<FungusSpecies> species;
    std::vector<SceneEstablishment> establishment;  ///< of each species
    std::vector<std::vector<SceneGenet>> genets;    ///< of each species, of all years

    /// Returns the memory that they take, the habitat not counted.
    [[nodiscard]] std::size_t bytes() const;
};

/// Computes the spread and the mycelia of some species on a scene.
///
/// parallel  computes species side by side
/// throws    Impossible as scene_genets() does
/// cost      2 s for each species on 100,000 surfels
[[nodiscard]] SceneFungi scene_fungi(std::shared_ptr<const SceneHabitat> habitat,
                                     std::vector<FungusSpecies> species,
                                     const Parallel& parallel = in_turn);

/// A fruit body on the surface of a scene.
struct SceneBody {
    FruitBody record;               ///< its place in the plane, and its height as that of the scene
    glm::dvec3 at{0.0};             ///< in the scene, metres
    glm::dvec3 out{0.0, 1.0, 0.0};  ///< away from the surface, a unit vector
    std::uint32_t surfel = 0;       ///< the nearest one
    bool operator==(const SceneBody&) const = default;
};

/// Returns the fruit bodies of a scene that emerge in a year, and the brackets of perennial species that stand at some
/// time of it, by ascending ids.
///
/// Mycelia fruit by the rules of worlds (season.h), on the weather and the water of their own surfels. Bodies stand on
/// rings, bands, bark or round hosts, measured over the surface; where it is too steep for a species, too dry, or
/// something is in the way, there are none.
///
/// throws  Impossible (path "/scene") if there are too many
[[nodiscard]] std::vector<SceneBody> scene_season(const SceneFungi& fungi, int year);

/// Returns the fruit bodies that stand at some time of a year, by ascending ids: those of the year before among them.
[[nodiscard]] std::vector<SceneBody> scene_bodies(const SceneFungi& fungi, int year);

/// Returns for each surfel how likely a species fruits there in autumn, 0..1: the least of its establishment and its
/// responses.
[[nodiscard]] std::vector<float> scene_probability(const SceneFungi& fungi, std::size_t species,
                                                   int year);

}  // namespace sporeprint
