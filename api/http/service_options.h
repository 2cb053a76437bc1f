// Options, counters and timings of the service, as plain data for all parts of it.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "core/grow/execution_context.h"

namespace sporeprint::api {

struct StoreEvent;

struct ServiceOptions {
    std::size_t cache_bytes = 256u << 20;
    std::size_t image_cache_bytes = 128u << 20;
    std::size_t morph_cache_bytes = 16u << 20;
    std::size_t world_cache_bytes = 128u << 20;
    std::filesystem::path assets;  ///< folder of the built page; empty for none
    std::filesystem::path store;   ///< folder in which generated files are stored; empty for none
    std::uint64_t store_bytes = std::uint64_t{1} << 30;
    std::uint64_t terrain_bytes = std::uint64_t{512} << 20;  ///< of terrains, in that folder too
    /// Called on any thread, also concurrently; may be empty.
    std::function<void(const StoreEvent&)> store_event;
    std::string allow_origin = "*";
    std::string base_path;     ///< path under which clients see the service: "" or "/a/b"
    bool signed_urls = false;  ///< URLs need a signature; responses contain none
    bool has_library = false;  ///< of users' species; set by the Service
    std::uint64_t most_vertices = 2'000'000;             ///< budget of one request
    std::uint64_t most_texels = 5 * 3u * 2048u * 2048u;  ///< 3 bytes each: 189 MB
};

/// Counters since the start of the process; may be read at any time.
struct Counters {
    std::atomic<std::uint64_t> generated{0}, painted{0};
    std::atomic<std::uint64_t> glb_hits{0}, glb_misses{0}, glb_not_modified{0};
    std::atomic<std::uint64_t> image_hits{0}, image_misses{0};
    std::atomic<std::uint64_t> painting_hits{0}, painting_misses{0};  ///< cached beside the images
    std::atomic<std::uint64_t> morph_hits{0}, morph_misses{0};
    std::atomic<std::uint64_t> ground_hits{0}, ground_misses{0};
    std::atomic<std::uint64_t> block_hits{0}, block_misses{0};
    std::atomic<std::uint64_t> glb_cache_bytes{0}, glb_cache_entries{0}, glb_evictions{0};
    std::atomic<std::uint64_t> image_cache_bytes{0}, image_cache_entries{0}, image_evictions{0};
    std::atomic<std::uint64_t> morph_cache_bytes{0}, morph_cache_entries{0}, morph_evictions{0};
    std::atomic<std::uint64_t> world_cache_bytes{0}, world_cache_entries{0}, world_evictions{0};
    std::atomic<std::uint64_t> block_cache_bytes{0}, block_cache_entries{0}, block_evictions{0};
    std::atomic<std::uint64_t> store_hits{0}, store_misses{0}, store_damaged{0}, store_unwritten{0};
    std::atomic<std::uint64_t> store_bytes{0}, store_entries{0}, store_evictions{0};
};

/// How a response was computed, for Cache-Status: by its own job, or by one that another request
/// had started.
enum class Outcome { generated, collapsed };

/// Milliseconds per step, for Server-Timing; negative means not taken.
struct Timing {
    double queue = -1;
    std::array<double, all_steps.size()> of_steps = filled(-1.0);  ///< in the order of `all_steps`

    /// Calls visit(name, milliseconds) for each step that was measured.
    void each(auto visit) const {
        if (queue >= 0) visit("queue", queue);
        for (std::size_t i = 0; i < all_steps.size(); ++i)
            if (of_steps[i] >= 0) visit(name(all_steps[i]), of_steps[i]);
    }

  private:
    static constexpr std::array<double, all_steps.size()> filled(double value) {
        std::array<double, all_steps.size()> all{};
        all.fill(value);
        return all;
    }
};

}  // namespace sporeprint::api
