// The metrics, in Prometheus's text format: requests counted here, caches counted by api, the rest
// asked for when somebody looks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "api/service.h"
#include "server/http/transport.h"

namespace sporeprint::server {

/// Read off at the moment of looking.
struct Gauges {
    std::size_t workers = 0, busy_workers = 0;
    std::size_t queue = 0, queue_limit = 0;
    std::size_t in_flight = 0, waiters = 0;
    std::size_t clients = 0;  ///< whose budgets are remembered
    Transport::Load connections;
    bool ready = false;
};

class Metrics {
  public:
    Metrics(std::string version, std::string generator_version);
    ~Metrics();
    Metrics(const Metrics&) = delete;
    Metrics& operator=(const Metrics&) = delete;

    /// One request. Its label is the template of its path, "UNKNOWN" when there is none: the number
    /// of time series must not depend on what strangers ask for.
    void served(const Served& served);

    /// One flight's steps, by those it took.
    void generated(const api::Timing& timing);

    /// One request that joined somebody else's flight.
    void collapsed();

    /// One request that was not let in: "queue", "deadline", "left",
    /// "signature" or "budget".
    void rejected(std::string_view reason);

    [[nodiscard]] std::string text(const api::Counters& counters, const Gauges& gauges) const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace sporeprint::server
