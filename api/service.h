// The meaning of the service: plan() answers what it can in microseconds and describes the rest as a Job.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <variant>

#include "api/http.h"
#include "core/atlas/atlas.h"

namespace sporeprint::api {

struct StoreEvent;

struct ServiceOptions {
    std::size_t cache_bytes = 256u << 20;
    std::size_t image_cache_bytes = 128u << 20;
    std::size_t morph_cache_bytes = 16u << 20;
    std::filesystem::path assets;  ///< folder of the built page; empty for none
    std::filesystem::path store;   ///< folder that finished files are kept in; empty for none
    std::uint64_t store_bytes = std::uint64_t{1} << 30;
    std::function<void(const StoreEvent&)>
        store_event;  ///< called on any thread, several at once; may be empty
    std::string allow_origin = "*";
    std::string base_path;          ///< under which clients see the service: "" or "/a/b"
    bool signed_addresses = false;  ///< only who holds a key makes addresses; so answers tell none
    std::uint64_t most_vertices = 2'000'000;             ///< budget of one request
    std::uint64_t most_texels = 5 * 3u * 2048u * 2048u;  ///< three bytes each: 189 MB
};

/// Counted since start; read at any time.
struct Counters {
    std::atomic<std::uint64_t> generated{0}, painted{0};
    std::atomic<std::uint64_t> glb_hits{0}, glb_misses{0}, glb_not_modified{0};
    std::atomic<std::uint64_t> image_hits{0}, image_misses{0};
    std::atomic<std::uint64_t> painting_hits{0}, painting_misses{0};  ///< kept beside the images
    std::atomic<std::uint64_t> morph_hits{0}, morph_misses{0};
    std::atomic<std::uint64_t> glb_cache_bytes{0}, glb_cache_entries{0}, glb_evictions{0};
    std::atomic<std::uint64_t> image_cache_bytes{0}, image_cache_entries{0}, image_evictions{0};
    std::atomic<std::uint64_t> morph_cache_bytes{0}, morph_cache_entries{0}, morph_evictions{0};
    std::atomic<std::uint64_t> store_hits{0}, store_misses{0}, store_damaged{0}, store_unwritten{0};
    std::atomic<std::uint64_t> store_bytes{0}, store_entries{0}, store_evictions{0};
};

/// How a planned job came to its answer, for Cache-Status.
enum class Outcome { made, collapsed };

/// Milliseconds per step, for Server-Timing; negative means not taken.
struct Timing {
    double queue = -1, resolve = -1, build = -1, paint = -1, pack = -1;
};

class Service {
  public:
    Service(std::shared_ptr<const Atlas> atlas, const ServiceOptions& options);

    /// The same with other templates, to take its place: options, counters and what is kept are common to both. Keys tell what
    /// was made of which templates. The folder of the page is read anew.
    Service(std::shared_ptr<const Atlas> atlas, const Service& other);
    ~Service();
    Service(const Service&) = delete;
    Service& operator=(const Service&) = delete;

    /// Parses, checks, makes the canonical text, compares ETags, looks into the caches. Never blocks, never throws.
    ///
    /// prepared  a correspondence that the answer needs and that is not kept is made here, in milliseconds; otherwise that is
    ///           a Job that `prepares`
    [[nodiscard]] std::variant<Answer, Job> plan(const Request& request, bool prepared = false);

    /// Called once per flight with what the job returned: fills the cache.
    void finish(const Key& key, const Answer& answer);

    /// The shared answer of a job made ready for one of those who waited (Cache-Status, Server-Timing, request id; no body for HEAD).
    [[nodiscard]] Answer deliver(const Request& request, const Answer& shared, Outcome outcome,
                                 const Timing& timing) const;

    /// problem+json for faults that are found before or beside plan() (408, 413, 414, 429, 431, 500, 503, 504 …).
    [[nodiscard]] Answer problem(const Request& request, int status, std::string_view detail,
                                 const std::vector<Header>& extra = {}) const;

    /// An exception thrown by Job::run as an answer (the one table); unknown exceptions are 500 without detail.
    [[nodiscard]] Answer problem(const Request& request, std::exception_ptr error) const;

    /// Grows one mushroom, to know that it can: for /readyz.
    [[nodiscard]] bool self_test();

    /// The final answer to a request whose body has not come yet, if its head alone decides: 400, 404, 405, 413, 414, 415.
    [[nodiscard]] std::optional<Answer> answer_to_head(const Request& request) const;

    /// What plan() takes to read the body of a request, whether it is refused, kept or to be made;
    /// nothing for most.
    [[nodiscard]] Cost cost_of_reading(const Request& request) const;

    /// Whether a body of this size may come to this target (413), in bytes.
    [[nodiscard]] std::size_t most_body(std::string_view method, std::string_view target) const;

    [[nodiscard]] const Counters& counters() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// plan() on a thread that may take milliseconds: never a Job that `prepares`.
[[nodiscard]] std::variant<Answer, Job> plan_here(Service& service, const Request& request);

/// plan + run inline: HTTP behaviour without sockets, for tests and tools.
[[nodiscard]] Answer handle(Service& service, const Request& request);

}  // namespace sporeprint::api
