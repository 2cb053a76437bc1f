// The transport: the HTTP/1.1 server. One reactor thread owns all sockets; a few workers call the
// handlers, which respond at once or later. A request that waits for its response occupies no
// thread.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "api/http/message.h"
#include "api/http/routed_request.h"
#include "server/http/addresses.h"

namespace sporeprint::server {

/// Limits and timeouts of a Transport.
struct TransportOptions {
    std::string host = "127.0.0.1";
    int port = 8080;                              ///< 0: any free port
    std::size_t workers = 4;                      ///< threads that call the handlers
    std::size_t longest_queue = 1024;             ///< requests that wait for a worker; 503 beyond
    std::size_t most_connections = 4096;          ///< open connections; 503 beyond
    std::size_t most_of_client = 0;               ///< of one client; 429 beyond; 0: unlimited
    Proxies proxies;                              ///< trusted proxies, exempt from most_of_client
    std::size_t hot_bytes = 64u << 20;            ///< size of the hot-response table; 0: none
    int backlog = 1024;                           ///< of listen(): connections not yet accepted
    std::size_t most_requests = 1000;             ///< per connection
    std::size_t most_body_memory = 256u << 20;    ///< bytes of all request bodies in memory
    std::size_t most_body_of_client = 64u << 20;  ///< of one client; proxies are exempt
    std::size_t body_rate = 1u << 20;         ///< least bytes per second of a body, beyond `body`
    std::size_t most_pinned = 256u << 20;     ///< bytes of responses in flight to slow clients
    std::chrono::milliseconds idle{30'000};   ///< until the first byte of a request
    std::chrono::milliseconds silence{2000};  ///< between two bytes of a request
    std::chrono::milliseconds head{5000};     ///< for a complete head
    std::chrono::milliseconds body{10000};    ///< for a body, plus its length / body_rate
    std::chrono::milliseconds response{20'000};     ///< until CancelReason::timed_out
    std::chrono::milliseconds blocked_write{5000};  ///< in which the client must accept a byte
    std::chrono::milliseconds shutdown_grace{100};  ///< drain() accepts connections this long
};

/// The outcome of one request, for the log and the metrics.
struct Served {
    std::string method, target, id, peer;
    std::string client;               ///< reported by a trusted proxy; empty without one
    std::string trace_id, parent_id;  ///< of a valid traceparent; empty without one
    std::string label;                ///< RoutedRequest::label()
    int status = 0;           ///< 499: the client disconnected before the response was ready
    std::uint64_t bytes = 0;  ///< sent, of head and body
    double milliseconds = 0;  ///< from the last byte of the request to the last of the response
    std::string cache;        ///< Cache-Status
    bool complete = true;     ///< the whole response was sent
};

/// Status of a response that is not sent, because the client has disconnected.
inline constexpr int client_left = 499;

/// A request that waits for its response. Thread-safe. If its last owner destroys it without a
/// response, the client receives a 500 without a body.
class PendingRequest {
  public:
    /// The client has disconnected; TransportOptions::response has passed.
    enum class CancelReason { disconnected, timed_out };

    PendingRequest() = default;
    PendingRequest(const PendingRequest&) = delete;
    PendingRequest& operator=(const PendingRequest&) = delete;
    virtual ~PendingRequest() = default;

    [[nodiscard]] virtual const api::Request& request() const = 0;

    /// Returns what Handlers::route() has returned for the request; it lives as long as this.
    [[nodiscard]] virtual const api::RoutedRequest& routed() const = 0;

    /// Returns the address of the client: the peer, or the one reported by a trusted proxy.
    [[nodiscard]] virtual const Address& client() const = 0;

    /// Returns true if the client has disconnected.
    [[nodiscard]] virtual bool is_disconnected() const = 0;

    /// Sends the response; with status client_left nothing is sent. Later calls have no effect.
    virtual void reply(api::Response response) = 0;

    /// Calls `task` on a worker; if it throws, the response is a 500 without a body.
    virtual void resume(std::function<void()> task) = 0;

    /// Registers a callback for a response that will come later: `on_cancel` is called on a worker,
    /// perhaps at once, if the client disconnects or TransportOptions::response passes before there
    /// is a response. A later call replaces the callback.
    virtual void wait(std::function<void(CancelReason)> on_cancel) = 0;
};

/// The callbacks of a transport. They are called on several threads concurrently. All exceptions
/// are caught; one of `respond` or `refuse` becomes a 500 without a body.
struct Handlers {
    /// Responds to a request, now or later. It must not block.
    std::function<void(const std::shared_ptr<PendingRequest>&)> respond;
    /// Returns the response to an error detected by the transport. This and the following callbacks
    /// must be fast, as they run on the reactor thread.
    std::function<api::Response(const api::Request&, int status, std::string_view detail)> refuse;
    /// Finds the route of a request whose body has not arrived: the largest body that it accepts
    /// (413), its name for the metrics, and the response if the head alone determines it, which a
    /// client that expects "100 Continue" receives instead. Called once per request.
    std::function<std::shared_ptr<const api::RoutedRequest>(const api::Request&)> route;
    /// Records a request that has ended.
    std::function<void(const Served&)> served;
    /// Targets with a constant response to GET, which the reactor thread sends by itself.
    std::vector<std::pair<std::string, api::Response>> pinned_responses;
};

class HttpHeadCodec;
class Reactor;

/// An HTTP/1.1 server on one port.
class Transport {
  public:
    /// The state of a connection.
    enum class Phase { idle, head, body, busy, writing, lingering };
    static constexpr std::array<const char*, 6> phases = {"idle", "head",    "body",
                                                          "busy", "writing", "parting"};

    /// Current counts of a transport, for the metrics.
    struct Load {
        std::array<std::size_t, phases.size()> connections{};  ///< by Phase
        std::size_t queue = 0;                                 ///< requests that wait for a worker
        std::size_t queue_limit = 0;                           ///< greatest length of that queue
        std::uint64_t refused = 0;  ///< connections refused beyond most_connections
        std::uint64_t limited = 0;  ///< connections refused beyond most_of_client
        std::uint64_t hot_hits = 0, hot_not_modified = 0,
                      hot_evictions = 0;  ///< of the hot-response table
        std::size_t hot_bytes = 0, hot_entries = 0;
        std::size_t pinned = 0;               ///< bytes of responses in flight to slow clients
        std::uint64_t aborted_responses = 0;  ///< responses aborted to free memory
        std::size_t body_bytes = 0;           ///< of request bodies in memory
        std::uint64_t aborted_uploads = 0;    ///< request bodies aborted to free memory

        /// Returns the number of open connections.
        [[nodiscard]] std::size_t open() const {
            std::size_t sum = 0;
            for (const std::size_t count : connections) sum += count;
            return sum;
        }
    };

    /// Binds and listens. No connection is accepted before start().
    ///
    /// throws  std::runtime_error with a message for the operator if it cannot bind
    Transport(TransportOptions options, Handlers handlers);

    /// Calls drain().
    ~Transport();
    Transport(const Transport&) = delete;
    Transport& operator=(const Transport&) = delete;

    /// Starts the reactor thread.
    void start();

    /// Shuts down gracefully: accepts connections for the shutdown grace, responds to all requests
    /// received, closes each connection after its response, and returns when the last is closed.
    void drain();

    /// Invalidates the hot-response table except for its pinned responses. Responses of requests
    /// begun before this call are not stored.
    void invalidate();

    /// Returns the bound port.
    [[nodiscard]] int port() const;
    [[nodiscard]] Load load() const;

  private:
    TransportOptions options_;
    Handlers handlers_;
    std::unique_ptr<HttpHeadCodec> codec_;
    std::unique_ptr<Reactor> reactor_;
    std::atomic<bool> draining_{false};
    std::jthread thread_;
};

}  // namespace sporeprint::server
