// The caches of the service, their counters, and the context of a job that uses them.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <variant>

#include "api/cache/cache.h"
#include "api/cache/directory_store.h"
#include "api/cache/photos.h"
#include "api/http/response_builder.h"
#include "api/http/service_options.h"
#include "core/grow/execution_context.h"

namespace sporeprint {
struct Scene;
struct SceneShape;
struct SceneFungi;
}  // namespace sporeprint

namespace sporeprint::api {

using CachedResponse = std::shared_ptr<const Response>;
using Images = std::shared_ptr<const ImageSet>;
using Painting = std::shared_ptr<const RawImages>;
using Morph = std::shared_ptr<const MorphSet>;  ///< the correspondence of a set of species
using Bred = std::shared_ptr<const Atlas>;      ///< one bred species
using SharedTerrain = std::shared_ptr<const TerrainMap>;
using SharedGround = std::shared_ptr<const Ground>;
using SharedWorld = std::shared_ptr<const World>;
using SharedBlock = std::shared_ptr<const Block>;
using SharedMycelia = std::shared_ptr<const BlockMycelia>;
using SharedSeason = std::shared_ptr<const BlockSeason>;
using SharedTree = std::shared_ptr<const TreeMeshes>;
using SharedBody = std::shared_ptr<const BodyShape>;

/// The values of the cache of blocks of worlds, all within one budget.
using BlockPart = std::variant<SharedBlock, SharedMycelia, SharedSeason, SharedTree, SharedBody>;

using SharedScene = std::shared_ptr<const Scene>;
using SharedShape = std::shared_ptr<const SceneShape>;
using SharedFungi = std::shared_ptr<const SceneFungi>;

/// The values of the cache of uploaded scenes: their shapes, and their fungi in a climate.
using ScenePart = std::variant<SharedShape, SharedFungi>;

/// The values of the image cache: encoded files, and the paintings from which images of mixes are
/// blended. Both share one budget.
using Painted = std::variant<Images, Painting>;

/// The caches of a service. Thread-safe.
///
/// throws  InvalidInput from the constructor if the folder of finished files cannot be written
struct Store {
    explicit Store(const ServiceOptions& options);

    /// Copies the statistics of the caches (bytes, entries, evictions) into the counters.
    void measure();

    Cache<CachedResponse> responses;
    ComputingCache<Painted> images;
    ComputingCache<Morph> morphs;
    ComputingCache<Bred> offspring;
    ComputingCache<SharedGround> grounds;  ///< a quarter of the bytes for worlds
    ComputingCache<SharedWorld> worlds;    ///< likewise
    ComputingCache<BlockPart> blocks;      ///< the rest; also the meshes of trees and fruit bodies
    ComputingCache<ScenePart> scene_parts;
    std::optional<DirectoryStore> directory;  ///< only if the options name a folder
    std::optional<DirectoryStore> terrains;   ///< likewise: files of terrains by their ids
    std::optional<DirectoryStore>
        scenes;  ///< likewise: files of scenes, as many bytes as of terrains
    Counters counters;
    Photos photos{std::size_t{64} << 20U};
    /// A photograph is decoded by the holder of one: decoders take up to 200 MB each, so two run at once,
    /// whatever the number of threads.
    std::array<std::mutex, 2> decoders;
    /// How many photographs and other uploads there were so far; part of the keys of their jobs.
    std::atomic<std::uint64_t> photographs{0}, uploads{0};
};

/// Thrown by the Caches of cached_only() for a correspondence or an offspring that is not cached.
struct CacheMiss {
    std::string key;
    Cost cost;  ///< of computing it; set by the product that needs it
};

/// Returns Caches for plan() that return cached correspondences and offspring, and throw CacheMiss
/// for others. Lookups are not counted as hits or misses. Images are not cached.
[[nodiscard]] Caches cached_only(Store& store);

/// Returns Caches for plan() that compute missing ones on the calling thread, which takes milliseconds, without waiting for other threads that compute the same. Images are not
/// cached.
[[nodiscard]] Caches computed_inline(Store& store);

/// Returns a terrain that is stored, or null.
[[nodiscard]] SharedTerrain stored_terrain(Store& store, std::string_view id);

/// Returns a scene that is stored, or null.
[[nodiscard]] SharedScene stored_scene(Store& store, std::string_view id);

/// Returns the shape of a scene or its fungi, from the cache of scenes or computed.
[[nodiscard]] SharedShape shape_in(Store& store, const std::string& key,
                                   const std::function<SharedShape()>& make,
                                   const std::stop_token& stop);
[[nodiscard]] SharedFungi fungi_in(Store& store, const std::string& key,
                                   const std::function<SharedFungi()>& make,
                                   const std::stop_token& stop);

/// Returns the result of a lookup as a member of Cache-Status (RFC 9211): "sporeprint-images; hit",
/// or for a miss "sporeprint-images; fwd=miss; stored".
[[nodiscard]] std::string cache_member(std::string_view cache, bool hit, bool stored);

/// The resources of one job: an ExecutionContext whose Caches use the store, and the results of
/// lookups. The Caches may be used on several threads.
class JobContext {
  public:
    JobContext(Store& store, std::stop_token stop, const Observer& observer,
               const Parallel& parallel);
    JobContext(const JobContext&) = delete;
    JobContext& operator=(const JobContext&) = delete;

    [[nodiscard]] const ExecutionContext& execution() const { return execution_; }

    /// Returns the members of Cache-Status for the caches that were used, from the first lookup of
    /// each: later lookups find what the job itself has inserted. Empty if none was used.
    [[nodiscard]] std::string cache_status() const;

    /// Counts a correspondence that was found in its cache before the job began, unless the job has
    /// looked one up itself.
    void count_known_morphs();

  private:
    void note(std::string& said, std::string member);
    /// Returns a part of a block of a world, from the cache of blocks or computed.
    template <class Part>
    [[nodiscard]] std::shared_ptr<const Part> part_of(
        const std::string& key, const std::function<std::shared_ptr<const Part>()>& make);

    Store& store_;
    ExecutionContext execution_;
    mutable std::mutex mutex_;
    std::string morphs_, images_, worlds_, blocks_;  ///< guarded by mutex_
};

}  // namespace sporeprint::api
