// The reception: what stands between sockets and service. Health and metrics are answered at once,
// kept answers too; work goes to the flights, and who asked for it is answered when it lands.
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

struct RequestHandlerOptions {
    std::size_t threads = 1;          ///< jobs at once
    std::size_t longest_queue = 128;  ///< jobs that wait for a slot; 503 beyond
    std::size_t most_waiters = 1024;  ///< requests that wait for jobs; 503 beyond
    bool metrics = true;              ///< whether /metrics is answered here
    std::string base_path;            ///< under which clients see the service, or empty
    BudgetOptions budget;             ///< of each client, in api::Cost::work(); 429 beyond
};

/// What may be put in another's place while requests come.
struct AppState {
    std::shared_ptr<api::Service> service;
    std::shared_ptr<const Signatures>
        signatures;  ///< asked for by what is made; none for no such thing
};

class RequestHandler {
  public:
    /// metrics, log  outlive this
    RequestHandler(AppState state, Metrics& metrics, Log& log,
                   const RequestHandlerOptions& options);
    ~RequestHandler() = default;
    RequestHandler(const RequestHandler&) = delete;
    RequestHandler& operator=(const RequestHandler&) = delete;

    /// For the main transport.
    [[nodiscard]] Handlers handlers();

    /// For a port of its own: /metrics and health only.
    [[nodiscard]] Handlers metrics_handlers();

    /// What requests are answered with.
    [[nodiscard]] std::shared_ptr<const AppState> state() const;

    /// SharedJobs what comes from here on with these; what has begun ends with those before.
    void renew(AppState state);

    /// Makes what is asked for, several at once, so that it is kept; signatures are not asked for.
    ///
    /// returns  the answer to each, made or kept
    [[nodiscard]] std::vector<api::Response> warm(std::span<const std::string> targets);

    /// Jobs at once.
    [[nodiscard]] std::size_t threads() const { return pool_.count(); }

    /// From here on /readyz may say yes.
    void open() { ready_ = true; }

    /// From here on /readyz says no.
    void close() { ready_ = false; }

    /// Where the metrics find the connections.
    void watch(const Transport* transport) { transport_ = transport; }

    [[nodiscard]] bool is_ready() const;

  private:
    using Using = std::shared_ptr<const AppState>;  ///< held as long as a request uses them

    struct JobResult {
        api::Response response;
        api::Timing timing;
    };
    using SharedJobs = SingleFlight<JobResult>;

    /// What a visit asks for: its own request, or what is left of that without its signature.
    struct Requested {
        std::shared_ptr<const api::Request> request;
        std::optional<std::int64_t> expires;  ///< seconds since 1970 after which it is refused
        std::string why_not;                  ///< why it is refused; empty if it is not
        bool is_charged = false;              ///< whether its work was taken from a budget
    };
    [[nodiscard]] Requested requested(const AppState& state,
                                      const std::shared_ptr<PendingRequest>& pending) const;

    void respond(const std::shared_ptr<PendingRequest>& pending);
    /// prepared  whether a job that `prepares` is behind it
    void respond(const Using& state, const std::shared_ptr<PendingRequest>& pending,
                 Requested requested, bool correspondence_ready);
    /// Replies with what the service answers, made fit for this client and its URL.
    void reply(const std::shared_ptr<PendingRequest>& pending, const Requested& requested,
               api::Response response) const;
    [[nodiscard]] JobResult generated(api::Service& service, const api::Job& job,
                                      std::stop_token stop, double queue);
    std::optional<SharedJobs::Ticket> join(const Using& state, api::Job job,
                                           SharedJobs::OnComplete then);
    /// Takes what a job costs from the budget of who asks, unless somebody has begun it, and what
    /// reading its body took.
    ///
    /// returns  how long until there is enough; zero if there is
    [[nodiscard]] std::chrono::microseconds charge(const Address& client, const api::Key& key,
                                                   std::uint64_t reading, std::uint64_t& work);
    void reply_over_budget(const api::Service& service,
                           const std::shared_ptr<PendingRequest>& pending,
                           const api::Request& request, std::chrono::microseconds missing);
    /// Tells a client what is left of its budget of work; such an answer is for this client alone.
    void tell_budget(const Address& client, api::Response& response) const;
    api::Response housekeeping(const api::Request& request, std::string_view path, bool metrics);
    api::Response delivered(const api::Service& service, const api::Request& request,
                            const SharedJobs::Completion& completion);
    api::Response plain(const api::Request& request, const std::string& text,
                        std::string type = "text/plain; charset=utf-8") const;
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
    SharedJobs single_flight_;  ///< ends before the slots do
};

}  // namespace sporeprint::server
