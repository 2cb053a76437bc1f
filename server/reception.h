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
#include "server/budgets.h"
#include "server/flights.h"
#include "server/log.h"
#include "server/metrics.h"
#include "server/signatures.h"
#include "server/slots.h"
#include "server/transport.h"

namespace sporeprint::server {

struct ReceptionOptions {
    std::size_t slots = 1;            ///< jobs at once
    std::size_t longest_queue = 128;  ///< jobs that wait for a slot; 503 beyond
    std::size_t most_waiters = 1024;  ///< requests that wait for jobs; 503 beyond
    bool metrics = true;              ///< whether /metrics is answered here
    std::string base_path;            ///< under which clients see the service, or empty
    BudgetOptions budget;             ///< of each client, in api::Cost::work(); 429 beyond
};

/// What may be put in another's place while requests come.
struct Means {
    std::shared_ptr<api::Service> service;
    std::shared_ptr<const Signatures>
        signatures;  ///< asked for by what is made; none for no such thing
};

class Reception {
  public:
    /// metrics, log  outlive this
    Reception(Means means, Metrics& metrics, Log& log, const ReceptionOptions& options);
    ~Reception() = default;
    Reception(const Reception&) = delete;
    Reception& operator=(const Reception&) = delete;

    /// For the main transport.
    [[nodiscard]] Handlers handlers();

    /// For a port of its own: /metrics and health only.
    [[nodiscard]] Handlers metrics_handlers();

    /// What requests are answered with.
    [[nodiscard]] std::shared_ptr<const Means> means() const;

    /// Answers what comes from here on with these; what has begun ends with those before.
    void renew(Means means);

    /// Makes what is asked for, several at once, so that it is kept; signatures are not asked for.
    ///
    /// returns  the answer to each, made or kept
    [[nodiscard]] std::vector<api::Answer> warm(std::span<const std::string> targets);

    /// Jobs at once.
    [[nodiscard]] std::size_t slots() const { return slots_.count(); }

    /// From here on /readyz may say yes.
    void open() { ready_ = true; }

    /// From here on /readyz says no.
    void close() { ready_ = false; }

    /// Where the metrics find the connections.
    void watch(const Transport* transport) { transport_ = transport; }

    [[nodiscard]] bool is_ready() const;

  private:
    using Using = std::shared_ptr<const Means>;  ///< held as long as a request uses them

    struct Made {
        api::Answer answer;
        api::Timing timing;
    };
    using Answers = Flights<Made>;

    /// What a visit asks for: its own request, or what is left of that without its signature.
    struct Asked {
        std::shared_ptr<const api::Request> request;
        std::optional<std::int64_t> expires;  ///< seconds since 1970 after which it is refused
        std::string why_not;                  ///< why it is refused; empty if it is not
        bool is_charged = false;              ///< whether its work was taken from a budget
    };
    [[nodiscard]] Asked asked(const Means& means, const std::shared_ptr<Visit>& visit) const;

    void answer(const std::shared_ptr<Visit>& visit);
    /// prepared  whether a job that `prepares` is behind it
    void answer(const Using& means, const std::shared_ptr<Visit>& visit, Asked asked,
                bool prepared);
    /// Replies with what the service answers, made fit for this client and its URL.
    void reply(const std::shared_ptr<Visit>& visit, const Asked& asked, api::Answer answer) const;
    [[nodiscard]] Made made(api::Service& service, const api::Job& job, std::stop_token stop,
                            double queue);
    std::optional<Answers::Seat> board(const Using& means, api::Job job, Answers::Then then);
    /// Takes what a job costs from the budget of who asks, unless somebody has begun it, and what
    /// reading its body took.
    ///
    /// returns  how long until there is enough; zero if there is
    [[nodiscard]] std::chrono::microseconds charge(const Address& client, const api::Key& key,
                                                   std::uint64_t reading, std::uint64_t& work);
    void reply_over_budget(const api::Service& service, const std::shared_ptr<Visit>& visit,
                           const api::Request& request, std::chrono::microseconds missing);
    /// Tells a client what is left of its budget of work; such an answer is for this client alone.
    void tell_budget(const Address& client, api::Answer& answer) const;
    api::Answer housekeeping(const api::Request& request, std::string_view path, bool metrics);
    api::Answer delivered(const api::Service& service, const api::Request& request,
                          const Answers::Landing& landing);
    api::Answer plain(const api::Request& request, const std::string& text,
                      std::string type = "text/plain; charset=utf-8") const;
    void report(const Served& served);
    [[nodiscard]] Gauges gauges() const;

    mutable std::mutex means_mutex_;
    std::shared_ptr<const Means> means_;
    Metrics& metrics_;
    Log& log_;
    ReceptionOptions options_;
    std::optional<Budgets> budgets_;
    std::atomic<bool> ready_{false};
    std::atomic<const Transport*> transport_{nullptr};
    Slots slots_;
    Answers flights_;  ///< ends before the slots do
};

}  // namespace sporeprint::server
