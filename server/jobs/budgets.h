// Budgets of work: a bucket for each client that fills at a steady rate, and that what is made for
// it is taken from.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <utility>

#include "server/http/addresses.h"

namespace sporeprint::server {

struct BudgetOptions {
    std::uint64_t rate = 0;              ///< work a second, at most 1e9; 0: no budgets
    std::uint64_t burst = 1;             ///< work that a full bucket holds, at most 1e12
    std::size_t most_clients = 1 << 16;  ///< that are remembered: about 200 bytes each
};

/// Buckets of all clients. Thread-safe; takes its time from the caller.
///
/// A client may spend when its bucket holds what is asked, or is full: one piece of work that is
/// larger than the bucket is let through then, and what is missing is owed. So in any time t, from
/// a full bucket on, it spends at most rate t + max(burst, the largest piece).
///
/// Levels are whole millionths and times whole microseconds, so nothing is lost to rounding. When
/// too many clients are remembered, the one whose bucket has been full longest is forgotten, which
/// takes nothing from anybody; if none is full, the one that would be soonest.
class Budgets {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// rate at least 1
    explicit Budgets(const BudgetOptions& options);

    /// Takes `work` from a client's bucket.
    ///
    /// now      not earlier than in calls before; an earlier one counts as that
    /// returns  zero, or when there is too little, how long until there is enough; nothing is taken
    ///          then
    [[nodiscard]] std::chrono::microseconds spend(const Address& client, std::uint64_t work,
                                                  Time now);

    /// Takes what was done for a client before its cost was known, even where its bucket does not
    /// hold that: the rest is owed.
    void owe(const Address& client, std::uint64_t work, Time now);

    /// Gives back what was spent on work that was not begun.
    void give_back(const Address& client, std::uint64_t work, Time now);

    /// What a client may spend at once, and how long until its bucket is full.
    struct Level {
        std::uint64_t work = 0;  ///< 0 when it owes
        std::chrono::microseconds until_full{0};
    };
    [[nodiscard]] Level level(const Address& client, Time now) const;

    [[nodiscard]] std::size_t clients() const;  ///< remembered

  private:
    struct Bucket {
        std::int64_t level = 0;    ///< millionths; less than 0 when it owes
        std::int64_t at = 0;       ///< microseconds: when that was its level
        std::int64_t full_at = 0;  ///< microseconds: when it is full if nothing is taken
    };
    using Buckets = std::map<Address, Bucket>;  // not hashed: its keys are chosen by strangers

    std::int64_t advance(Time now);
    [[nodiscard]] Bucket bucket_of(const Address& client, std::int64_t now) const;
    void take(const Address& client, Bucket bucket, std::int64_t wanted);
    void fill(Bucket& bucket, std::int64_t now) const;
    void keep(Buckets::iterator bucket);
    void forget_one();

    std::int64_t rate_, capacity_;  ///< millionths a microsecond; millionths
    std::size_t most_clients_;
    mutable std::mutex mutex_;
    std::int64_t now_ = 0;
    Buckets buckets_;
    std::set<std::pair<std::int64_t, Address>> by_full_at_;
};

}  // namespace sporeprint::server
