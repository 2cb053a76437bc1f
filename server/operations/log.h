// The log: one JSON line per request and event, queued without blocking and written by a background
// thread.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "core/params/value.h"
#include "server/http/transport.h"
#include "server/operations/options.h"

namespace spdlog {
class logger;
}

namespace sporeprint::server {

/// Returns a target with the value of each `sig` parameter of its query, which is a secret while it
/// is valid, replaced by [redacted]. The name is matched in any case and percent-encoding.
[[nodiscard]] std::string redacted(std::string_view target);

/// Writes JSON lines to standard error. Thread-safe.
class Log {
  public:
    /// Starts the writer thread, which writes the lines of 10 ms at once. If lines arrive faster
    /// than they can be written, the oldest queued ones are dropped, so that a slow reader of the
    /// log never blocks the service.
    ///
    /// least  least level that is logged
    explicit Log(LogLevel least);
    ~Log();  ///< writes the queued lines
    Log(const Log&) = delete;
    Log& operator=(const Log&) = delete;

    /// Logs one request with redacted() target. The level of health checks is debug, that of server
    /// errors is error.
    ///
    /// cost  under a microsecond
    void request(const Served& served);

    /// Logs an event with additional members.
    void event(LogLevel level, std::string_view message, const Value::Object& members = {});

  private:
    void enqueue(std::string_view line);
    void write();

    /// has the least level; used for writing by writer_ only
    std::unique_ptr<spdlog::logger> logger_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<std::string> waiting_;  ///< blocks of lines, oldest first
    bool ending_ = false;
    std::jthread writer_;
};

/// A rate-limited warning: logged at once, then at most once per pause. Thread-safe.
class RepeatedWarning {
  public:
    using Clock = std::chrono::steady_clock;

    /// pre  log outlives this object
    RepeatedWarning(Log& log, std::string message, std::chrono::seconds pause)
        : log_(log), message_(std::move(message)), pause_(pause) {}

    /// Logs the warning with these members and `times`, the number of occurrences since it was last
    /// logged; or only counts the occurrence.
    void operator()(Value::Object members, Clock::time_point now = Clock::now());

  private:
    Log& log_;
    std::string message_;
    std::chrono::seconds pause_;
    std::mutex mutex_;
    std::uint64_t times_ = 0;
    Clock::time_point next_ = Clock::time_point::min();
};

}  // namespace sporeprint::server
