// Deadlines of thousands of connections on one thread: a wheel of lists, where putting a deadline
// off costs nothing.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace sporeprint::server {

using Clock = std::chrono::steady_clock;

/// What may have a deadline; taken off the wheel when it is destroyed.
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
    Timed* next_ = nullptr;  ///< a ring with one sentinel; nullptr when on no list
    Timed* previous_ = nullptr;
    std::int64_t tick_ = 0;  ///< whose list it is on: not later than the deadline's
};

class Deadlines {
  public:
    static constexpr std::chrono::milliseconds tick{16};  ///< how late one may be noticed

    explicit Deadlines(Clock::time_point now);
    Deadlines(const Deadlines&) = delete;
    Deadlines& operator=(const Deadlines&) = delete;

    /// Sets or moves a deadline.
    ///
    /// cost  O(1); a few instructions when it is put off
    void set(Timed& one, Clock::time_point deadline);

    /// Calls `late` for each whose deadline has come; by then it has none. `late` may set, and may
    /// destroy any.
    void expire(Clock::time_point now, const std::function<void(Timed&)>& late);

    /// When expire() has something to do at the earliest; max() for never.
    [[nodiscard]] Clock::time_point next() const;

  private:
    static constexpr std::int64_t threads = 1024;  ///< later ones are looked at once in 16 s
    static constexpr std::int64_t never = INT64_MAX;

    [[nodiscard]] std::int64_t tick_of(Clock::time_point time) const;
    void link(Timed& one);

    Clock::time_point start_;
    std::int64_t now_ = 0;       ///< ticks before and with this one have been looked at
    std::int64_t next_ = never;  ///< no list before this one has a member
    std::array<Timed, threads> lists_;
    Timed expired_;
};

}  // namespace sporeprint::server
