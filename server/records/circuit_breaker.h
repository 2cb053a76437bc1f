// Keeps callers from waiting for a service that does not respond: one of them finds out, the others are refused.
#pragma once

#include <chrono>
#include <mutex>

namespace sporeprint::server {

/// A circuit breaker. It is closed while the service responds; once a caller has waited in vain it is open, and from
/// then on one caller in each interval may try until one has succeeded. All functions may be called on any thread.
class CircuitBreaker {
  public:
    using Clock = std::chrono::steady_clock;

    /// interval  between two attempts while it is open
    explicit CircuitBreaker(Clock::duration interval) : interval_(interval) {}

    /// Returns whether a caller may use the service now.
    [[nodiscard]] bool may_try(Clock::time_point now) {
        const std::lock_guard lock(mutex_);
        if (!is_open_) return true;
        if (now < next_attempt_) return false;
        next_attempt_ = now + interval_;
        return true;
    }

    /// Says that the service has responded.
    void close() {
        const std::lock_guard lock(mutex_);
        is_open_ = false;
    }

    /// Says that a caller has waited in vain.
    void open(Clock::time_point now) {
        const std::lock_guard lock(mutex_);
        is_open_ = true;
        next_attempt_ = now + interval_;
    }

  private:
    std::mutex mutex_;
    Clock::duration interval_;
    bool is_open_ = false;
    Clock::time_point next_attempt_;
};

}  // namespace sporeprint::server
