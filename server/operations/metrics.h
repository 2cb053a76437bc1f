// Metrics in the Prometheus text format: requests are counted here, caches by api, and gauges are
// read at each scrape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "api/service.h"
#include "server/http/transport.h"

namespace sporeprint::server {

/// Values read at each scrape.
struct Gauges {
    std::size_t workers = 0, busy_workers = 0;
    std::size_t queue = 0, queue_limit = 0;
    std::size_t in_flight = 0, waiters = 0;
    std::size_t clients = 0;  ///< in the table of budgets
    Transport::Load connections;
    bool ready = false;
};

/// Counts requests and formats all metrics. Thread-safe.
class Metrics {
  public:
    Metrics(std::string version, std::string generator_version);
    ~Metrics();
    Metrics(const Metrics&) = delete;
    Metrics& operator=(const Metrics&) = delete;

    /// Counts one request that has ended. Its label is the URL template of its route, or "UNKNOWN",
    /// so that clients cannot increase the number of time series.
    void served(const Served& served);

    /// Records the duration of each step of a computation.
    void generated(const api::Timing& timing);

    /// Counts a request that joined a computation in flight.
    void collapsed();

    /// Counts a request that was not served.
    ///
    /// reason  "queue" (full), "deadline" (exceeded), "left" (the client disconnected), "signature"
    ///         (missing or invalid) or "budget" (exhausted)
    void rejected(std::string_view reason);

    /// Returns all metrics in the Prometheus text format.
    [[nodiscard]] std::string text(const api::Counters& counters, const Gauges& gauges) const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace sporeprint::server
