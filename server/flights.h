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

#include "server/slots.h"

namespace sporeprint::server {

template <class Result>
class Flights {
  public:
    using Work = std::function<Result(std::stop_token)>;

    /// What those who waited are told: a result, or the exception that the work ended with.
    struct Landing {
        std::shared_ptr<const Result> result;
        std::exception_ptr error;
        bool collapsed = false;  ///< somebody else's work
    };
    using Then = std::function<void(const Landing&)>;

    struct Seat {
        std::string key;
        std::uint64_t flight = 0;
        std::uint64_t number = 0;
    };

    /// Held while one looks for a kept result and boards when there is none. A flight that lands in
    /// between is still boarded then: between look and board nothing is made twice.
    class Glance {
      public:
        explicit Glance(Flights& flights) : flights_(&flights), number_(flights.open_glance()) {}
        ~Glance() { flights_->close_glance(number_); }
        Glance(const Glance&) = delete;
        Glance& operator=(const Glance&) = delete;

      private:
        Flights* flights_;
        std::uint64_t number_;
    };

    /// slots         where work is done
    /// most_waiters  continuations that may wait in all
    Flights(Slots& slots, std::size_t most_waiters) : slots_(slots), most_waiters_(most_waiters) {}

    /// Stops what is in the air and returns when it has ended; by then nobody may wait any more.
    ~Flights() {
        std::vector<std::shared_ptr<Flight>> flights;
        {
            const std::lock_guard lock(mutex_);
            for (const auto& [key, flight] : flights_)
                if (!flight->landed) flights.push_back(flight);
        }
        for (const auto& flight : flights) cancel(*flight);
        std::unique_lock lock(mutex_);
        ended_.wait(lock, [&] { return flying_ == 0; });
    }
    Flights(const Flights&) = delete;
    Flights& operator=(const Flights&) = delete;

    /// Waits for the flight of `key`; starts it with `work` when there is none. `then` is called
    /// exactly once, on any thread, perhaps before this returns, and must not throw; unless leave()
    /// comes first.
    ///
    /// returns  the seat; nothing, and `then` is not called, when queue or waiting room is full
    std::optional<Seat> board(const std::string& key, Work work, Then then) {
        std::shared_ptr<Flight> landed;
        {
            const std::lock_guard lock(mutex_);
            const auto found = flights_.find(key);
            if (found != flights_.end()) {
                Flight& flight = *found->second;
                if (!flight.landed) {
                    if (waiters_ >= most_waiters_) return std::nullopt;
                    return seat(flight, std::move(then), true);
                }
                landed = found->second;
            } else {
                if (waiters_ >= most_waiters_) return std::nullopt;
                auto flight = std::make_shared<Flight>();
                flight->key = key;
                flight->number = ++last_number_;
                flight->work = std::move(work);
                const std::optional<Slots::Ticket> ticket =
                    slots_.submit([this, flight] { fly(flight); });
                if (!ticket) return std::nullopt;
                flight->ticket = *ticket;
                ++flying_;
                flights_.emplace(key, flight);
                return seat(*flight, std::move(then), false);
            }
        }
        then({landed->result, nullptr, true});
        return Seat{key, landed->number, 0};
    }

    /// Gives a seat up; when it was the last, the work is stopped and its result not waited for.
    ///
    /// returns  false when `then` has been called, or is about to be
    bool leave(const Seat& seat) {
        std::shared_ptr<Flight> empty;
        Then then;  // destroyed outside the lock
        {
            const std::lock_guard lock(mutex_);
            const auto found = flights_.find(seat.key);
            if (found == flights_.end() || found->second->number != seat.flight) return false;
            Flight& flight = *found->second;
            const auto waiter = flight.waiters.find(seat.number);
            if (flight.landed || waiter == flight.waiters.end()) return false;
            then = std::move(waiter->second.then);
            flight.waiters.erase(waiter);
            --waiters_;
            if (flight.waiters.empty()) {
                empty = found->second;
                flights_.erase(found);
            }
        }
        if (empty) cancel(*empty);
        return true;
    }

