// A cache bounded by bytes with the S3-FIFO policy: keys that are used once cannot evict keys that
// are used often.
#pragma once

#include <algorithm>
#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/problems.h"

namespace sporeprint::api {

/// Returns the hash of a key, for shards and buckets. The maps compare whole keys, so a collision
/// costs time but never returns a wrong value.
[[nodiscard]] std::uint64_t hash_of(std::string_view key);

/// Bytes of an entry beside its value and key: map and list nodes, and its hash in the ghost queue.
inline constexpr std::size_t entry_overhead = 256;

struct CacheStats {
    std::uint64_t hits = 0, misses = 0, evictions = 0, refused = 0;
    std::uint64_t bytes = 0, entries = 0;
};

/// Thread-safe map from canonical text to a value. `Value` is cheap to copy (a shared_ptr).
///
/// source  [Yang2023] S3-FIFO, algorithm 1: a small queue (a tenth) that most keys never leave, a
///         main queue (the rest) with second chances, a ghost queue of hashes; differs: sizes are
///         bytes, and a value larger than the small queue enters the main queue directly.
template <class Value>
class Cache {
  public:
    /// Returns the bytes of a value, without key and overhead.
    using SizeOf = std::function<std::size_t(const Value&)>;

    /// budget  bytes of all entries; divided among one shard per 64 MB, at least one and at most
    ///         eight, so that the largest object (an eighth of the whole budget) fits into a shard
    Cache(std::size_t budget, SizeOf estimate_cost)
        : size_of_(std::move(estimate_cost)), most_(budget / 8) {
        const std::size_t count = std::clamp<std::size_t>(budget >> 26, 1, 8);
        for (std::size_t i = 0; i < count; ++i) {
            shards_.push_back(std::make_unique<Shard>());
            shards_.back()->budget = budget / count;
        }
    }

    /// Returns the value cached under `key`, if there is one. Counts as a use.
    [[nodiscard]] std::optional<Value> find(std::string_view key) {
        Shard& shard = shard_of(key);
        const std::lock_guard lock(shard.mutex);
        const auto found = shard.map.find(key);
        if (found == shard.map.end()) {
            ++shard.stats.misses;
            return std::nullopt;
        }
        ++shard.stats.hits;
        Entry& entry = *found->second;
        entry.uses = static_cast<std::uint8_t>(std::min(entry.uses + 1, 3));
        return entry.value;
    }

    /// Returns true if find() would return a value; does not count as a use.
    [[nodiscard]] bool holds(std::string_view key) const {
        const Shard& shard = shard_of(key);
        const std::lock_guard lock(shard.mutex);
        return shard.map.find(key) != shard.map.end();
    }

    /// Returns the bytes of the budget that an entry takes.
    [[nodiscard]] std::size_t weight(std::string_view key, const Value& value) const {
        return size_of_(value) + key.size() + entry_overhead;
    }

    /// Returns true if insert() accepts an entry of this weight(), in bytes: at most an eighth of
    /// the whole budget.
    [[nodiscard]] bool fits(std::size_t bytes) const { return bytes <= most_; }

    /// Inserts a value and evicts others until it fits. Equal keys mean equal values, so an entry
    /// that exists stays.
    ///
    /// returns  false if it is too large for the cache
    bool insert(std::string_view key, Value value) {
        const std::size_t bytes = weight(key, value);
        const std::uint64_t hash = hash_of(key);
        Shard& shard = *shards_[hash % shards_.size()];
        // Destroyed after the lock is released, since freeing megabytes takes time.
        std::vector<Value> dropped;
        const std::lock_guard lock(shard.mutex);
        if (!fits(bytes)) {
            ++shard.stats.refused;
            return false;
        }
        if (shard.map.find(key) != shard.map.end()) return true;
        const bool seen_before = shard.forget(hash);
        while (shard.small.bytes + shard.main.bytes + bytes > shard.budget) shard.evict(dropped);
        Queue& queue = seen_before || bytes > shard.budget / 10 ? shard.main : shard.small;
        queue.list.push_front(Entry{std::string(key), hash, bytes, 0, std::move(value)});
        queue.bytes += bytes;
        shard.map.emplace(queue.list.front().key, queue.list.begin());
        return true;
    }

    [[nodiscard]] CacheStats stats() const {
        CacheStats sum;
        for (const auto& shard : shards_) {
            const std::lock_guard lock(shard->mutex);
            sum.hits += shard->stats.hits;
            sum.misses += shard->stats.misses;
            sum.evictions += shard->stats.evictions;
            sum.refused += shard->stats.refused;
            sum.bytes += shard->small.bytes + shard->main.bytes;
            sum.entries += shard->map.size();
        }
        return sum;
    }

  private:
    struct Entry {
        std::string key;
        std::uint64_t hash = 0;
        std::size_t bytes = 0;
        std::uint8_t uses = 0;
        Value value;
    };
    using List = std::list<Entry>;
    struct Queue {
        List list;  ///< newest first
        std::size_t bytes = 0;
    };
    struct Spread {
        std::size_t operator()(std::string_view key) const { return hash_of(key); }
    };

    struct Shard {
        mutable std::mutex mutex;
        std::size_t budget = 0;
        Queue small, main;
        /// Its keys point into the entries.
        std::unordered_map<std::string_view, typename List::iterator, Spread> map;
        /// Hashes and serials, oldest first.
        std::deque<std::pair<std::uint64_t, std::uint64_t>> ghosts;
        /// The current serial of each hash.
        std::unordered_map<std::uint64_t, std::uint64_t> ghost_serials;
        std::uint64_t next_serial = 0;
        CacheStats stats;

