// The log: one line of JSON for each request and event, written by a thread of its own.
#pragma once

#include <memory>
#include <string_view>

#include "core/params/value.h"
#include "server/options.h"
#include "server/transport.h"

namespace sporeprint::server {

class Log {
  public:
    /// Writes to standard error. When lines come faster than they can be written the oldest waiting
    /// ones are dropped: a slow reader of the log never stops the service.
    explicit Log(LogLevel least);
    ~Log();  ///< writes what waits
    Log(const Log&) = delete;
    Log& operator=(const Log&) = delete;

    /// One request; health checks are logged at debug, server faults at error.
    void request(const Served& served);

    /// An event with further members.
    void event(LogLevel level, std::string_view message, Value::Object members = {});

  private:
    struct Sink;
    void write(LogLevel level, Value::Object members);

    std::unique_ptr<Sink> sink_;
};

/// What a request's line says; every byte that came from a client is escaped.
[[nodiscard]] Value::Object request_members(const Served& served);

}  // namespace sporeprint::server
