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

#include "api/answers.h"
#include "api/cache.h"
#include "api/directory_store.h"
#include "api/service.h"
#include "core/grow/execution_context.h"

namespace sporeprint::api {

using Kept = std::shared_ptr<const Answer>;
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

    Cache<Kept> answers;
    RememberingCache<Painted> images;
    RememberingCache<Morph> morphs;
    std::optional<DirectoryStore> directory;  ///< none unless asked for
    Counters counters;
    std::atomic<std::uint64_t> inspections{0};  ///< uploads so far, to tell them apart
};

/// Thrown by `kept_only` for what is not kept.
struct NotKept {
    std::string key;
    Cost cost;  ///< of finding it; told by whoever knows what was asked for
};

/// A Memo for plan(): finds what is kept, throws NotKept where something would have to be made. Counts nothing.
[[nodiscard]] Memo kept_only(Store& store);

/// A Memo for plan(): makes the correspondences that are not kept, a millisecond each, and waits for nobody who makes the same.
[[nodiscard]] Memo made_at_once(Store& store);

/// What a cache said, as a member of Cache-Status: "sporeprint-images; fwd=miss; stored".
[[nodiscard]] std::string cache_member(std::string_view cache, bool hit, bool stored);

/// What one job borrows: a Workshop whose Memo asks the caches, and what they said. The Memo may be asked on several threads.
class Loan {
  public:
    Loan(Store& store, std::stop_token stop, const Observer& observer, const Parallel& parallel);
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;

    [[nodiscard]] const Workshop& workshop() const { return workshop_; }

    /// Members of Cache-Status of the caches that were asked, those of the first answers: what is asked twice in one job was
    /// not there before it. Empty if none was.
    [[nodiscard]] std::string cache_status() const;

  private:
    void note(std::string& said, std::string member);

    Store& store_;
    Workshop workshop_;
    mutable std::mutex mutex_;
    std::string morphs_, images_;  ///< guarded by mutex_
};

}  // namespace sporeprint::api
