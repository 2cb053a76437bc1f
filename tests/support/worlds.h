// Worlds for tests, and caches of their parts.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "core/grow/world/parts.h"
#include "core/grow/world/plot_bodies.h"
#include "tests/support/atlas.h"

namespace sporeprint {

/// A preset of 256 m with seed 7.
inline WorldParams small_world(const char* preset) {
    WorldParams params = params_of(*atlas().find_world(preset));
    params.seed = 7;
    params.extent.value = 256;
    return params;
}

inline World world_over_its_ground(const WorldParams& params) {
    return world_of(params, lookup_in(atlas()), std::make_shared<const Ground>(ground_of(params)));
}

/// Services whose caches of worlds have no bound. For one thread.
class CachedParts {
  public:
    CachedParts() {
        services.caches.blocks = [this](const std::string& key, const auto& make) {
            return get(blocks_, key, make);
        };
        services.caches.mycelia = [this](const std::string& key, const auto& make) {
            return get(mycelia_, key, make);
        };
        services.caches.seasons = [this](const std::string& key, const auto& make) {
            return get(seasons_, key, make);
        };
        services.caches.trees = [this](const std::string& key, const auto& make) {
            return get(trees_, key, make);
        };
        services.caches.bodies = [this](const std::string& key, const auto& make) {
            return get(bodies_, key, make);
        };
    }
    ExecutionContext services;

  private:
    template <class T>
    using Map = std::map<std::string, std::shared_ptr<const T>>;

    template <class T>
    static std::shared_ptr<const T> get(Map<T>& cache, const std::string& key,
                                        const std::function<std::shared_ptr<const T>()>& make) {
        if (const auto found = cache.find(key); found != cache.end()) return found->second;
        return cache[key] = make();
    }
    Map<Block> blocks_;
    Map<BlockMycelia> mycelia_;
    Map<BlockSeason> seasons_;
    Map<TreeMeshes> trees_;
    Map<BodyShape> bodies_;
};

}  // namespace sporeprint
