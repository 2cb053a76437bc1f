// Work budgets: a token bucket per payer from which the cost of its requests is taken.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>

#include "server/http/addresses.h"

namespace sporeprint::server {

/// Settings of all token buckets. Work is measured in microseconds of one processor.
struct BudgetOptions {
    std::uint64_t rate = 0;   ///< work per second that flows in, at most 1e9; 0: no budgets
    std::uint64_t burst = 1;  ///< work that a full bucket holds, at most 1e12
    std::size_t most_clients = 1 << 16;  ///< in the table; about 200 bytes each
};

/// Who pays for work: an owner of the library, wherever the requests come from, or else a client.
struct Payer {
    std::string owner;  ///< empty for nobody
    Address client;     ///< client_of() an address; :: for an owner

    Payer() = default;
    Payer(const Address& of) : client(of) {}
    explicit Payer(std::string of) : owner(std::move(of)) {}
    bool operator==(const Payer&) const = default;
    bool operator<(const Payer& other) const {
        return owner != other.owner ? owner < other.owner : client < other.client;
    }
};

/// The token buckets of all payers. Thread-safe; the caller supplies the time.
///
/// A payer may spend if its bucket holds the requested work or is full. A single job larger than
/// the bucket is therefore admitted when the bucket is full, and its level becomes negative. So in
/// any time t, from a full bucket on, a client spends at most rate t + max(burst, largest job).
///
/// Levels are integers in millionths and times integers in microseconds, so rounding loses nothing.
/// When the table is full, the payer whose bucket has been full longest is removed, which changes no
/// budget; if no bucket is full, the one whose bucket would be full soonest.
class Budgets {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// pre  options.rate >= 1
    explicit Budgets(const BudgetOptions& options);

    /// Takes `work` (microseconds) from a payer's bucket if it holds that much or is full;
    /// otherwise takes nothing.
    ///
    /// now      a time earlier than that of a previous call counts as the previous one
    /// returns  zero if the work was taken; otherwise how long until it can be
    [[nodiscard]] std::chrono::microseconds spend(const Payer& payer, std::uint64_t work, Time now);

    /// Takes the cost of work that is already done, whether or not the bucket holds it; its level
    /// may become negative.
    void owe(const Payer& payer, std::uint64_t work, Time now);

    /// Refunds work that was taken from a payer's bucket but not begun, up to a full bucket.
    void give_back(const Payer& payer, std::uint64_t work, Time now);

    /// The state of a bucket.
    struct Level {
        std::uint64_t work = 0;  ///< that the payer may spend at once; 0 if the level is negative
        std::chrono::microseconds until_full{0};
    };
    /// Returns the state of a payer's bucket at a time.
    [[nodiscard]] Level level(const Payer& payer, Time now) const;

    /// Returns the number of payers in the table.
    [[nodiscard]] std::size_t clients() const;

  private:
    struct Bucket {
        std::int64_t level = 0;    ///< millionths of work; negative: overdrawn
        std::int64_t at = 0;       ///< microseconds: time of that level
        std::int64_t full_at = 0;  ///< microseconds: time at which it is full if nothing is taken
    };
    using Buckets = std::map<Payer, Bucket>;  // not hashed: clients choose its keys

    std::int64_t advance(Time now);
    [[nodiscard]] Bucket bucket_of(const Payer& payer, std::int64_t now) const;
    void take(const Payer& payer, Bucket bucket, std::int64_t amount);
    void fill(Bucket& bucket, std::int64_t now) const;
    void index(Buckets::iterator bucket);
    void evict_one();

    std::int64_t rate_, capacity_;  ///< millionths per microsecond; millionths
    std::size_t most_clients_;
    mutable std::mutex mutex_;
    std::int64_t now_ = 0;
    Buckets buckets_;
    std::set<std::pair<std::int64_t, Payer>> by_full_at_;
};

}  // namespace sporeprint::server
