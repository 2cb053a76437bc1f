// The service without sockets: plan() responds immediately where that is possible in microseconds,
// and otherwise returns a Job.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "api/http/message.h"
#include "api/http/routed_request.h"
#include "api/http/service_options.h"
#include "api/library/library.h"
#include "core/atlas/atlas.h"

namespace sporeprint::api {

class Service {
  public:
    /// Creates a service.
    ///
    /// pre  the atlas has a leaf and a tree, as those of built_in_atlas() and atlas_from() have
    ///
    /// library  species of users; nullptr for none
    Service(std::shared_ptr<const Atlas> atlas, const ServiceOptions& options,
            std::shared_ptr<Library> library = nullptr);

    /// Creates a service with other templates that replaces `other`: both share options, library, counters
    /// and caches, whose keys contain the hash of the templates. The folder of the page is read
    /// again.
    Service(std::shared_ptr<const Atlas> atlas, const Service& other);
    ~Service();
    Service(const Service&) = delete;
    Service& operator=(const Service&) = delete;

    /// Parses the target of a request and finds its route. The body is not read. Takes a few
    /// microseconds; throws nothing but std::bad_alloc.
    [[nodiscard]] RoutedRequest route(const Request& request) const;

    /// Reads and checks the parameters of a request, builds its canonical text, compares ETags and
    /// looks into the caches. Returns the response, or the job that computes it. Never blocks, never
    /// throws.
    ///
    /// A species of the library that is not in memory is loaded by a warm-up job. A correspondence
    /// (MorphSet: the mapping between the outlines of the species of a mix) may be
    /// needed to check a request. If it is not cached, the result depends on correspondence_ready:
    ///
    /// routed                route() of the request
    /// correspondence_ready  true: it is computed here, which takes milliseconds; false: the result
    ///                       is a warm-up job (Job::is_warm_up), which computes it
    [[nodiscard]] Plan plan(const Request& request, const RoutedRequest& routed,
                            bool correspondence_ready = false);

    /// Returns the owner in the library to whom the token of a request belongs, as far as that is known without asking
    /// the database: who pays for its work. Never blocks; empty for nobody.
    [[nodiscard]] std::string owner_of(const Request& request) const;

    /// Inserts the response of a job into the response cache if its status is 200 and is_stored is
    /// true. To be called once per computation.
    ///
    /// key  that of the job
    void finish(const Key& key, const Response& response);

    /// Returns the response to one of the requests that waited for a job: the shared response,
    /// completed with Cache-Status, Server-Timing and the request id, without body for HEAD. Its
    /// gzip variant is used if it exists and the client accepts it, or if there is no other.
    ///
    /// delivery  that of the job
    [[nodiscard]] Response deliver(const Request& request, const Delivery& delivery,
                                   const Response& shared, Outcome outcome,
                                   const Timing& timing) const;

    /// Returns a problem+json response for an error found outside plan() (408, 413, 414, 429, 431,
    /// 500, 503, 504).
    ///
    /// extra  further headers
    [[nodiscard]] Response problem(const Request& request, int status, std::string_view detail,
                                   const std::vector<Header>& extra = {}) const;

    /// Returns the problem for an exception of Job::run; unknown exceptions are 500 without detail.
    [[nodiscard]] Response problem(const Request& request, std::exception_ptr error) const;

    /// Generates one small mushroom of the first species of the atlas. Returns true on success.
    [[nodiscard]] bool self_test();

    /// Returns the cost of parsing the JSON body of a request, which is charged whatever the
    /// response is; zero for requests to routes without a JSON body.
    ///
    /// routed  route() of the request
    [[nodiscard]] static Cost cost_of_reading(const Request& request, const RoutedRequest& routed);

    /// Updates the sizes of the caches among the counters and returns the counters.
    [[nodiscard]] const Counters& counters() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// Returns the plan of a request and computes a missing correspondence itself, which takes
/// milliseconds: the result is never a warm-up job.
[[nodiscard]] Plan plan_here(Service& service, const Request& request);

/// Returns the response to a request, generated on the calling thread without sockets, for tests
/// and tools.
[[nodiscard]] Response handle(Service& service, const Request& request);

}  // namespace sporeprint::api
