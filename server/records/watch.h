// Learns what other processes have published.
#pragma once

#include <chrono>
#include <memory>
#include <thread>

#include "api/library/library.h"
#include "server/operations/log.h"

namespace sporeprint::server {

/// Reads the changes of a library whenever the database tells of one, and at least once per interval, on a thread of
/// its own, until it is destroyed. A database that cannot be read is logged; what was known before is served meanwhile.
class LibraryWatch {
  public:
    LibraryWatch(std::shared_ptr<api::Library> library, Log& log,
                 std::chrono::milliseconds interval);

  private:
    std::shared_ptr<api::Library> library_;
    RepeatedWarning unreadable_;
    std::jthread thread_;  ///< the last member: it ends before the others are destroyed
};

}  // namespace sporeprint::server
