// Single-flight group: concurrent requests for one key share one computation. Requests that join
// while it is in flight get its result; when all of them have cancelled, it is stopped. It is
// independent of what is computed.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "server/jobs/thread_pool.h"

namespace sporeprint::server {

/// Runs at most one computation per key at a time on a thread pool. Thread-safe.
template <class Result>
class SingleFlight {
  public:
    using Work = std::function<Result(std::stop_token)>;

    /// The outcome passed to every waiter: a result, or the exception that the work threw.
    struct Completion {
        std::shared_ptr<const Result> result;
        std::exception_ptr error;
        bool collapsed = false;  ///< the waiter joined a computation started by another
    };
    using OnComplete = std::function<void(const Completion&)>;

    /// Identifies one waiter, for cancel().
    struct Ticket {
        std::string key;
        std::uint64_t computation = 0;  ///< number of the computation
        std::uint64_t number = 0;       ///< number of the waiter
    };

    /// Held by a caller from before it looks up a key in a cache until after its join(). A
    /// computation that completes in between stays joinable, so that it is not repeated.
    class LookupGuard {
      public:
        explicit LookupGuard(SingleFlight& single_flight)
            : single_flight_(&single_flight), number_(single_flight.open_lookup()) {}
        ~LookupGuard() { single_flight_->close_lookup(number_); }
        LookupGuard(const LookupGuard&) = delete;
        LookupGuard& operator=(const LookupGuard&) = delete;

      private:
        SingleFlight* single_flight_;
        std::uint64_t number_;
    };

    /// threads       pool that runs the work; outlives this object
    /// most_waiters  greatest number of waiters of all computations
    SingleFlight(ThreadPool& threads, std::size_t most_waiters)
        : pool_(threads), most_waiters_(most_waiters) {}

    /// Requests all computations to stop and returns when they have ended.
    ///
    /// pre  no waiters are left
    ~SingleFlight() {
        std::vector<std::shared_ptr<Computation>> running;
        {
            const std::lock_guard lock(mutex_);
            for (const auto& [key, computation] : computations_)
                if (!computation->completed) running.push_back(computation);
        }
        for (const auto& computation : running) stop_computation(*computation);
        std::unique_lock lock(mutex_);
        ended_.wait(lock, [&] { return running_ == 0; });
    }
    SingleFlight(const SingleFlight&) = delete;
    SingleFlight& operator=(const SingleFlight&) = delete;

    /// Joins the computation of `key`, or starts one with `work`. `then` is called exactly once, on
    /// any thread, perhaps before this returns, unless cancel() succeeds first; it must not throw.
    ///
    /// returns  the ticket; nothing, and `then` is not called, if the queue or the list of waiters
    ///          is full
    std::optional<Ticket> join(const std::string& key, Work work, OnComplete then,
                               TaskLength length = TaskLength::brief) {
        std::shared_ptr<Computation> completed;
        {
            const std::lock_guard lock(mutex_);
            const auto found = computations_.find(key);
            if (found != computations_.end()) {
                Computation& computation = *found->second;
                if (!computation.completed) {
                    if (waiters_ >= most_waiters_) return std::nullopt;
                    return add_waiter(computation, std::move(then), true);
                }
                completed = found->second;
            } else {
                if (waiters_ >= most_waiters_) return std::nullopt;
                auto computation = std::make_shared<Computation>();
                computation->key = key;
                computation->number = ++last_number_;
                computation->work = std::move(work);
                const std::optional<ThreadPool::Ticket> ticket =
                    pool_.submit([this, computation] { run_computation(computation); }, length);
                if (!ticket) return std::nullopt;
                computation->ticket = *ticket;
                ++running_;
                computations_.emplace(key, computation);
                return add_waiter(*computation, std::move(then), false);
            }
        }
        then({completed->result, nullptr, true});
        return Ticket{key, completed->number, 0};
    }

    /// Removes a waiter. The work is requested to stop when its last waiter is removed.
    ///
    /// returns  false if `then` has been called or is about to be
    bool cancel(const Ticket& ticket) {
        std::shared_ptr<Computation> abandoned;
        OnComplete then;  // destroyed outside the lock
        {
            const std::lock_guard lock(mutex_);
            const auto found = computations_.find(ticket.key);
            if (found == computations_.end() || found->second->number != ticket.computation)
                return false;
            Computation& computation = *found->second;
            const auto waiter = computation.waiters.find(ticket.number);
            if (computation.completed || waiter == computation.waiters.end()) return false;
            then = std::move(waiter->second.then);
            computation.waiters.erase(waiter);
            --waiters_;
            if (computation.waiters.empty()) {
                abandoned = found->second;
                computations_.erase(found);
            }
        }
        if (abandoned) stop_computation(*abandoned);
        return true;
    }

