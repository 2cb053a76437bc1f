// The reactor: one thread with an epoll event loop that owns all sockets.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string_view>
#include <vector>

#include "server/http/connection.h"
#include "server/http/head_codec.h"
#include "server/http/transport.h"
#include "server/http/worker_request.h"
#include "server/http/workers.h"

namespace sporeprint::server {

/// Accepts connections, dispatches their events and enforces the limits they share.
class Reactor {
  public:
    /// codec   has a listening socket
    /// pre     options, handlers and codec outlive this object
    /// throws  std::runtime_error if the system has no descriptor left
    Reactor(const TransportOptions& options, const Handlers& handlers, HttpHeadCodec& codec);
    ~Reactor();
    Reactor(const Reactor&) = delete;
    Reactor& operator=(const Reactor&) = delete;

    /// Serves until drain() has been called and the last connection is closed.
    void run();

    /// Starts the graceful shutdown of Transport::drain() and returns at once. Thread-safe.
    void drain();

    /// Invalidates the hot-response table; see Transport::invalidate(). Thread-safe.
    void invalidate();

    /// Returns the present numbers of connections, requests and bytes, and the counts of refused
    /// and aborted ones since the start. Thread-safe.
    [[nodiscard]] Transport::Load load() const;

  private:
    void continue_transfers(std::vector<Connection*>& turns);
    [[nodiscard]] int milliseconds_to_wait() const;
    void accept_all();
    void add_connection(int socket, const Address& peer);
    [[nodiscard]] bool has_too_many(const Address& peer) const;
    bool evict_idle();
    void limit_response_memory();
    void limit_body_memory();
    bool abort_one_upload(const Address* of_client, std::string_view detail);
    void handle_descriptor_exhaustion();
    void begin_to_drain();
    void stop_listening();
    void watch_listener(bool watch);
    void reap();

    /// Calls a function of a connection, which is destroyed after this iteration if it returns
    /// false.
    template <class Call>
    void invoke(Connection& connection, Call&& call);

    const TransportOptions& options_;
    HttpHeadCodec& codec_;
    Mailbox mailbox_;
    SharedState shared_;
    ReactorState state_;
    Workers workers_;  ///< destroyed before the members it uses
    int epoll_ = -1;
    int spare_descriptor_ =
        -1;  ///< reserve, closed to accept and refuse a connection if descriptors run out
    double upload_credit_ = 0.0;  ///< bytes that may be read now; see continue_transfers()
    Clock::time_point upload_credit_since_ = Clock::now();
    bool only_uploads_wait_ = false;  ///< the unfinished transfers are uploads without credit
    bool draining_ = false;
    Clock::time_point shutdown_grace_end_ = Clock::time_point::max();
    Clock::time_point accepting_again_ = Clock::time_point::max();  ///< end of a pause of accepting
    std::vector<std::unique_ptr<Connection>> connections_;
    std::vector<Connection*> ended_;
    std::map<Address, std::size_t> connections_per_client_;  ///< used if they are limited
    std::size_t limited_now_ = 0;
    std::atomic<std::uint64_t> refused_{0}, limited_{0}, aborted_responses_{0}, aborted_uploads_{0};
    std::atomic<std::size_t> pinned_{0}, body_bytes_{0};
};

}  // namespace sporeprint::server
