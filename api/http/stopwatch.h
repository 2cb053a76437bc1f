// Measures the steps of a job: core reports them, this class reads the clock.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>

#include "api/http/service_options.h"

namespace sporeprint::api {

/// Provides the progress observer of one job. A step lasts until the next one begins, the last one
/// until timing() is called.
class Stopwatch {
  public:
    [[nodiscard]] Observer observer() {
        return [this](Step step) { begin(step); };
    }

    void begin(Step step) {
        const std::lock_guard lock(mutex_);
        close();
        current_ = step;
    }

    /// Returns milliseconds per step so far. `queue_ms` is copied into the result; negative means
    /// none.
    [[nodiscard]] Timing timing(double queue_ms = -1.0) {
        const std::lock_guard lock(mutex_);
        close();
        timing_.queue = queue_ms;
        return timing_;
    }

  private:
    using Clock = std::chrono::steady_clock;

    void close() {
        const Clock::time_point now = Clock::now();
        if (current_) {
            double& spent = timing_.of_steps[static_cast<std::size_t>(*current_)];
            spent = (spent < 0.0 ? 0.0 : spent) +
                    std::chrono::duration<double, std::milli>(now - since_).count();
        }
        current_.reset();
        since_ = now;
    }

    std::mutex mutex_;
    std::optional<Step> current_;
    Clock::time_point since_;
    Timing timing_;
};

}  // namespace sporeprint::api
