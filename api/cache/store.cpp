#include "api/cache/store.h"

#include <utility>

#include "core/atlas/atlas.h"
#include "core/grow/tree.h"
#include "core/grow/world/plot_bodies.h"
#include "core/scene/scene_season.h"
#include "core/scene/scene_store.h"
#include "core/silhouette/morph_set.h"
#include "core/world/world.h"

namespace sporeprint::api {

namespace {

std::size_t weight_of(const Painted& painted) {
    if (const Images* images = std::get_if<Images>(&painted))
        return (*images)->bytes() + sizeof(ImageSet);
    const RawImages& raw = *std::get<Painting>(painted);
    return raw.rgb[0].size() + raw.rgb[1].size() + raw.rgb[2].size() + sizeof(RawImages);
}

/// Bred species are needed as long as somebody looks at them: about 150 of the atlas.
constexpr std::size_t offspring_bytes = std::size_t{16} << 20U;

std::size_t weight_of(const BlockPart& part) {
    if (const SharedTree* tree = std::get_if<SharedTree>(&part))
        // Position, normal, tangent, texture coordinates and weights of wind of each vertex.
        return (*tree)->vertices() * 64 + (*tree)->triangles() * 12;
    if (const SharedBody* body = std::get_if<SharedBody>(&part)) return (*body)->bytes();
    if (const SharedBlock* block = std::get_if<SharedBlock>(&part)) return (*block)->bytes();
    if (const SharedMycelia* mycelia = std::get_if<SharedMycelia>(&part))
        return (*mycelia)->bytes();
    return std::get<SharedSeason>(part)->bytes();
}

/// The shape of the largest scene takes 60 MB, of which a cache holds an eighth at most.
constexpr std::size_t scene_cache_bytes = std::size_t{512} << 20U;

std::size_t weight_of(const ScenePart& part) {
    if (const SharedShape* shape = std::get_if<SharedShape>(&part)) return (*shape)->bytes();
    const SceneFungi& fungi = *std::get<SharedFungi>(part);
    return fungi.bytes() + fungi.habitat->bytes();
}

/// The values of a species take about twice the bytes of its text.
std::size_t weight_of(const Atlas& bred) { return 3 * bred.entries().front().json.size(); }

/// The result of a cache lookup.
struct Requested {
    bool hit = false, stored = false;
};

/// Gets a value from a cache whose values are a shared_ptr<const T> or a variant with one.
template <class T, class Value>
std::shared_ptr<const T> ask(ComputingCache<Value>& cache, const std::string& key,
                             const std::function<std::shared_ptr<const T>()>& make,
                             const std::stop_token& stop, Requested& requested) {
    Value value = cache.get_or_compute(
        key, [&] { return Value(make()); }, stop, requested.hit);
    requested.stored = cache.cache().fits(cache.cache().weight(key, value));
    if constexpr (requires { std::get<std::shared_ptr<const T>>(value); })
        return std::get<std::shared_ptr<const T>>(value);
    else
        return value;
}

void count(std::atomic<std::uint64_t>& hits, std::atomic<std::uint64_t>& misses, bool hit) {
    ++(hit ? hits : misses);
}

}  // namespace

Store::Store(const ServiceOptions& options)
    : responses(options.cache_bytes,
                [](const CachedResponse& response) { return api::weight_of(*response); }),
      images(options.image_cache_bytes, [](const Painted& painted) { return weight_of(painted); }),
      morphs(options.morph_cache_bytes,
             [](const Morph& morph) { return morph->bytes() + sizeof(MorphSet); }),
      offspring(offspring_bytes, [](const Bred& bred) { return weight_of(*bred); }),
      grounds(options.world_cache_bytes / 4,
              [](const SharedGround& ground) { return ground->bytes(); }),
      worlds(options.world_cache_bytes / 4,
             [](const SharedWorld& world) { return world->bytes(); }),
      blocks(options.world_cache_bytes / 2, [](const BlockPart& part) { return weight_of(part); }),
      scene_parts(scene_cache_bytes, [](const ScenePart& part) { return weight_of(part); }) {
    if (options.store.empty()) return;
    // First those within, which the other one then leaves alone.
    scenes.emplace(options.store / "scenes", options.terrain_bytes, options.store_event);
    terrains.emplace(options.store / "terrains", options.terrain_bytes, options.store_event);
    directory.emplace(options.store, options.store_bytes, options.store_event);
}

void Store::measure() {
    const CacheStats of_responses = responses.stats(), of_images = images.cache().stats(),
                     of_morphs = morphs.cache().stats(), of_worlds = grounds.cache().stats(),
                     of_blocks = blocks.cache().stats();
    counters.glb_cache_bytes = of_responses.bytes;
    counters.glb_cache_entries = of_responses.entries;
    counters.glb_evictions = of_responses.evictions;
    counters.image_cache_bytes = of_images.bytes;
    counters.image_cache_entries = of_images.entries;
    counters.image_evictions = of_images.evictions;
    counters.morph_cache_bytes = of_morphs.bytes;
    counters.morph_cache_entries = of_morphs.entries;
    counters.morph_evictions = of_morphs.evictions;
    counters.world_cache_bytes = of_worlds.bytes;
    counters.world_cache_entries = of_worlds.entries;
    counters.world_evictions = of_worlds.evictions;
    counters.block_cache_bytes = of_blocks.bytes;
    counters.block_cache_entries = of_blocks.entries;
    counters.block_evictions = of_blocks.evictions;
    if (!directory) return;
    const DirectoryStats of_directory = directory->stats();
    counters.store_hits = of_directory.hits;
    counters.store_misses = of_directory.misses;
    counters.store_damaged = of_directory.damaged;
    counters.store_unwritten = of_directory.unwritten;
    counters.store_bytes = of_directory.bytes;
    counters.store_entries = of_directory.entries;
    counters.store_evictions = of_directory.evictions;
}

Caches cached_only(Store& store) {
    Caches caches;
    caches.morphs = [&store](const std::string& key, const std::function<Morph()>&) {
        if (std::optional<Morph> cached = store.morphs.cache().find(key)) return *std::move(cached);
        throw CacheMiss{key, {}};
    };
    caches.offspring = [&store](const std::string& key, const std::function<Bred()>&) {
        if (std::optional<Bred> cached = store.offspring.cache().find(key))
            return *std::move(cached);
        throw CacheMiss{key, {}};
    };
    return caches;
}

Caches computed_inline(Store& store) {
    Caches caches;
    caches.morphs = [&store](const std::string& key, const std::function<Morph()>& make) {
        const std::optional<Morph> cached = store.morphs.cache().find(key);
        count(store.counters.morph_hits, store.counters.morph_misses, cached.has_value());
        if (cached) return *cached;
        Morph generated = make();
        store.morphs.cache().insert(key, generated);
        return generated;
    };
    caches.offspring = [&store](const std::string& key, const std::function<Bred()>& make) {
        if (std::optional<Bred> cached = store.offspring.cache().find(key))
            return *std::move(cached);
        Bred generated = make();
        store.offspring.cache().insert(key, generated);
        return generated;
    };
    return caches;
}

SharedTerrain stored_terrain(Store& store, std::string_view id) {
    const std::optional<Slice> file = store.terrains ? store.terrains->find(id) : std::nullopt;
    std::optional<TerrainMap> terrain;
    if (file) terrain = terrain_in({file->data(), file->size});
    return terrain ? std::make_shared<const TerrainMap>(std::move(*terrain)) : nullptr;
}

SharedScene stored_scene(Store& store, std::string_view id) {
    const std::optional<Slice> file = store.scenes ? store.scenes->find(id) : std::nullopt;
    std::optional<Scene> scene;
    if (file) scene = scene_in({file->data(), file->size});
    return scene ? std::make_shared<const Scene>(std::move(*scene)) : nullptr;
}

SharedShape shape_in(Store& store, const std::string& key, const std::function<SharedShape()>& make,
                     const std::stop_token& stop) {
    Requested requested;
    return ask<SceneShape>(store.scene_parts, key, make, stop, requested);
}

SharedFungi fungi_in(Store& store, const std::string& key, const std::function<SharedFungi()>& make,
                     const std::stop_token& stop) {
    Requested requested;
    return ask<SceneFungi>(store.scene_parts, key, make, stop, requested);
}

std::string cache_member(std::string_view cache, bool hit, bool stored) {
    return std::string(cache) + (hit ? "; hit" : stored ? "; fwd=miss; stored" : "; fwd=miss");
}

JobContext::JobContext(Store& store, std::stop_token stop, const Observer& observer,
                       const Parallel& parallel)
    : store_(store) {
    execution_.observer = observer;
    execution_.parallel = parallel;
    execution_.stop = std::move(stop);
    execution_.caches.images = [this](const std::string& key, const std::function<Images()>& make) {
        Requested requested;
        const auto counted = [&] {
            Images set = make();
            ++store_.counters.painted;
            return set;
        };
        Images set = ask<ImageSet>(store_.images, key, counted, execution_.stop, requested);
        count(store_.counters.image_hits, store_.counters.image_misses, requested.hit);
        note(images_, cache_member("sporeprint-images", requested.hit, requested.stored));
        return set;
    };
    execution_.caches.paintings = [this](const std::string& key,
                                         const std::function<Painting()>& make) {
        Requested requested;
        Painting painting = ask<RawImages>(store_.images, key, make, execution_.stop, requested);
        count(store_.counters.painting_hits, store_.counters.painting_misses, requested.hit);
        return painting;
    };
    execution_.caches.morphs = [this](const std::string& key, const std::function<Morph()>& make) {
        Requested requested;
        Morph morph = ask<MorphSet>(store_.morphs, key, make, execution_.stop, requested);
        count(store_.counters.morph_hits, store_.counters.morph_misses, requested.hit);
        note(morphs_, cache_member("sporeprint-morph", requested.hit, requested.stored));
        return morph;
    };
    execution_.caches.offspring = [this](const std::string& key,
                                         const std::function<Bred()>& make) {
        Requested requested;
        return ask<Atlas>(store_.offspring, key, make, execution_.stop, requested);
    };
    execution_.caches.terrain = [this](std::string_view id) { return stored_terrain(store_, id); };
    execution_.caches.grounds = [this](const std::string& key,
                                       const std::function<SharedGround()>& make) {
        Requested requested;
        SharedGround ground = ask<Ground>(store_.grounds, key, make, execution_.stop, requested);
        count(store_.counters.ground_hits, store_.counters.ground_misses, requested.hit);
        note(worlds_, cache_member("sporeprint-worlds", requested.hit, requested.stored));
        return ground;
    };
    execution_.caches.worlds = [this](const std::string& key,
                                      const std::function<SharedWorld()>& make) {
        Requested requested;
        return ask<World>(store_.worlds, key, make, execution_.stop, requested);
    };
    execution_.caches.blocks = [this](const std::string& key,
                                      const std::function<SharedBlock()>& make) {
        return part_of<Block>(key, make);
    };
    execution_.caches.mycelia = [this](const std::string& key,
                                       const std::function<SharedMycelia()>& make) {
        return part_of<BlockMycelia>(key, make);
    };
    execution_.caches.seasons = [this](const std::string& key,
                                       const std::function<SharedSeason()>& make) {
        return part_of<BlockSeason>(key, make);
    };
    execution_.caches.trees = [this](const std::string& key,
                                     const std::function<SharedTree()>& make) {
        return part_of<TreeMeshes>(key, make);
    };
    execution_.caches.bodies = [this](const std::string& key,
                                      const std::function<SharedBody()>& make) {
        return part_of<BodyShape>(key, make);
    };
}

template <class Part>
std::shared_ptr<const Part> JobContext::part_of(
    const std::string& key, const std::function<std::shared_ptr<const Part>()>& make) {
    Requested requested;
    auto part = ask<Part>(store_.blocks, key, make, execution_.stop, requested);
    count(store_.counters.block_hits, store_.counters.block_misses, requested.hit);
    note(blocks_, cache_member("sporeprint-blocks", requested.hit, requested.stored));
    return part;
}

void JobContext::note(std::string& said, std::string member) {
    const std::lock_guard lock(mutex_);
    if (said.empty()) said = std::move(member);
}

void JobContext::count_known_morphs() {
    {
        const std::lock_guard lock(mutex_);
        if (!morphs_.empty()) return;
    }
    ++store_.counters.morph_hits;
    note(morphs_, cache_member("sporeprint-morph", true, false));
}

std::string JobContext::cache_status() const {
    const std::lock_guard lock(mutex_);
    std::string members;
    for (const std::string* one : {&worlds_, &blocks_, &morphs_, &images_}) {
        if (one->empty()) continue;
        if (!members.empty()) members += ", ";
        members += *one;
    }
    return members;
}

}  // namespace sporeprint::api