    /// Whether a flight of this key may be boarded without a new one.
    [[nodiscard]] bool flies(const std::string& key) const {
        const std::lock_guard lock(mutex_);
        return flights_.contains(key);
    }

    /// Keys in the air.
    [[nodiscard]] std::size_t in_the_air() const {
        const std::lock_guard lock(mutex_);
        return flights_.size() - landed_.size();
    }

    /// Continuations that wait.
    [[nodiscard]] std::size_t waiters() const {
        const std::lock_guard lock(mutex_);
        return waiters_;
    }

  private:
    struct Waiter {
        Then then;
        bool collapsed = false;
    };

    struct Flight {
        std::string key;
        std::uint64_t number = 0;
        Work work;
        Slots::Ticket ticket = 0;
        std::stop_source stop;
        std::map<std::uint64_t, Waiter> waiters;
        bool landed = false;
        std::shared_ptr<const Result> result;
    };

    Seat seat(Flight& flight, Then then, bool collapsed) {
        const std::uint64_t number = ++last_number_;
        flight.waiters.emplace(number, Waiter{std::move(then), collapsed});
        ++waiters_;
        return {flight.key, flight.number, number};
    }

    /// Takes a flight out of the queue, or asks the running one to stop.
    void cancel(Flight& flight) {
        flight.stop.request_stop();
        if (slots_.withdraw(flight.ticket)) has_ended();
    }

    void has_ended() {
        const std::lock_guard lock(mutex_);
        --flying_;
        ended_.notify_all();  // under the lock: the destructor may be waiting
    }

    void fly(const std::shared_ptr<Flight>& flight) {
        land(flight);
        has_ended();
    }

    void land(const std::shared_ptr<Flight>& flight) {
        std::shared_ptr<const Result> result;
        std::exception_ptr error;
        if (!flight->stop.stop_requested()) {
            try {
                result = std::make_shared<const Result>(flight->work(flight->stop.get_token()));
            } catch (...) {
                error = std::current_exception();
            }
        }
        flight->work = nullptr;
        std::map<std::uint64_t, Waiter> waiters;
        {
            const std::lock_guard lock(mutex_);
            const auto found = flights_.find(flight->key);
            if (found == flights_.end() || found->second != flight) return;  // all have left
            waiters.swap(flight->waiters);
            waiters_ -= waiters.size();
            if (result && !glances_.empty()) {
                flight->landed = true;
                flight->result = result;
                landed_.emplace(++last_number_, flight->key);
            } else {
                flights_.erase(found);
            }
        }
        for (auto& [number, waiter] : waiters) waiter.then({result, error, waiter.collapsed});
    }

    std::uint64_t open_glance() {
        const std::lock_guard lock(mutex_);
        glances_.insert(++last_number_);
        return last_number_;
    }

    void close_glance(std::uint64_t number) {
        std::vector<std::shared_ptr<Flight>> over;  // destroyed outside the lock
        const std::lock_guard lock(mutex_);
        glances_.erase(number);
        // Whoever glances now began after these had landed, and found what they kept.
        while (!landed_.empty() &&
               (glances_.empty() || landed_.begin()->first < *glances_.begin())) {
            const auto found = flights_.find(landed_.begin()->second);
            over.push_back(std::move(found->second));
            flights_.erase(found);
            landed_.erase(landed_.begin());
        }
    }

    Slots& slots_;
    std::size_t most_waiters_;
    mutable std::mutex mutex_;
    std::unordered_map<std::string, std::shared_ptr<Flight>> flights_;
    std::map<std::uint64_t, std::string> landed_;  ///< when, key; kept for open glances
    std::set<std::uint64_t> glances_;
    std::size_t waiters_ = 0;
    std::size_t flying_ = 0;  ///< tasks in the slots, those that nobody waits for included
    std::condition_variable ended_;
    std::uint64_t last_number_ = 0;
};

}  // namespace sporeprint::server
