// The hot-response table: complete responses that the reactor sends by itself, without a worker.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "core/bytes.h"
#include "server/http/head.h"
#include "server/http/head_codec.h"

namespace sporeprint::server {

/// The clients that a response is for: all, those that do not accept gzip, or those that do.
enum class Coding { any, identity, gzip };

/// A stored 200 response. Its head lacks the headers that differ per request: Date, X-Request-Id
/// and Connection.
struct HotResponse {
    std::string target;
    std::string head;          ///< status line and headers, each with its CR LF
    std::string not_modified;  ///< head of the 304 response; empty if there is no ETag
    std::string keep_alive;    ///< the Keep-Alive line
    std::string etag, cache, cache_not_modified, label;
    std::string identity_etag;  ///< if this is gzip: ETag of the identity variant
    Coding coding = Coding::any;
    bool has_request_id = false;  ///< it has an X-Request-Id header
    Body body;                    ///< empty if `file` is set
    int file = -1;                ///< copy of a large body in an in-memory file, for sendfile()
    std::size_t size = 0;         ///< of the body

    HotResponse() = default;
    HotResponse(const HotResponse&) = delete;
    HotResponse& operator=(const HotResponse&) = delete;
    ~HotResponse();

    [[nodiscard]] std::size_t weight() const;  ///< bytes, including the shared body
};

/// Returns the stored form of a response to GET `target`; nullptr if it is not cacheable, its
/// status is not 200, it varies by a header other than Accept-Encoding, or it closes the
/// connection.
[[nodiscard]] std::shared_ptr<const HotResponse> hot_response(std::string_view target,
                                                              const Sending& sending,
                                                              std::string_view label);

/// The parts of a request head that a lookup needs.
struct HotLookup {
    bool simple = false;  ///< GET or HEAD without headers that the table does not handle
    std::string_view accept_encoding, id;  ///< empty if absent

    /// Returns the list of all If-None-Match lines; empty if there are none.
    [[nodiscard]] std::string_view if_none_match() const {
        return lines.empty() ? std::string_view(line) : std::string_view(lines);
    }
    std::string_view line;  ///< the first If-None-Match line
    std::string lines;      ///< all of them joined, if there are several
};
[[nodiscard]] HotLookup hot_lookup(const Head& head);

/// A table of responses, bounded by bytes. Used on one thread. A target has one response for all
/// clients, or one for clients that accept gzip and one for the others. Small bodies are shared
/// with the caches of the service, but counted here in full like the copies of large ones, since
/// this table alone keeps those that the caches have evicted.
///
/// source  [Zhang2024] SIEVE: one queue, a visited bit per entry, and a hand that clears the bits
class HotTable {
  public:
    /// Counters that any thread may read.
    struct Stats {
        std::atomic<std::uint64_t> hits{0}, not_modified{0}, evictions{0};
        std::atomic<std::size_t> bytes{0}, entries{0};
    };

    explicit HotTable(std::size_t budget) : budget_(budget) {}

    /// Returns the response to a target for a client with this Accept-Encoding, or nullptr. Every
    /// 256th lookup of an entry misses on purpose, so that the caches of the service see which
    /// entries are in use.
    [[nodiscard]] const std::shared_ptr<const HotResponse>* find(
        std::string_view target, std::string_view accept_encoding = {});

    /// Returns true if the response of a target is pinned.
    [[nodiscard]] bool is_pinned(std::string_view target) const;

    /// Stores a response, replacing an earlier one and evicting others as needed. A response larger
    /// than an eighth of the budget is not stored.
    void insert(std::shared_ptr<const HotResponse> response);

    /// Stores a response that is never evicted and does not count against the budget.
    void insert_pinned(std::shared_ptr<const HotResponse> response);

    /// Removes all responses that are not pinned.
    void clear();

    [[nodiscard]] Stats& stats() { return stats_; }
    [[nodiscard]] const Stats& stats() const { return stats_; }

  private:
    struct Entry {
        std::shared_ptr<const HotResponse> response;
        std::size_t weight = 0;
        std::uint32_t uses = 0;
        bool visited = false;
        bool pinned = false;
    };
    using List = std::list<Entry>;

    /// The responses of one target; both are equal if it is for all clients.
    struct Variants {
        std::optional<List::iterator> identity, gzip;
    };

    void add(std::shared_ptr<const HotResponse> response, std::size_t weight, bool pinned);
    void drop(List::iterator entry);
    void evict();

    std::size_t budget_;
    List list_;    ///< newest first
    List pinned_;  ///< never evicted
    List::iterator hand_ = list_.end();
    std::unordered_map<std::string_view, Variants> map_;  ///< keys point into the responses
    Stats stats_;
};

}  // namespace sporeprint::server
