// The parts of an uploaded scene that several products need, each computed once and cached: its shape and its fungi.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/get_or_compute.h"
#include "core/grow/execution_context.h"
#include "core/scene/scene_season.h"
#include "core/world/world_params.h"

namespace sporeprint {

/// Caches of what is expensive of a scene.
struct SceneCaches {
    /// Returns a scene by its id, or null if it is not stored.
    std::function<std::shared_ptr<const Scene>(std::string_view id)> scene = [](std::string_view) {
        return nullptr;
    };
    GetOrCompute<SceneShape> shapes = uncached<SceneShape>;
    GetOrCompute<SceneFungi> fungi = uncached<SceneFungi>;
};

/// What is said of a scene in query parameters.
struct SceneParams {
    Text<1000> substrates;
    double decay = 0.3;

    static constexpr void fields(auto visit) {
        using S = SceneParams;
        visit(&S::substrates,
              Info{.name = "substrates",
                   .most = 1000,
                   .doc = "What materials of the scene are to fungi, by their names: "
                          "Bark:beech,Soil:ground+oak,Rock:none. Words are none, ground, litter "
                          "(the floor of a wood), grass, wood, and trees; a tree alone is its "
                          "wood. Others are guessed by the words in their names."});
        visit(&S::decay, Info{.name = "decay",
                              .min = 0,
                              .max = 1,
                              .doc = "Share of its mass that the wood of the scene has lost, which "
                                     "decides on the species that live on it.",
                              .step = 0.05});
    }
    bool operator==(const SceneParams&) const = default;
};
static_assert(well_described<SceneParams>());

/// The fungi of a scene that are to be computed.
struct SceneSpec {
    std::string id;  ///< of the scene
    /// Its climate, soil, fungi and seed; terrain, stand and extent have no meaning.
    WorldParams world;
    SceneParams scene;
};

/// Returns the keys of the shape of a scene and of its fungi for caches.
[[nodiscard]] std::string shape_key(std::string_view id);
[[nodiscard]] std::string fungi_key(const SceneSpec& spec);

/// Returns the ids of the kinds of trees of an atlas, of which materials may be.
[[nodiscard]] std::vector<std::string> tree_kinds(const Atlas& atlas);

/// Returns the ids of the fungi of a scene, in the order of SceneFungi::species.
[[nodiscard]] std::vector<std::string> species_of(const SceneSpec& spec);

/// Returns the fungi of a scene, cached or computed now.
///
/// throws  InvalidInput (path "scene") if the scene is not stored, (path "substrates") for a material that it does not
///         have, (path "fungi.species") for an unknown species; Impossible as scene_fungi() does
/// cost    20 s for the largest scenes with 12 species
[[nodiscard]] std::shared_ptr<const SceneFungi> fungi_of_scene(const SceneSpec& spec,
                                                               const Atlas& atlas,
                                                               const SceneCaches& caches,
                                                               const ExecutionContext& execution);

}  // namespace sporeprint
