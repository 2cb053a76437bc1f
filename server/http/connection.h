// One connection: parses the bytes received into requests and writes responses. It never blocks;
// the reactor calls it on each event, always on the reactor thread.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/http/body_memory.h"
#include "server/http/deadlines.h"
#include "server/http/head.h"
#include "server/http/hot_table.h"
#include "server/http/in_flight_buffers.h"
#include "server/http/outgoing.h"
#include "server/http/transport.h"
#include "server/http/worker_request.h"

namespace sporeprint::server {

/// The state shared by all connections of a reactor. Used on the reactor thread; other threads may
/// read `phases`.
struct ReactorState {
    ReactorState(const TransportOptions& the_options, SharedState& the_shared);

    /// Returns a new request id.
    [[nodiscard]] std::string new_id();

    /// Clears the hot-response table if it has been invalidated.
    void clear_if_stale();

    const TransportOptions& options;
    SharedState& shared;
    Clock::time_point now;  ///< of this iteration of the event loop
    Deadlines deadlines;
    HotTable hot;
    std::uint64_t epoch = 0;  ///< of the entries of `hot`
    BodyMemory bodies;
    std::vector<Address> over_limit;  ///< clients whose uploads wait for memory
    InFlightBuffers in_flight_buffers;
    std::uint64_t upload_bytes = 0;  ///< of bodies so far, those of refused requests included
    std::vector<Connection*> unfinished_transfers;  ///< to be continued in the next iteration
    std::array<std::atomic<std::size_t>, Transport::phases.size()> phases{};
    std::array<char, 64 * 1024> receive_buffer;  ///< of the current recv()
    Served served;                               ///< reused to avoid allocations

  private:
    std::uint64_t id_prefix_;
    std::uint64_t last_id_ = 0;
};

/// The state machine of one connection. The functions of the first group return false if the
/// connection has to be destroyed.
class Connection final : public Timed {
  public:
    using Phase = Transport::Phase;

    /// socket  non-blocking; closed by the destructor
    Connection(ReactorState& reactor_state, int socket, const Address& peer);
    ~Connection() override;

    /// events  of epoll, edge-triggered
    [[nodiscard]] bool handle_events(std::uint32_t events);
    [[nodiscard]] bool continue_transfer();  ///< its next turn
    [[nodiscard]] bool handle_deadline();    ///< its deadline has passed
    [[nodiscard]] bool handle_reply(Reply reply);
    [[nodiscard]] bool drain();              ///< the server shuts down
    [[nodiscard]] bool refuse_connection();  ///< responds with 503: too many connections

    /// Marks a connection beyond the limit of its client: it serves one request, by a pinned
    /// response or else by 429, and is closed soon.
    void mark_limited();

    /// Returns the mean rate at which its client takes a response in flight, bytes per second;
    /// nothing if there is none.
    [[nodiscard]] std::optional<double> rate() const;

    /// Aborts the response in flight.
    [[nodiscard]] bool abort_response();

    /// A body that is being received.
    struct Upload {
        Address client;          ///< whose memory it counts for
        std::size_t bytes = 0;   ///< received so far
        double rate = 0.0;       ///< mean, bytes per second
        bool has_share = false;  ///< the limit per client applies
    };

    /// Returns true while it receives the body of a request, or drops that of a refused one.
    [[nodiscard]] bool is_receiving() const {
        return phase_ == Phase::body || phase_ == Phase::lingering;
    }

    /// Returns the body being received; nothing if no byte of it has arrived, unless it waits for
    /// memory.
    [[nodiscard]] std::optional<Upload> upload() const;

    /// Refuses the body being received (503) and releases its memory.
    [[nodiscard]] bool abort_upload(std::string_view detail);

    /// Returns true if it may be closed in favour of a new connection: it has been idle for a
    /// while.
    [[nodiscard]] bool is_evictable() const;

    /// Returns its phase. A busy connection must not be destroyed before its reply has come.
    [[nodiscard]] Phase phase() const { return phase_; }
    [[nodiscard]] bool is_queued() const { return is_queued_; }

    std::size_t index = 0;    ///< in the vector of the reactor
    bool ended = false;       ///< to be destroyed at the end of this iteration
    bool is_counted = false;  ///< for the limit of its client

    [[nodiscard]] const Address& peer() const { return peer_; }
    [[nodiscard]] bool is_limited() const { return limited_; }

  private:
    enum class Step { on, wait, end };

    bool advance();
    Step read_head();
    Step begin(Scan scan);
    bool respond_from_hot_table(const Head& head);
    Step read_body();
    [[nodiscard]] bool has_body_memory() const;
    [[nodiscard]] Clock::time_point body_deadline() const;
    void count_body();
    void release_body();
    Step dispatch();
    Step refuse(int status, std::string_view detail);
    Step refuse(const std::function<api::Response()>& make);
    Step send(const std::shared_ptr<const Sending>& sending);
    void begin_to_send();
    Step write();
    Step linger();
    Step discard();
    Step yield();

    Step receive(std::string* to, std::size_t most);
    void enter(Phase phase);
    void set_deadline(Clock::time_point deadline) { state_.deadlines.set(*this, deadline); }
    void report(bool complete);
    void release_in_flight();
    void cancel_request();

    ReactorState& state_;
    int socket_;
    Address peer_, client_;  ///< the other end; the client, perhaps behind a proxy
    std::string peer_text_;
    bool by_proxy_, limited_ = false;
    Phase phase_ = Phase::idle;
    bool readable_ = false, writable_ = true;
    bool peer_closed_ = false;  ///< the client has closed its sending direction or the connection
    bool is_queued_ = false;
    bool closing_ = false;  ///< after this response
    bool unread_ = false;   ///< further bytes belong to a refused request
    std::size_t served_ = 0;
    std::string in_;
    std::size_t scanned_ = 0;           ///< bytes of in_ already scanned
    std::size_t received_in_turn_ = 0;  ///< bytes
    Clock::time_point phase_start_;     ///< start of the phase, for deadlines

    // The current request.
    std::string method_, target_, id_, label_, trace_id_, parent_id_;
    api::Request request_;
    std::shared_ptr<const api::RoutedRequest> routed_;  ///< null until it is needed
    std::size_t body_length_ = 0;
    std::size_t body_bytes_ = 0;       ///< counted in state_.bodies
    Address body_client_;              ///< client of that count
    bool body_has_share_ = false;      ///< whether that client may only take its share
    bool waits_for_memory_ = false;    ///< for the rest of the body
    Clock::time_point body_start_;     ///< when its head was complete
    Clock::time_point send_deadline_;  ///< when the response must be sent
    Clock::time_point received_at_;    ///< when its last byte was received
    Clock::time_point send_start_;
    bool holds_in_flight_ = false;  ///< its response is counted in in_flight_buffers
    std::weak_ptr<WorkerRequest> worker_request_;
    Outgoing out_;
    std::string text_;  ///< headers of a hot response that differ per request
    int status_ = 0;
    std::string cache_;
    std::size_t discarded_ = 0;
};

}  // namespace sporeprint::server
