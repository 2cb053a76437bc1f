// The service without sockets: plan() responds immediately where that is possible in microseconds,
// and otherwise returns a Job.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "api/http/message.h"
#include "api/http/service_options.h"
#include "core/atlas/atlas.h"

namespace sporeprint::api {

class Service {
  public:
    Service(std::shared_ptr<const Atlas> atlas, const ServiceOptions& options);

    /// Creates a service with other templates that replaces `other`: both share options, counters
    /// and caches, whose keys contain the hash of the templates. The folder of the page is read
    /// again.
    Service(std::shared_ptr<const Atlas> atlas, const Service& other);
    ~Service();
    Service(const Service&) = delete;
    Service& operator=(const Service&) = delete;

    /// Parses and checks a request, builds its canonical text, compares ETags and looks into the
    /// caches. Never blocks, never throws.
    ///
    /// correspondence_ready  true: a correspondence that is needed and not cached is computed here,
    ///                       in milliseconds; false: the result is then a warm-up job
    ///                       (Job::is_warm_up)
    [[nodiscard]] Plan plan(const Request& request, bool correspondence_ready = false);

    /// Stores the response of a job in the cache. Called once per computation.
    void finish(const Key& key, const Response& response);

    /// Returns the shared response of a job, completed for one of the clients that waited for it
    /// (Cache-Status, Server-Timing, request id; no body for HEAD).
    [[nodiscard]] Response deliver(const Request& request, const Delivery& delivery,
                                   const Response& shared, Outcome outcome,
                                   const Timing& timing) const;

    /// Returns problem+json for an error found outside plan() (408, 413, 414, 429, 431, 500, 503,
    /// 504).
    [[nodiscard]] Response problem(const Request& request, int status, std::string_view detail,
                                   const std::vector<Header>& extra = {}) const;

    /// Returns the problem for an exception of Job::run; unknown exceptions are 500 without detail.
    [[nodiscard]] Response problem(const Request& request, std::exception_ptr error) const;

    /// Generates one mushroom, for /readyz. Returns true on success.
    [[nodiscard]] bool self_test();

    /// Returns the final response to a request whose body has not arrived, if the head alone
    /// decides it: 308, 400, 404, 405, 414, 415, or that to OPTIONS.
    [[nodiscard]] std::optional<Response> response_to_head(const Request& request) const;

    /// Returns the cost of parsing the body of a request, which is charged whatever the response
    /// is; zero for most requests.
    [[nodiscard]] Cost cost_of_reading(const Request& request) const;

    /// Returns the largest body that a route accepts, in bytes (413 beyond).
    [[nodiscard]] std::size_t most_body(std::string_view method, std::string_view target) const;

    [[nodiscard]] const Counters& counters() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// Calls plan() on a thread that may take milliseconds; never returns a warm-up job.
[[nodiscard]] Plan plan_here(Service& service, const Request& request);

/// Plans and runs a request inline, without sockets, for tests and tools.
[[nodiscard]] Response handle(Service& service, const Request& request);

}  // namespace sporeprint::api
