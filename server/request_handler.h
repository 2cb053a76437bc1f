// The request handler: the layer between the transport and api::Service. It responds to health and
// metrics requests and to cached resources at once; it joins everything else to a
// computation in flight and responds when that completes.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "api/service.h"
#include "server/http/transport.h"
#include "server/jobs/budgets.h"
#include "server/jobs/single_flight.h"
#include "server/jobs/thread_pool.h"
#include "server/operations/log.h"
#include "server/operations/metrics.h"
#include "server/operations/signatures.h"

namespace sporeprint::server {

/// Limits and settings of a RequestHandler.
struct RequestHandlerOptions {
    std::size_t threads = 1;          ///< jobs that run in parallel
    std::size_t longest_queue = 128;  ///< jobs that wait for a thread; 503 beyond
    std::size_t most_waiters = 1024;  ///< requests that wait for jobs; 503 beyond
    bool metrics = true;              ///< true: the main transport serves /metrics
    std::string base_path;            ///< path prefix of all URLs of the service, or empty
    BudgetOptions budget;             ///< per payer, in units of api::Cost::work(); 429 beyond
};

/// The state that a reload replaces while requests are served.
struct AppState {
    std::shared_ptr<api::Service> service;
    /// required by URLs of generated resources; null: no signature is required
    std::shared_ptr<const Signatures> signatures;
};

/// Turns requests of the transport into calls of api::Service: checks signatures, charges work
/// budgets, runs jobs on a thread pool, shares their results between equal requests, and counts and
/// logs what was served. Thread-safe.
class RequestHandler {
  public:
    /// pre  metrics and log outlive this object
    RequestHandler(AppState state, Metrics& metrics, Log& log,
                   const RequestHandlerOptions& options);
    ~RequestHandler() = default;
    RequestHandler(const RequestHandler&) = delete;
    RequestHandler& operator=(const RequestHandler&) = delete;

    /// Returns the callbacks of the main transport.
    [[nodiscard]] Handlers handlers();

    /// Returns the callbacks of a separate transport that serves /metrics, /livez and /readyz only;
    /// all other paths are 404.
    [[nodiscard]] Handlers metrics_handlers();

    /// Returns the state that new requests use.
    [[nodiscard]] std::shared_ptr<const AppState> state() const;

    /// Uses this state for new requests; requests already begun finish with the previous one.
    void renew(AppState state);

    /// Generates the resources of these targets (path and query) in parallel and caches them.
    /// Blocks until all are generated. No signatures are required.
    ///
    /// returns  the response to each, in the order of the targets
    [[nodiscard]] std::vector<api::Response> warm(std::span<const std::string> targets);

    /// Returns the number of jobs that run in parallel.
    [[nodiscard]] std::size_t threads() const { return pool_.count(); }

    /// Makes is_ready() true while the queues have capacity; initially it is false.
    void open() { ready_ = true; }

    /// Makes is_ready() false. Requests are still served.
    void close() { ready_ = false; }

    /// Sets the transport whose connections are reported in the metrics and whose queue is_ready()
    /// tests; nullptr for none. It has to exist while these are used.
    void watch(const Transport* transport) { transport_ = transport; }

    /// Returns true between open() and close() while the queues of the thread pool and of the
    /// watched transport are less than 90 % full; /readyz responds with 200 if true, otherwise with
    /// 503.
    [[nodiscard]] bool is_ready() const;

  private:
    /// held as long as a request uses the state
    using StatePointer = std::shared_ptr<const AppState>;

    /// The response that equal requests share, and how long it took.
    struct JobResult {
        api::Response response;
        api::Timing timing;
    };
    using SharedJobs = SingleFlight<JobResult>;

    /// A request after the check of its signature.
    struct CheckedRequest {
        std::shared_ptr<const api::Request> request;       ///< its target without the signature
        std::shared_ptr<const api::RoutedRequest> routed;  ///< of this target
        std::optional<std::int64_t> expires;  ///< seconds since 1970 at which its signature ends
        std::string refusal;                  ///< reason of a refusal; empty if accepted
        bool is_charged = false;              ///< its work was charged to a budget
        Payer payer{};                        ///< whose budget that is
    };
    /// Finds the route of a request; paths of operational requests are served here, all others by
    /// the service.
    [[nodiscard]] api::RoutedRequest route(const api::Request& request) const;
    /// Checks the signature of a request where one is required and removes it from the target.
    [[nodiscard]] CheckedRequest check_signature(
        const AppState& state, const std::shared_ptr<PendingRequest>& pending) const;

