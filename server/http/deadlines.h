// A timing wheel: deadlines of thousands of connections on one thread, in which postponing a
// deadline costs O(1).
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace sporeprint::server {

using Clock = std::chrono::steady_clock;

/// Base class of objects with a deadline. Its destructor removes it from the wheel.
class Timed {
  public:
    Timed() = default;
    Timed(const Timed&) = delete;
    Timed& operator=(const Timed&) = delete;
    virtual ~Timed() { unlink(); }

    [[nodiscard]] Clock::time_point deadline() const { return deadline_; }

  private:
    friend class Deadlines;

    void unlink() {
        if (!next_) return;
        next_->previous_ = previous_;
        previous_->next_ = next_;
        next_ = previous_ = nullptr;
    }
    void link_after(Timed& other) {
        previous_ = &other;
        next_ = other.next_;
        next_->previous_ = this;
        other.next_ = this;
    }

    Clock::time_point deadline_ = Clock::time_point::max();
    Timed* next_ = nullptr;  ///< circular list with one sentinel; nullptr: in no list
    Timed* previous_ = nullptr;
    std::int64_t tick_ = 0;  ///< tick of the list it is in; not later than that of the deadline
};

/// The timing wheel. Used on one thread.
class Deadlines {
  public:
    /// resolution: a deadline expires at most this late
    static constexpr std::chrono::milliseconds tick{16};

    explicit Deadlines(Clock::time_point now);
    Deadlines(const Deadlines&) = delete;
    Deadlines& operator=(const Deadlines&) = delete;

    /// Sets or moves a deadline.
    ///
    /// cost  O(1); a few instructions if the deadline is postponed
    void set(Timed& one, Clock::time_point deadline);

    /// Calls `on_expired` for each object whose deadline has passed, after removing it from the
    /// wheel. `on_expired` may set deadlines and destroy objects.
    void expire(Clock::time_point now, const std::function<void(Timed&)>& on_expired);

    /// Returns the earliest time at which expire() may have work; max() if there are no deadlines.
    [[nodiscard]] Clock::time_point next() const;

  private:
    /// ticks; later deadlines are visited every 16 s
    static constexpr std::int64_t wheel_size = 1024;
    static constexpr std::int64_t never = INT64_MAX;

    [[nodiscard]] std::int64_t tick_of(Clock::time_point time) const;
    void link(Timed& one);

    Clock::time_point start_;
    std::int64_t now_ = 0;       ///< last tick that expire() has visited
    std::int64_t next_ = never;  ///< lists of earlier ticks are empty
    std::array<Timed, wheel_size> lists_;
    Timed expired_;
};

}  // namespace sporeprint::server
