// Flights: work with a key that many may wait for and that is done once. Those who come while it is
// in the air get its result; when all have left, it is stopped. Knows nothing of what is made.
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

template <class Result>
class SingleFlight {
  public:
    using Work = std::function<Result(std::stop_token)>;

    /// What those who waited are told: a result, or the exception that the work ended with.
    struct Completion {
        std::shared_ptr<const Result> result;
        std::exception_ptr error;
        bool collapsed = false;  ///< somebody else's work
    };
    using OnComplete = std::function<void(const Completion&)>;

    struct Ticket {
        std::string key;
        std::uint64_t computation = 0;
        std::uint64_t number = 0;
    };

    /// Held while one looks for a kept result and boards when there is none. A flight that lands in
    /// between is still boarded then: between look and board nothing is made twice.
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

    /// slots         where work is done
    /// most_waiters  continuations that may wait in all
    SingleFlight(ThreadPool& threads, std::size_t most_waiters)
        : pool_(threads), most_waiters_(most_waiters) {}

    /// Stops what is in the air and returns when it has ended; by then nobody may wait any more.
    ~SingleFlight() {
        std::vector<std::shared_ptr<Computation>> single_flight;
        {
            const std::lock_guard lock(mutex_);
            for (const auto& [key, computation] : single_flight_)
                if (!computation->completed) single_flight.push_back(computation);
        }
        for (const auto& computation : single_flight) stop_computation(*computation);
        std::unique_lock lock(mutex_);
        ended_.wait(lock, [&] { return running_ == 0; });
    }
    SingleFlight(const SingleFlight&) = delete;
    SingleFlight& operator=(const SingleFlight&) = delete;

    /// Waits for the flight of `key`; starts it with `work` when there is none. `then` is called
    /// exactly once, on any thread, perhaps before this returns, and must not throw; unless cancel()
    /// comes first.
    ///
    /// returns  the seat; nothing, and `then` is not called, when queue or waiting room is full
    std::optional<Ticket> join(const std::string& key, Work work, OnComplete then) {
        std::shared_ptr<Computation> completed;
        {
            const std::lock_guard lock(mutex_);
            const auto found = single_flight_.find(key);
            if (found != single_flight_.end()) {
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
                    pool_.submit([this, computation] { run_computation(computation); });
                if (!ticket) return std::nullopt;
                computation->ticket = *ticket;
                ++running_;
                single_flight_.emplace(key, computation);
                return add_waiter(*computation, std::move(then), false);
            }
        }
        then({completed->result, nullptr, true});
        return Ticket{key, completed->number, 0};
    }

    /// Gives a seat up; when it was the last, the work is stopped and its result not waited for.
    ///
    /// returns  false when `then` has been called, or is about to be
    bool cancel(const Ticket& ticket) {
        std::shared_ptr<Computation> empty;
        OnComplete then;  // destroyed outside the lock
        {
            const std::lock_guard lock(mutex_);
            const auto found = single_flight_.find(ticket.key);
            if (found == single_flight_.end() || found->second->number != ticket.computation)
                return false;
            Computation& computation = *found->second;
            const auto waiter = computation.waiters.find(ticket.number);
            if (computation.completed || waiter == computation.waiters.end()) return false;
            then = std::move(waiter->second.then);
            computation.waiters.erase(waiter);
            --waiters_;
            if (computation.waiters.empty()) {
                empty = found->second;
                single_flight_.erase(found);
            }
        }
        if (empty) stop_computation(*empty);
        return true;
    }

    /// Whether a flight of this key may be boarded without a new one.
    [[nodiscard]] bool is_in_flight(const std::string& key) const {
        const std::lock_guard lock(mutex_);
        return single_flight_.contains(key);
    }

    /// Keys in the air.
    [[nodiscard]] std::size_t in_flight() const {
        const std::lock_guard lock(mutex_);
        return single_flight_.size() - completed_.size();
    }

    /// Continuations that wait.
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

    /// Takes a flight out of the queue, or asks the running one to stop.
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
            const auto found = single_flight_.find(computation->key);
            if (found == single_flight_.end() || found->second != computation)
                return;  // all have left
            waiters.swap(computation->waiters);
            waiters_ -= waiters.size();
            if (result && !lookup_guards_.empty()) {
                computation->completed = true;
                computation->result = result;
                completed_.emplace(++last_number_, computation->key);
            } else {
                single_flight_.erase(found);
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
        // Whoever glances now began after these had landed, and found what they kept.
        while (!completed_.empty() &&
               (lookup_guards_.empty() || completed_.begin()->first < *lookup_guards_.begin())) {
            const auto found = single_flight_.find(completed_.begin()->second);
            over.push_back(std::move(found->second));
            single_flight_.erase(found);
            completed_.erase(completed_.begin());
        }
    }

    ThreadPool& pool_;
    std::size_t most_waiters_;
    mutable std::mutex mutex_;
    std::unordered_map<std::string, std::shared_ptr<Computation>> single_flight_;
    std::map<std::uint64_t, std::string> completed_;  ///< when, key; kept for open glances
    std::set<std::uint64_t> lookup_guards_;
    std::size_t waiters_ = 0;
    std::size_t running_ = 0;  ///< tasks in the slots, those that nobody waits for included
    std::condition_variable ended_;
    std::uint64_t last_number_ = 0;
};

}  // namespace sporeprint::server
