// The reactor: one thread that owns every socket and waits for all of them at once.
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

class Reactor {
  public:
    /// library  listens; outlives this, as options and handlers do
    ///
    /// throws  std::runtime_error when the system has no descriptor left
    Reactor(const TransportOptions& options, const Handlers& handlers, HttpHeadCodec& codec);
    ~Reactor();
    Reactor(const Reactor&) = delete;
    Reactor& operator=(const Reactor&) = delete;

    /// Serves until drain() has been called and the last connection has ended.
    void run();

    void drain();   ///< on any thread
    void invalidate();  ///< on any thread; see Transport::invalidate()

    [[nodiscard]] Transport::Load load() const;  ///< on any thread

  private:
    void continue_transfers(std::vector<Connection*>& turns);
    [[nodiscard]] int milliseconds_to_wait() const;
    void accept_all();
    void welcome(int socket, const Address& peer);
    [[nodiscard]] bool has_too_many(const Address& peer) const;
    bool make_room();
    void spare_memory();
    void spare_body_memory();
    bool give_up_an_upload(const Address* of_client, std::string_view why);
    void survive_exhaustion();
    void begin_to_drain();
    void stop_listening();
    void watch_listener(bool watch);
    void reap();

    /// Calls one of a connection's functions; the connection ends when that says so.
    template <class Call>
    void let(Connection& connection, Call&& call);

    const TransportOptions& options_;
    HttpHeadCodec& codec_;
    Mailbox mailbox_;
    SharedState shared_;
    ReactorState state_;
    Workers workers_;  ///< ends before what it uses
    int epoll_ = -1;
    int spare_ = -1;  ///< given up to accept and close what comes when descriptors run out
    bool draining_ = false;
    Clock::time_point shutdown_grace_end_ = Clock::time_point::max();
    Clock::time_point accepting_again_ = Clock::time_point::max();  ///< after a pause
    std::vector<std::unique_ptr<Connection>> connections_;
    std::vector<Connection*> ended_;
    std::map<Address, std::size_t> of_client_;  ///< connections that count, if there is a limit
    std::size_t limited_now_ = 0;
    std::atomic<std::uint64_t> refused_{0}, limited_{0}, given_up_{0}, uploads_given_up_{0};
    std::atomic<std::size_t> pinned_{0}, body_bytes_{0};
};

}  // namespace sporeprint::server
