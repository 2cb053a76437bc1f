// A scene with fungi of the built-in atlas, which tests of its products share.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/grow/scene/scene_parts.h"
#include "tests/support/atlas.h"
#include "tests/support/scenes.h"

namespace sporeprint::scenes {

/// Returns a lawn with a log and a standing trunk of beech.
inline const std::shared_ptr<const Scene>& garden() {
    static const std::shared_ptr<const Scene> one =
        Made()
            .floor(-2.5F, -2.5F, 2.5F, 2.5F, 0, "Lawn")
            .box({-1.5F, -0.05F, 0.5F}, {1.5F, 0.35F, 0.9F}, "beech log")
            .box({-1.2F, -0.05F, -1.2F}, {-0.8F, 2.5F, -0.8F}, "Beech bark")
            .shared();
    return one;
}

inline SceneSpec garden_spec() {
    SceneSpec spec;
    spec.id = "s-garden";
    spec.world.seed = 3;
    spec.world.climate.rain = 1000.0;
    spec.world.fungi.species =
        Text<620>("fomes_fomentarius+hypholoma_fasciculare+marasmius_oreades+pleurotus_ostreatus");
    spec.world.fungi.abundance = 3.0;
    return spec;
}

inline SceneCaches garden_caches() {
    SceneCaches caches;
    caches.scene = [](std::string_view id) {
        return id == "s-garden" ? garden() : std::shared_ptr<const Scene>();
    };
    return caches;
}

/// Returns the fungi of the garden, computed once.
inline const SceneFungi& garden_fungi() {
    static const auto one = fungi_of_scene(garden_spec(), atlas(), garden_caches(), {});
    return *one;
}

inline constexpr int garden_year = 60;

/// Returns the bodies of a year of the garden, computed once.
inline const std::vector<SceneBody>& garden_bodies() {
    static const std::vector<SceneBody> all = scene_bodies(garden_fungi(), garden_year);
    return all;
}

/// Returns noon of the day of that year on which most of them stand.
inline WorldTime garden_time() {
    WorldTime best = 0;
    std::size_t most = 0;
    for (int day = 1; day <= 365; ++day) {
        const WorldTime noon = time_of(garden_year, day) + ticks_of_day / 2;
        std::size_t count = 0;
        for (const SceneBody& body : garden_bodies()) count += body.record.stands_at(noon) ? 1 : 0;
        if (count > most) {
            most = count;
            best = noon;
        }
    }
    return best;
}

}  // namespace sporeprint::scenes