    /// Returns true if join() of this key would not start a computation.
    [[nodiscard]] bool is_in_flight(const std::string& key) const {
        const std::lock_guard lock(mutex_);
        return computations_.contains(key);
    }

    /// Returns the number of computations that have not completed.
    [[nodiscard]] std::size_t in_flight() const {
        const std::lock_guard lock(mutex_);
        return computations_.size() - completed_.size();
    }

    /// Returns the number of waiters.
    [[nodiscard]] std::size_t waiters() const {
        const std::lock_guard lock(mutex_);
        return waiters_;
    }

  private:
    struct Waiter {
        OnComplete then;
        bool collapsed = false;
    };

    struct Computation {
        std::string key;
        std::uint64_t number = 0;
        Work work;
        ThreadPool::Ticket ticket = 0;
        std::stop_source stop;
        std::map<std::uint64_t, Waiter> waiters;
        bool completed = false;
        std::shared_ptr<const Result> result;
    };

    Ticket add_waiter(Computation& computation, OnComplete then, bool collapsed) {
        const std::uint64_t number = ++last_number_;
        computation.waiters.emplace(number, Waiter{std::move(then), collapsed});
        ++waiters_;
        return {computation.key, computation.number, number};
    }

    /// Withdraws a computation from the queue, or requests a running one to stop.
    void stop_computation(Computation& computation) {
        computation.stop.request_stop();
        if (pool_.withdraw(computation.ticket)) has_ended();
    }

    void has_ended() {
        const std::lock_guard lock(mutex_);
        --running_;
        ended_.notify_all();  // under the lock: the destructor may be waiting
    }

    void run_computation(const std::shared_ptr<Computation>& computation) {
        complete(computation);
        has_ended();
    }

    void complete(const std::shared_ptr<Computation>& computation) {
        std::shared_ptr<const Result> result;
        std::exception_ptr error;
        if (!computation->stop.stop_requested()) {
            try {
                result = std::make_shared<const Result>(
                    computation->work(computation->stop.get_token()));
            } catch (...) {
                error = std::current_exception();
            }
        }
        computation->work = nullptr;
        std::map<std::uint64_t, Waiter> waiters;
        {
            const std::lock_guard lock(mutex_);
            const auto found = computations_.find(computation->key);
            if (found == computations_.end() || found->second != computation)
                return;  // all waiters have cancelled
            waiters.swap(computation->waiters);
            waiters_ -= waiters.size();
            if (result && !lookup_guards_.empty()) {
                computation->completed = true;
                computation->result = result;
                completed_.emplace(++last_number_, computation->key);
            } else {
                computations_.erase(found);
            }
        }
        for (auto& [number, waiter] : waiters) waiter.then({result, error, waiter.collapsed});
    }

    std::uint64_t open_lookup() {
        const std::lock_guard lock(mutex_);
        lookup_guards_.insert(++last_number_);
        return last_number_;
    }

    void close_lookup(std::uint64_t number) {
        std::vector<std::shared_ptr<Computation>> over;  // destroyed outside the lock
        const std::lock_guard lock(mutex_);
        lookup_guards_.erase(number);
        // All lookups still open began after these computations completed, hence after their
        // results were cached.
        while (!completed_.empty() &&
               (lookup_guards_.empty() || completed_.begin()->first < *lookup_guards_.begin())) {
            const auto found = computations_.find(completed_.begin()->second);
            over.push_back(std::move(found->second));
            computations_.erase(found);
            completed_.erase(completed_.begin());
        }
    }

    ThreadPool& pool_;
    std::size_t most_waiters_;
    mutable std::mutex mutex_;
    std::unordered_map<std::string, std::shared_ptr<Computation>> computations_;
    /// sequence number and key of completed computations that open lookups may still join
    std::map<std::uint64_t, std::string> completed_;
    std::set<std::uint64_t> lookup_guards_;
    std::size_t waiters_ = 0;
    std::size_t running_ = 0;  ///< tasks in the pool, including those without waiters
    std::condition_variable ended_;
    std::uint64_t last_number_ = 0;
};

}  // namespace sporeprint::server
