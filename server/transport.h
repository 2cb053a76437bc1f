// The transport: sockets in, answers out. cpp-httplib parses requests that have passed our own
// strict bounds and formats the heads of answers; reading, waiting and sending are done here.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "api/http.h"

namespace sporeprint::server {

struct TransportOptions {
    std::string host = "127.0.0.1";
    int port = 8080;                            ///< 0: any that is free
    std::size_t threads = 256;                  ///< one per connection that is open
    std::size_t waiting = 512;                  ///< connections that wait for a thread
    int backlog = 1024;                         ///< connections the kernel keeps for us
    std::size_t most_requests = 1000;           ///< on one connection
    std::size_t most_body_memory = 256u << 20;  ///< bytes of large bodies, all together
    std::chrono::milliseconds idle{2000};       ///< for the first byte of a request
    std::chrono::milliseconds silence{2000};    ///< between two bytes of a request
    std::chrono::milliseconds head{5000};       ///< for a whole head
    std::chrono::milliseconds body{10000};      ///< for a body of up to 256 kB; else in proportion
    std::chrono::milliseconds blocked_write{5000};  ///< without the client taking a byte
    std::chrono::milliseconds farewell{100};        ///< accepting goes on for so long in drain()
};

/// What happened to one request, for the log and the metrics.
struct Served {
    std::string method, target, id, peer;
    int status = 0;           ///< 499: the client left before its answer was made
    std::uint64_t bytes = 0;  ///< of head and body that went out
    double milliseconds = 0;  ///< from the last byte of the request to the last of the answer
    std::string cache;        ///< Cache-Status
    bool complete = true;     ///< whether all of the answer went out
};

/// Status of an answer that is not sent, because nobody waits for it any more.
inline constexpr int client_left = 499;

/// Whether the client has closed its end; may be asked at any time while a request is handled.
using Gone = std::function<bool()>;

/// What the transport asks of those above it; all are called on many threads at once. Whatever they
/// throw is caught: an exception of `answer` or `refuse` becomes a bare 500.
struct Handlers {
    std::function<api::Answer(const api::Request&, const Gone&)> answer;
    std::function<api::Answer(const api::Request&, int status, std::string_view detail)> refuse;
    std::function<std::size_t(std::string_view method, std::string_view target)> most_body;
    std::function<void(const Served&)> served;
};

class Transport {
  public:
    struct Load {
        std::size_t open = 0;       ///< connections that have a thread
        std::size_t waiting = 0;    ///< connections that wait for one
        std::uint64_t refused = 0;  ///< connections closed because too many waited
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

    [[nodiscard]] int port() const;
    [[nodiscard]] Load load() const;

  private:
    class Listener;
    class Connection;

    void accept_all();
    bool admit(int socket);
    bool hire();  ///< one more thread, if there may be one; the lock is held
    void turn_away(int socket);
    void serve_connections();
    std::string new_id();
    bool crowded() const { return crowded_.load(std::memory_order_relaxed); }

    TransportOptions options_;
    Handlers handlers_;
    std::unique_ptr<Listener> listener_;
    std::atomic<bool> draining_{false};
    std::atomic<bool> crowded_{false};
    std::atomic<std::size_t> body_memory_{0};
    std::atomic<std::uint64_t> refused_{0};
    std::uint64_t id_prefix_ = 0;
    std::atomic<std::uint64_t> last_id_{0};
    int wake_ = -1;  ///< an eventfd, readable from drain() on

    mutable std::mutex mutex_;
    std::condition_variable arrived_;
    std::deque<int> waiting_;
    std::size_t idle_ = 0, busy_ = 0;
    bool closed_ = false;
    std::vector<std::jthread> threads_;
    std::jthread acceptor_;
};

}  // namespace sporeprint::server
