// The log: one line of JSON for each request and event, gathered without waiting and written by a
// thread of its own.
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

/// A target as it may be logged: the value of each `sig` of its query, a secret while it is good,
/// replaced by [redacted]. A name in other capitals, or percent-encoded, is taken for it too.
[[nodiscard]] std::string redacted(std::string_view target);

class Log {
  public:
    /// Writes to standard error, what has come in 10 ms at once. When lines come faster than they
    /// can be written the oldest waiting ones are dropped: a slow reader of the log never stops the
    /// service.
    explicit Log(LogLevel least);
    ~Log();  ///< writes what waits
    Log(const Log&) = delete;
    Log& operator=(const Log&) = delete;

    /// One request, its target redacted(); health checks are logged at debug, server faults at error.
    ///
    /// cost  under a microsecond
    void request(const Served& served);

    /// An event with further members.
    void event(LogLevel level, std::string_view message, const Value::Object& members = {});

  private:
    void gather(std::string_view line);
    void write();

    std::unique_ptr<spdlog::logger> logger_;  ///< knows the least level; writes on writer_ only
    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<std::string> waiting_;  ///< blocks of lines, oldest first
    bool ending_ = false;
    std::jthread writer_;
};

/// A warning whose cause may recur many times a second: logged at once, then at most once in each
/// pause. Thread-safe.
class RepeatedWarning {
  public:
    using Clock = std::chrono::steady_clock;

    /// log  outlives this
    RepeatedWarning(Log& log, std::string message, std::chrono::seconds pause)
        : log_(log), message_(std::move(message)), pause_(pause) {}

    /// Logs the warning with these members and `times`, how often it has come since it was last
    /// logged; or only counts it.
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
