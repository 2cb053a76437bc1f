#include "server/records/watch.h"

#include <exception>
#include <utility>

namespace sporeprint::server {

LibraryWatch::LibraryWatch(std::shared_ptr<api::Library> library, Log& log,
                           std::chrono::milliseconds interval)
    : library_(std::move(library)),
      unreadable_(log,
                  "the library cannot be read; what was published before is served, and what "
                  "others publish is not known until it can",
                  std::chrono::minutes(1)),
      thread_([this, interval](const std::stop_token& stop) {
          while (!stop.stop_requested()) {
              library_->records().wait_for_change(stop, interval.count());
              if (stop.stop_requested()) return;
              try {
                  library_->refresh();
              } catch (const std::exception& error) {
                  unreadable_({{"why", Value(error.what())}});
              }
          }
      }) {}

}  // namespace sporeprint::server
