// The line that says how far a set of files is.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace sporeprint::server {

enum class ProgressStyle {
    line,  ///< one line that changes on a terminal, one every ten seconds elsewhere
    json,  ///< an object a second, one per line
    none
};

/// Reports progress to standard error: to a terminal several times a second.
class BakeProgress {
  public:
    /// items   of this run
    /// before  that were there already
    BakeProgress(ProgressStyle style, std::uint64_t items, std::uint64_t before);

    /// To be called after each item.
    void count(bool failed, std::uint64_t bytes);
    /// Reports the last time.
    void finish();

    [[nodiscard]] std::uint64_t failed() const { return failed_; }

  private:
    using Clock = std::chrono::steady_clock;

    void report(Clock::time_point now);
    [[nodiscard]] std::string line(double seconds) const;
    [[nodiscard]] std::string object(double seconds) const;

    ProgressStyle style_;
    std::uint64_t items_, before_, done_ = 0, failed_ = 0, bytes_ = 0;
    Clock::time_point begun_ = Clock::now(), last_ = begun_;
    Clock::duration interval_{};
    bool is_terminal_ = false;
};

/// Returns a time in the two greatest of its units: "2 h 5 min", "41 s".
[[nodiscard]] std::string time_text(double seconds);

/// Returns a number with its digits in groups of three: "20,000".
[[nodiscard]] std::string grouped(std::uint64_t number);

}  // namespace sporeprint::server
