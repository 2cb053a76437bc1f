// What is kept between requests: the caches, what they count, and how a job borrows them.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <variant>

#include "api/cache/cache.h"
#include "api/cache/directory_store.h"
#include "api/http/response_builder.h"
#include "api/http/service_options.h"
#include "core/grow/execution_context.h"

namespace sporeprint::api {

using CachedResponse = std::shared_ptr<const Response>;
using Images = std::shared_ptr<const ImageSet>;
using Painting = std::shared_ptr<const RawImages>;
using Morph = std::shared_ptr<const MorphSet>;

/// What the image cache keeps: files as they are sent, and the paintings that mixes are dissolved from. One budget for both.
using Painted = std::variant<Images, Painting>;

/// The caches of a service. Thread-safe.
///
/// throws  InvalidInput from the constructor if the folder of finished files cannot be written
struct Store {
    explicit Store(const ServiceOptions& options);

    /// Reads the sizes of the caches into the counters.
    void measure();

    Cache<CachedResponse> responses;
    ComputingCache<Painted> images;
    ComputingCache<Morph> morphs;
    std::optional<DirectoryStore> directory;  ///< none unless asked for
    Counters counters;
    std::atomic<std::uint64_t> inspections{0};  ///< uploads so far, to tell them apart
};

/// Thrown by `cached_only` for what is not kept.
struct CacheMiss {
    std::string key;
    Cost cost;  ///< of finding it; told by whoever knows what was asked for
};

/// A Memo for plan(): finds what is kept, throws CacheMiss where something would have to be made. Counts nothing.
[[nodiscard]] Caches cached_only(Store& store);

/// A Memo for plan(): makes the correspondences that are not kept, a millisecond each, and waits for nobody who makes the same.
[[nodiscard]] Caches computed_inline(Store& store);

/// What a cache said, as a member of Cache-Status: "sporeprint-images; fwd=miss; stored".
[[nodiscard]] std::string cache_member(std::string_view cache, bool hit, bool stored);

/// What one job borrows: a Workshop whose Memo asks the caches, and what they said. The Memo may be asked on several threads.
class JobContext {
  public:
    JobContext(Store& store, std::stop_token stop, const Observer& observer,
               const Parallel& parallel);
    JobContext(const JobContext&) = delete;
    JobContext& operator=(const JobContext&) = delete;

    [[nodiscard]] const ExecutionContext& execution() const { return execution_; }

    /// Members of Cache-Status of the caches that were asked, those of the first answers: what is asked twice in one job was
    /// not there before it. Empty if none was.
    [[nodiscard]] std::string cache_status() const;

  private:
    void note(std::string& said, std::string member);

    Store& store_;
    ExecutionContext execution_;
    mutable std::mutex mutex_;
    std::string morphs_, images_;  ///< guarded by mutex_
};

}  // namespace sporeprint::api
