// The transport: sockets in, answers out. One thread owns every socket; a few workers call those
// above, who may answer at once or later; whoever waits holds no thread.
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
#include "server/http/addresses.h"

namespace sporeprint::server {

struct TransportOptions {
    std::string host = "127.0.0.1";
    int port = 8080;                            ///< 0: any that is free
    std::size_t workers = 4;                    ///< threads that call the handlers
    std::size_t longest_queue = 1024;           ///< requests that wait for a worker; 503 beyond
    std::size_t most_connections = 4096;        ///< open at once; 503 beyond
    std::size_t most_of_client = 0;             ///< of those, of one client; 429 beyond; 0: all
    Proxies proxies;                            ///< they speak for others and may open all
    std::size_t hot_bytes = 64u << 20;          ///< of answers that are given again; 0: none
    int backlog = 1024;                         ///< connections the kernel keeps for us
    std::size_t most_requests = 1000;           ///< on one connection
    std::size_t most_body_memory = 256u << 20;  ///< bytes of bodies that have arrived, all together
    std::size_t most_body_of_client = 64u << 20;  ///< of those, of one client but a trusted proxy
    std::size_t body_rate = 1u << 20;  ///< bytes a second that a body has to come at, beside `body`
    std::size_t most_pinned = 256u << 20;  ///< bytes of answers that wait for slow clients likewise
    std::chrono::milliseconds idle{30'000};   ///< for the first byte of a request
    std::chrono::milliseconds silence{2000};  ///< between two bytes of a request
    std::chrono::milliseconds head{5000};     ///< for a whole head
    std::chrono::milliseconds body{10000};    ///< for a body, beside its length at body_rate
    std::chrono::milliseconds response{
        20'000};  ///< until PendingRequest::wait() is told that it is late
    std::chrono::milliseconds blocked_write{5000};  ///< without the client taking a byte
    std::chrono::milliseconds shutdown_grace{100};  ///< accepting goes on for so long in drain()
};

/// What happened to one request, for the log and the metrics.
struct Served {
    std::string method, target, id, peer;
    std::string client;               ///< for whom a trusted proxy has asked; empty without one
    std::string trace_id, parent_id;  ///< of a proper traceparent; empty without
    std::string label;                ///< what Handlers::label() said of it
    int status = 0;                   ///< 499: the client left before its answer was made
    std::uint64_t bytes = 0;          ///< of head and body that went out
    double milliseconds = 0;  ///< from the last byte of the request to the last of the answer
    std::string cache;        ///< Cache-Status
    bool complete = true;     ///< whether all of the answer went out
};

/// Status of an answer that is not sent, because nobody waits for it any more.
inline constexpr int client_left = 499;

/// One request that waits for its answer. Held by whoever will answer; used on any thread. When the
/// last who holds it lets it go unanswered, the client gets a bare 500.
class PendingRequest {
  public:
    enum class CancelReason { disconnected, timed_out };  ///< the client is gone; it has waited too long

    PendingRequest() = default;
    PendingRequest(const PendingRequest&) = delete;
    PendingRequest& operator=(const PendingRequest&) = delete;
    virtual ~PendingRequest() = default;

    [[nodiscard]] virtual const api::Request& request() const = 0;

    /// Who asks: the other end, or whom it speaks for if it is a trusted proxy.
    [[nodiscard]] virtual const Address& client() const = 0;

    /// Whether the client has left.
    [[nodiscard]] virtual bool is_gone() const = 0;

    /// Answers, with status client_left for nobody. Only the first answer counts.
    virtual void reply(api::Response response) = 0;

    /// Calls `go_on` on a worker; what that throws is a bare 500.
    virtual void resume(std::function<void()> go_on) = 0;

    /// When the answer will come later: `over` is called on a worker if the client leaves or
    /// TransportOptions::answer has passed before there is one; perhaps at once. Called again, the
    /// later `over` takes the place of the earlier.
    virtual void wait(std::function<void(CancelReason)> over) = 0;
};

/// What the transport asks of those above it; all are called on many threads at once. Whatever they
/// throw is caught: an exception of `answer` or `refuse` becomes a bare 500.
struct Handlers {
    /// Answers a request, now or later; must not wait for others.
    std::function<void(const std::shared_ptr<PendingRequest>&)> respond;
    /// A problem that the transport itself has found. This and all below must not take long: they
    /// are called by the thread that serves all connections.
    std::function<api::Response(const api::Request&, int status, std::string_view detail)> refuse;
    std::function<std::size_t(std::string_view method, std::string_view target)> most_body;
    /// The answer to a request whose body has not come, if it is the same whatever the body is: a
    /// client that expects "100 Continue" gets it instead. None for no such answer.
    std::function<std::optional<api::Response>(const api::Request&)> judge_head;
    /// A name for requests of this kind, of which there are few.
    std::function<std::string(std::string_view method, std::string_view target)> label;
    std::function<void(const Served&)> served;
    /// Targets whose answer to GET is always this: given by that thread itself, whatever waits.
    std::vector<std::pair<std::string, api::Response>> pinned_responses;
};

class HttpHeadCodec;
class Reactor;

class Transport {
  public:
    /// What a connection is doing.
    enum class Phase { idle, head, body, busy, writing, lingering };
    static constexpr std::array<const char*, 6> phases = {"idle", "head",    "body",
                                                          "busy", "writing", "parting"};

    struct Load {
        std::array<std::size_t, phases.size()> connections{};  ///< by Phase
        std::size_t queue = 0;                                 ///< requests that wait for a worker
        std::size_t queue_limit = 0;                           ///< and how many may
        std::uint64_t refused = 0;  ///< connections turned away because there were too many
        std::uint64_t limited = 0;  ///< because one client had too many
        std::uint64_t hot_hits = 0, hot_not_modified = 0, hot_evictions = 0;  ///< given again
        std::size_t hot_bytes = 0, hot_entries = 0;
        std::size_t pinned = 0;  ///< bytes of answers that wait for slow clients
        std::uint64_t given_up =
            0;  ///< answers that were not waited for to their end, for others' sake
        std::size_t body_bytes = 0;          ///< of request bodies that have arrived
        std::uint64_t uploads_given_up = 0;  ///< bodies refused midway, as there was no room

        [[nodiscard]] std::size_t open() const {
            std::size_t sum = 0;
            for (const std::size_t count : connections) sum += count;
            return sum;
        }
    };

    /// Binds and listens; nothing is accepted before start().
    ///
    /// throws  std::runtime_error, one sentence for a person, when the address cannot be had
    Transport(TransportOptions options, Handlers handlers);

    /// Drains.
    ~Transport();
    Transport(const Transport&) = delete;
    Transport& operator=(const Transport&) = delete;

    void start();

    /// Accepts for a short farewell, then no more; answers what has arrived, closes every
    /// connection after its answer, and returns when the last has ended.
    void drain();

    /// Gives no answer again that was asked for before this was called, but for those that stand.
    void forget();

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
