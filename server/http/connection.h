// One connection: from the bytes that have come to requests, from answers to the bytes that go out.
// It never waits; the reactor tells it what has happened, on one thread.
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

/// What all connections of a reactor have in common. Used on its thread; `phases` may be read on
/// any.
struct ReactorState {
    ReactorState(const TransportOptions& the_options, SharedState& the_shared);

    [[nodiscard]] std::string new_id();

    /// Forgets what is not to be given again any more.
    void keep_up();

    const TransportOptions& options;
    SharedState& shared;
    Clock::time_point now;  ///< of this round of the loop
    Deadlines deadlines;
    HotTable hot;
    std::uint64_t epoch = 0;  ///< of what the table holds
    BodyMemory bodies;
    std::vector<Address> exceeding;  ///< clients whose bodies wait for room
    InFlightBuffers in_flight_buffers;
    std::vector<Connection*> again;  ///< have more to do, when the others have had their turn
    std::array<std::atomic<std::size_t>, Transport::phases.size()> phases{};
    std::array<char, 64 * 1024> received;  ///< by the call at hand
    Served served;                         ///< kept for its memory

  private:
    std::uint64_t id_prefix_;
    std::uint64_t last_id_ = 0;
};

/// Each call that returns bool says whether the connection goes on; if not, destroy it.
class Connection final : public Timed {
  public:
    using Phase = Transport::Phase;

    /// socket  does not block; closed by the destructor
    Connection(ReactorState& reactor_state, int socket, const Address& peer);
    ~Connection() override;

    [[nodiscard]] bool happened(std::uint32_t events);  ///< of epoll, edge-triggered
    [[nodiscard]] bool go_on();                         ///< it was on the list of those to go on
    [[nodiscard]] bool is_late();                       ///< its deadline has come
    [[nodiscard]] bool responded(Reply reply);
    [[nodiscard]] bool drain();      ///< the server ends
    [[nodiscard]] bool turn_away();  ///< there are too many: says so, and ends soon

    /// Its client has too many: of one request it gets the answer, if that is a standing one, else
    /// 429, and all ends soon.
    void limit();

    /// Bytes a second that its client has taken of an answer which waits for it; nothing when none does.
    [[nodiscard]] std::optional<double> pace() const;

    /// Waits for its client no longer.
    [[nodiscard]] bool give_up();

    /// A body that is being received.
    struct Upload {
        Address client;          ///< as bodies are counted
        std::size_t bytes = 0;   ///< that have arrived
        double pace = 0.0;       ///< of them in a second, in the mean
        bool has_share = false;  ///< whether its client may only take its share
    };

    /// Returns true while it receives the body of a request, or drops that of a refused one.
    [[nodiscard]] bool is_receiving() const {
        return phase_ == Phase::body || phase_ == Phase::lingering;
    }

    /// What it is receiving; nothing when nothing of a body has arrived, unless it waits for room.
    [[nodiscard]] std::optional<Upload> upload() const;

    /// Refuses the body that it is receiving (503) and gives its memory back.
    [[nodiscard]] bool give_up_upload(std::string_view detail);

    /// Whether it may be closed to make room: it waits for a request, and has for a while.
    [[nodiscard]] bool may_make_room() const;

    /// While it is busy it must not be destroyed: its answer comes yet.
    [[nodiscard]] Phase phase() const { return phase_; }
    [[nodiscard]] bool is_on_the_list() const { return on_the_list_; }

    std::size_t place = 0;  ///< where the reactor keeps it
    bool ended = false;     ///< to be destroyed at the end of this round
    bool counts = false;    ///< among those of its client

    [[nodiscard]] const Address& peer() const { return peer_; }
    [[nodiscard]] bool is_limited() const { return limited_; }

  private:
    enum class Step { on, wait, end };

    bool advance();
    Step read_head();
    Step begin(Scan scan);
    bool respond_at_once(const Head& head);
    Step read_body();
    [[nodiscard]] bool has_room_for_body() const;
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
    void put_off_until(Clock::time_point deadline) { state_.deadlines.set(*this, deadline); }
    void await_request();
    void report(bool complete);
    void unpin();
    void client_has_left();

    ReactorState& state_;
    int socket_;
    Address peer_, client_;  ///< the other end, and for whom it asks
    std::string peer_text_;
    bool by_proxy_, limited_ = false;
    Phase phase_ = Phase::idle;
    bool readable_ = false, writable_ = true;
    bool left_ = false;  ///< the client has closed its writing end, or all
    bool on_the_list_ = false;
    bool closing_ = false;  ///< after this answer
    bool unread_ = false;   ///< what still comes is of a refused request
    std::size_t served_ = 0;
    std::string in_;
    std::size_t scanned_ = 0;  ///< bytes of in_ that have been looked at
    std::size_t taken_ = 0;    ///< bytes received in this turn
    Clock::time_point began_;  ///< the phase, as far as deadlines count from there

    // The request at hand.
    std::string method_, target_, id_, label_, trace_id_, parent_id_;
    api::Request request_;
    std::size_t body_length_ = 0;
    std::size_t body_bytes_ = 0;    ///< of it, as counted in hall_.bodies
    Address body_client_;           ///< for this client
    bool body_has_share_ = false;   ///< whether that client may only take its share
    bool waits_for_room_ = false;   ///< there was none for more of the body
    Clock::time_point body_since_;  ///< when the body began to be awaited
    Clock::time_point last_;        ///< when the answer must be through
    Clock::time_point ready_;       ///< when its last byte had come
    Clock::time_point sending_since_;
    bool is_counted_in_flight_ = false;  ///< whether what is held by its answer counts
    std::weak_ptr<WorkerRequest> worker_request_;
    Outgoing out_;
    std::string text_;  ///< what the head of an answer says of this request alone
    int status_ = 0;
    std::string cache_;
    std::size_t discarded_ = 0;
};

}  // namespace sporeprint::server
