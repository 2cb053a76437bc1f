// Answers that the reactor gives by itself: those that whoever asks for the same target gets again,
// ready to be sent. Used on one thread.
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

/// Which clients an answer is for: all, those that accept no gzip, or those that do.
enum class Coding { any, identity, gzip };

/// A 200 in pieces. Its head lacks what changes with each request: Date, X-Request-Id, Connection.
struct HotResponse {
    std::string target;
    std::string head;          ///< status line and headers, each with its CR LF
    std::string not_modified;  ///< the head of a 304 likewise; empty when there is no ETag
    std::string keep_alive;    ///< the line that says so
    std::string etag, cache, cache_not_modified, label;
    std::string identity_etag;  ///< of the same without gzip, when this is gzip; else empty
    Coding coding = Coding::any;
    bool tells_id = false;  ///< whether it carries X-Request-Id
    Body body;              ///< or, when it is large,
    int file = -1;          ///< a copy of it in a file in memory, which goes out without another
    std::size_t size = 0;   ///< of the body

    HotResponse() = default;
    HotResponse(const HotResponse&) = delete;
    HotResponse& operator=(const HotResponse&) = delete;
    ~HotResponse();

    [[nodiscard]] std::size_t weight() const;  ///< bytes, those of its body too, though shared
};

/// What of the answer to GET `target` may be given again; nullptr when it may not: when nobody has
/// said so, the status is another than 200, it varies by another header than Accept-Encoding, or the
/// connection ends with it.
[[nodiscard]] std::shared_ptr<const HotResponse> hot_response(std::string_view target,
                                                              const Sending& sending,
                                                              std::string_view label);

/// What a request's head asks of the table.
struct HotLookup {
    bool simple = false;  ///< GET or HEAD, and nothing in the head could change the answer
    std::string_view accept_encoding, id;  ///< empty when not given

    /// The list of If-None-Match, all its lines together; empty when not given.
    [[nodiscard]] std::string_view if_none_match() const {
        return lines.empty() ? std::string_view(line) : std::string_view(lines);
    }
    std::string_view line;  ///< the first of them
    std::string lines;      ///< all, when there are several
};
[[nodiscard]] HotLookup hot_lookup(const Head& head);

/// A table bounded by bytes. A target has one answer for all clients, or one for those that accept
/// gzip and one for the others. Small bodies are shared with caches behind it, but counted here in full
/// like the copies of large ones, as what those have dropped is kept by this table alone.
///
/// source  [Zhang2024] SIEVE: one queue, a bit for those in use, a hand that passes over them once
class HotTable {
  public:
    /// What others may read at any time.
    struct Stats {
        std::atomic<std::uint64_t> hits{0}, not_modified{0}, evictions{0};
        std::atomic<std::size_t> bytes{0}, entries{0};
    };

    explicit HotTable(std::size_t budget) : budget_(budget) {}

    /// The answer for a target and a client with this Accept-Encoding, or nullptr. Now and then it
    /// has none for one that it holds, so that the caches behind it learn what is in use.
    [[nodiscard]] const std::shared_ptr<const HotResponse>* find(
        std::string_view target, std::string_view accept_encoding = {});

    /// Whether a target's answer is pinned.
    [[nodiscard]] bool occupied(std::string_view target) const;

    /// Keeps an answer in place of an earlier one, and drops others to make room. One of more than
    /// an eighth of the budget is not kept.
    void insert(std::shared_ptr<const HotResponse> response);

    /// Keeps an answer for good; it counts nothing.
    void pin(std::shared_ptr<const HotResponse> response);

    /// Drops all that are not pinned.
    void clear();

    [[nodiscard]] Stats& stats() { return stats_; }
    [[nodiscard]] const Stats& stats() const { return stats_; }

  private:
    struct Entry {
        std::shared_ptr<const HotResponse> response;
        std::size_t weight = 0;
        std::uint32_t uses = 0;
        bool pending_seen = false;
        bool pinned = false;
    };
    using List = std::list<Entry>;

    /// The answers of one target: the same twice if it is for all clients.
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
    std::unordered_map<std::string_view, Variants> map_;  ///< keys live in the answers
    Stats stats_;
};

}  // namespace sporeprint::server
