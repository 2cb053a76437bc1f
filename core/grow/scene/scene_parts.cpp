#include "core/grow/scene/scene_parts.h"

#include <algorithm>
#include <utility>

#include "core/grow/world/parts.h"
#include "core/params/canonical.h"
#include "core/problems.h"
#include "core/world/world_species.h"

namespace sporeprint {

namespace {

/// The longest list of kinds of trees that species can name.
constexpr std::size_t most_tree_kinds = 32;

}  // namespace

std::string shape_key(std::string_view id) { return "scene shape " + std::string(id); }

std::string fungi_key(const SceneSpec& spec) {
    std::string key = "scene fungi " + spec.id + '\n' + std::to_string(spec.world.seed) + '\n';
    canonical(spec.world.climate, key);
    canonical(spec.world.soil, key);
    canonical(spec.world.fungi, key);
    canonical(spec.scene, key);
    return key;
}

std::vector<std::string> tree_kinds(const Atlas& atlas) {
    std::vector<std::string> kinds;
    for (const TreePreset& tree : atlas.trees())
        if (kinds.size() < most_tree_kinds) kinds.push_back(tree.id.string());
    std::ranges::sort(kinds);
    return kinds;
}

std::vector<std::string> species_of(const SceneSpec& spec) {
    std::vector<Problem> problems;
    return species_in(spec.world.fungi.species, "fungi.species", problems);
}

std::shared_ptr<const SceneFungi> fungi_of_scene(const SceneSpec& spec, const Atlas& atlas,
                                                 const SceneCaches& caches,
                                                 const ExecutionContext& execution) {
    return caches.fungi(fungi_key(spec), [&] {
        const auto shape = caches.shapes(shape_key(spec.id), [&] {
            const std::shared_ptr<const Scene> scene = caches.scene(spec.id);
            if (!scene)
                throw InvalidInput("scene", "there is no scene " + spec.id +
                                                ", or no longer; upload it to /v1/scenes again");
            throw_if_cancelled(execution);
            return std::make_shared<const SceneShape>(shape_of_scene(scene, execution.parallel));
        });
        throw_if_cancelled(execution);
        std::vector<Problem> problems;
        const std::vector<std::string> kinds = tree_kinds(atlas);
        SceneConditions conditions;
        conditions.seed = spec.world.seed;
        conditions.climate = spec.world.climate;
        conditions.acidity = spec.world.soil.acidity;
        conditions.decay = spec.scene.decay;
        conditions.abundance = spec.world.fungi.abundance;
        conditions.soils =
            soils_of(shape->scene->materials,
                     soils_in(spec.scene.substrates.view(), kinds, "substrates", problems), kinds,
                     "substrates", problems);
        std::vector<FungusSpecies> species = fungi_of(species_of(spec), spec.world.climate, kinds,
                                                      lookup_in(atlas), nullptr, problems);
        if (!problems.empty()) throw InvalidInput(std::move(problems));
        auto habitat = std::make_shared<const SceneHabitat>(
            habitat_of(shape, std::move(conditions), execution.parallel));
        throw_if_cancelled(execution);
        return std::make_shared<const SceneFungi>(
            scene_fungi(std::move(habitat), std::move(species), execution.parallel));
    });
}

}  // namespace sporeprint