    /// Responds to a request now, or arranges that its job does so when it completes.
    void respond(const std::shared_ptr<PendingRequest>& pending);
    /// Does the same for a request whose signature is checked.
    ///
    /// correspondence_ready  true after a warm-up job of this request
    void respond(const StatePointer& state, const std::shared_ptr<PendingRequest>& pending,
                 CheckedRequest checked, bool correspondence_ready);
    /// Responds to a request whose job was cancelled, unless its client has disconnected.
    void reply_cancelled(const AppState& state, const std::shared_ptr<PendingRequest>& pending,
                         const CheckedRequest& checked, PendingRequest::CancelReason reason);
    /// Returns the cost of reading the body of a request, which plan() has to do before the cost of
    /// the job is known, so that it is charged even if the request is refused. Microseconds of work;
    /// 0 without budgets.
    [[nodiscard]] std::uint64_t work_of_reading(const CheckedRequest& checked) const;
    /// Sends a response of the service after adapting it to this client and its signature.
    void reply(const std::shared_ptr<PendingRequest>& pending, const CheckedRequest& checked,
               api::Response response) const;
    /// Runs a job on this thread and on idle threads of the pool, and caches its response.
    ///
    /// queue   milliseconds that the job waited
    /// throws  what the job throws
    [[nodiscard]] JobResult run_job(api::Service& service, const api::Job& job,
                                    std::stop_token stop, double queue);
    /// Joins the computation of a job's key, or starts it.
    ///
    /// then     called once when the computation completes; see SingleFlight::join()
    /// returns  nothing if the queue or the list of waiters is full
    std::optional<SharedJobs::Ticket> join(const StatePointer& state, api::Job job,
                                           SharedJobs::OnComplete then);
    /// Returns whose budget the work of a request is charged to: that of the owner of its token, if one with it was
    /// let in a moment ago, so that owners behind one address do not share a budget.
    [[nodiscard]] Payer payer_of(const AppState& state, const PendingRequest& pending) const;
    /// Charges the cost of reading a request's body and of its job to the budget of a payer. A job
    /// in flight already is not charged. If the budget does not suffice for both, only the reading
    /// is charged.
    ///
    /// reading  cost of reading the body, microseconds of work
    /// work     cost of the job, microseconds of work; set to 0 if the job is in flight already or
    ///          there are no budgets
    /// returns  how long until the budget suffices; zero if it does
    [[nodiscard]] std::chrono::microseconds charge(const Payer& payer, const api::Key& key,
                                                   std::uint64_t reading, std::uint64_t& work);
    /// Responds with 429.
    ///
    /// missing  how long until the budget suffices
    void reply_over_budget(const api::Service& service,
                           const std::shared_ptr<PendingRequest>& pending,
                           const CheckedRequest& checked, std::chrono::microseconds missing);
    /// Sets the RateLimit headers from the remaining budget of a payer, which makes the response
    /// private to this client.
    void set_rate_limit_headers(const Payer& payer, api::Response& response) const;
    /// Responds to /livez, /readyz and /metrics.
    ///
    /// metrics  false: /metrics is 404 here
    api::Response operational_response(const api::Request& request,
                                       const api::RoutedRequest& routed, bool metrics);
    /// Returns the response to one of the requests that waited for a computation.
    api::Response deliver(const api::Service& service, const api::Request& request,
                          const api::Delivery& delivery, const SharedJobs::Completion& completion);
    /// Returns a response of text that must not be stored.
    api::Response text_response(const api::Request& request, const std::string& text,
                                std::string type = "text/plain; charset=utf-8") const;
    /// Counts and logs a response that was sent.
    void report(const Served& served);
    [[nodiscard]] Gauges gauges() const;

    mutable std::mutex state_mutex_;
    std::shared_ptr<const AppState> state_;
    Metrics& metrics_;
    Log& log_;
    RequestHandlerOptions options_;
    std::optional<Budgets> budgets_;
    std::atomic<bool> ready_{false};
    std::atomic<const Transport*> transport_{nullptr};
    ThreadPool pool_;
    SharedJobs single_flight_;  ///< destroyed before the pool
};

}  // namespace sporeprint::server