        /// Removes a hash from the ghosts. Returns true if it was one. Its place in the queue
        /// expires by itself.
        bool forget(std::uint64_t hash) { return ghost_serials.erase(hash) > 0; }

        void add_ghost(std::uint64_t hash) {
            ghosts.emplace_back(hash, next_serial);
            ghost_serials[hash] = next_serial++;
            while (ghosts.size() > std::max<std::size_t>(64, main.list.size())) {
                const auto [oldest, serial] = ghosts.front();
                const auto found = ghost_serials.find(oldest);
                if (found != ghost_serials.end() && found->second == serial)
                    ghost_serials.erase(found);
                ghosts.pop_front();
            }
        }

        void drop(Queue& queue, std::vector<Value>& dropped) {
            Entry& last = queue.list.back();
            map.erase(last.key);
            queue.bytes -= last.bytes;
            dropped.push_back(std::move(last.value));
            queue.list.pop_back();
            ++stats.evictions;
        }

        /// Does one step of eviction: evicts an entry, moves one from the small to the main queue,
        /// or gives one a second chance.
        void evict(std::vector<Value>& dropped) {
            if (small.list.empty() || main.bytes > budget - budget / 10) {
                Entry& last = main.list.back();
                if (last.uses == 0) return drop(main, dropped);
                --last.uses;
                main.list.splice(main.list.begin(), main.list, std::prev(main.list.end()));
                return;
            }
            Entry& last = small.list.back();
            if (last.uses > 1) {
                last.uses = 0;
                small.bytes -= last.bytes;
                main.bytes += last.bytes;
                main.list.splice(main.list.begin(), small.list, std::prev(small.list.end()));
                return;
            }
            add_ghost(last.hash);
            drop(small, dropped);
        }
    };

    [[nodiscard]] Shard& shard_of(std::string_view key) const {
        return *shards_[hash_of(key) % shards_.size()];
    }

    SizeOf size_of_;
    std::size_t most_;
    std::vector<std::unique_ptr<Shard>> shards_;
};

/// A cache that computes missing values, once for all concurrent callers (single flight).
template <class Value>
class ComputingCache {
  public:
    ComputingCache(std::size_t budget, typename Cache<Value>::SizeOf estimate_cost)
        : cache_(budget, std::move(estimate_cost)) {}

    [[nodiscard]] Cache<Value>& cache() { return cache_; }
    [[nodiscard]] const Cache<Value>& cache() const { return cache_; }

    /// Returns the value cached under `key`, or computes it with `make`; sets `hit` to true if it
    /// was cached or computed by another thread.
    ///
    /// `make` is called outside every lock, by one thread per key; other threads wait for it. If it
    /// throws, its own caller gets the exception and each waiting thread tries again itself. A
    /// failure is never cached. A thread that needs the key which it is computing calls `make` at
    /// once.
    ///
    /// throws  the exceptions of `make`; Cancelled if `stop` is requested while waiting
    Value get_or_compute(std::string_view key, const std::function<Value()>& make,
                         std::stop_token stop, bool& hit) {
        for (;;) {
            if (std::optional<Value> cached = cache_.find(key)) {
                hit = true;
                return *std::move(cached);
            }
            std::shared_ptr<Computation> computation;
            bool leads = false;
            {
                const std::lock_guard lock(mutex_);
                const auto found = in_flight_.find(key);
                if (found == in_flight_.end()) {
                    leads = true;
                    computation = std::make_shared<Computation>();
                    computation->leader = std::this_thread::get_id();
                    in_flight_.emplace(std::string(key), computation);
                } else {
                    computation = found->second;
                }
            }
            hit = false;
            if (leads) return lead(key, *computation, make, hit);
            if (computation->leader == std::this_thread::get_id()) return make();
            std::unique_lock lock(computation->mutex);
            if (!computation->completed.wait(lock, stop, [&] { return computation->done; }))
                throw Cancelled();
            if (computation->value) {
                hit = true;
                return *computation->value;
            }
        }
    }

  private:
    struct Computation {
        std::thread::id leader;
        std::mutex mutex;
        std::condition_variable_any completed;
        bool done = false;
        std::optional<Value> value;
    };

    Value lead(std::string_view key, Computation& computation, const std::function<Value()>& make,
               bool& hit) {
        // Another computation may have completed between the lookup and the start of this one: look
        // again.
        std::optional<Value> generated;
        try {
            generated = cache_.holds(key) ? cache_.find(key) : std::nullopt;
            hit = generated.has_value();
            if (!generated) generated = make();
            cache_.insert(key, *generated);
        } catch (...) {
            complete(key, computation, std::nullopt);
            throw;
        }
        complete(key, computation, generated);
        return *std::move(generated);
    }

    void complete(std::string_view key, Computation& computation, std::optional<Value> value) {
        {
            const std::lock_guard lock(mutex_);
            in_flight_.erase(in_flight_.find(key));
        }
        const std::lock_guard lock(computation.mutex);
        computation.value = std::move(value);
        computation.done = true;
        computation.completed.notify_all();
    }

    Cache<Value> cache_;
    std::mutex mutex_;
    std::map<std::string, std::shared_ptr<Computation>, std::less<>> in_flight_;
};

}  // namespace sporeprint::api
