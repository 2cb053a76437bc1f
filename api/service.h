// The meaning of the service: plan() answers what it can in microseconds and describes the rest as a Job.
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

    /// The same with other templates, to take its place: options, counters and what is kept are common to both. Keys tell what
    /// was made of which templates. The folder of the page is read anew.
    Service(std::shared_ptr<const Atlas> atlas, const Service& other);
    ~Service();
    Service(const Service&) = delete;
    Service& operator=(const Service&) = delete;

    /// Parses, checks, makes the canonical text, compares ETags, looks into the caches. Never blocks, never throws.
    ///
    /// prepared  a correspondence that the answer needs and that is not kept is made here, in milliseconds; otherwise that is
    ///           a Job that `prepares`
    [[nodiscard]] std::variant<Response, Job> plan(const Request& request,
                                                   bool correspondence_ready = false);

    /// Called once per flight with what the job returned: fills the cache.
    void finish(const Key& key, const Response& response);

    /// The shared answer of a job made ready for one of those who waited (Cache-Status, Server-Timing, request id; no body for HEAD).
    [[nodiscard]] Response deliver(const Request& request, const Response& shared, Outcome outcome,
                                   const Timing& timing) const;

    /// problem+json for faults that are found before or beside plan() (408, 413, 414, 429, 431, 500, 503, 504 …).
    [[nodiscard]] Response problem(const Request& request, int status, std::string_view detail,
                                   const std::vector<Header>& extra = {}) const;

    /// An exception thrown by Job::run as an answer (the one table); unknown exceptions are 500 without detail.
    [[nodiscard]] Response problem(const Request& request, std::exception_ptr error) const;

    /// Grows one mushroom, to know that it can: for /readyz.
    [[nodiscard]] bool self_test();

    /// The final answer to a request whose body has not come yet, if its head alone decides: 400, 404, 405, 413, 414, 415.
    [[nodiscard]] std::optional<Response> response_to_head(const Request& request) const;

    /// What plan() takes to read the body of a request, whether it is refused, kept or to be made;
    /// nothing for most.
    [[nodiscard]] Cost cost_of_reading(const Request& request) const;

    /// Whether a body of this size may come to this target (413), in bytes.
    [[nodiscard]] std::size_t most_body(std::string_view method, std::string_view target) const;

    [[nodiscard]] const Counters& counters() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// plan() on a thread that may take milliseconds: never a Job that `prepares`.
[[nodiscard]] std::variant<Response, Job> plan_here(Service& service, const Request& request);

/// plan + run inline: HTTP behaviour without sockets, for tests and tools.
[[nodiscard]] Response handle(Service& service, const Request& request);

}  // namespace sporeprint::api
