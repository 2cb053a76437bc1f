#include "server/http/reactor.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace sporeprint::server {

namespace {

using std::chrono::milliseconds;

constexpr std::size_t most_turned_away = 256;  ///< connections beyond a limit that get a response
constexpr int most_accepted_per_turn = 64;
/// Request bodies are read at most at this rate together, bytes per second, so that a flood of
/// uploads leaves the thread time for other requests; and at most so many at once after a pause.
constexpr double upload_rate = 128e6, upload_burst = 512e3;
constexpr milliseconds pause{10};  ///< of accepting if the system is out of memory or buffers

int open_spare_descriptor() { return ::open("/dev/null", O_RDONLY | O_CLOEXEC); }

}  // namespace

Reactor::Reactor(const TransportOptions& options, const Handlers& handlers, HttpHeadCodec& codec)
    : options_(options),
      codec_(codec),
      shared_{handlers, codec, workers_, mailbox_},
      state_(options, shared_),
      workers_(options.workers, options.longest_queue) {
    epoll_ = epoll_create1(EPOLL_CLOEXEC);
    epoll_event mail{};
    mail.events = EPOLLIN;
    mail.data.ptr = &mailbox_;
    if (epoll_ < 0 || epoll_ctl(epoll_, EPOLL_CTL_ADD, mailbox_.descriptor(), &mail) != 0) {
        const int code = errno;
        if (epoll_ >= 0) ::close(epoll_);
        throw std::runtime_error(std::string("Cannot make an epoll: ") + std::strerror(code));
    }
    spare_descriptor_ = open_spare_descriptor();
    for (const auto& [target, response] : handlers.pinned_responses) {
        const Sending sending = codec.send(
            "GET " + target + " HTTP/1.1", [&one = response] { return one; },
            [](int) { return api::Response(); }, [] { return false; });
        api::Request request;
        request.method = "GET";
        request.target = target;
        if (auto hot = hot_response(target, sending, label_of(shared_.route(request))))
            state_.hot.insert_pinned(std::move(hot));
    }
}

Reactor::~Reactor() {
    if (spare_descriptor_ >= 0) ::close(spare_descriptor_);
    ::close(epoll_);
}

void Reactor::drain() {
    shared_.draining = true;
    mailbox_.wake();
}

void Reactor::invalidate() {
    ++shared_.epoch;
    mailbox_.wake();
}

Transport::Load Reactor::load() const {
    Transport::Load load;
    for (std::size_t i = 0; i < load.connections.size(); ++i)
        load.connections[i] = state_.phases[i].load(std::memory_order_relaxed);
    load.queue = workers_.waiting();
    load.queue_limit = options_.longest_queue;
    load.refused = refused_;
    load.limited = limited_;
    load.pinned = pinned_;
    load.aborted_responses = aborted_responses_;
    load.body_bytes = body_bytes_;
    load.aborted_uploads = aborted_uploads_;
    const HotTable::Stats& hot = state_.hot.stats();
    load.hot_hits = hot.hits;
    load.hot_not_modified = hot.not_modified;
    load.hot_evictions = hot.evictions;
    load.hot_bytes = hot.bytes;
    load.hot_entries = hot.entries;
    return load;
}

template <class Call>
void Reactor::invoke(Connection& connection, Call&& call) {
    if (connection.ended) return;
    bool is_alive = false;
    try {
        is_alive = call(connection);
    } catch (...) {  // out of memory: only this connection is closed
        is_alive = connection.phase() == Connection::Phase::busy;
    }
    if (is_alive) return;
    connection.ended = true;
    ended_.push_back(&connection);
}

void Reactor::run() {
    std::array<epoll_event, 256> events;
    std::vector<Connection*> unfinished_transfers;
    const std::function<void(Timed&)> on_expired = [this](Timed& timed) {
        invoke(static_cast<Connection&>(timed),
               [](Connection& one) { return one.handle_deadline(); });
    };
    sigset_t broken_pipe;
    sigemptyset(&broken_pipe);
    sigaddset(&broken_pipe, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &broken_pipe, nullptr);  // sendfile has no MSG_NOSIGNAL
    watch_listener(true);
    while (!draining_ || shutdown_grace_end_ != Clock::time_point::max() || !connections_.empty()) {
        const int count = epoll_wait(epoll_, events.data(), static_cast<int>(events.size()),
                                     milliseconds_to_wait());
        state_.now = Clock::now();
        bool called = false;
        for (int i = 0; i < count; ++i) {
            const epoll_event& event = events[static_cast<std::size_t>(i)];
            if (event.data.ptr == &mailbox_)
                called = true;
            else if (event.data.ptr == &codec_)
                accept_all();
            else
                invoke(*static_cast<Connection*>(event.data.ptr),
                       [&](Connection& one) { return one.handle_events(event.events); });
        }
        if (called) {
            state_.clear_if_stale();
            for (Reply& reply : mailbox_.take()) {
                Connection& to = *reply.to;
                invoke(to, [&](Connection& one) { return one.handle_reply(std::move(reply)); });
            }
            if (shared_.draining && !draining_) begin_to_drain();
        }
        state_.deadlines.expire(state_.now, on_expired);
        continue_transfers(unfinished_transfers);
        if (state_.now >= accepting_again_) watch_listener(true);
        if (state_.now >= shutdown_grace_end_) stop_listening();
        limit_response_memory();
        limit_body_memory();
        reap();
        body_bytes_.store(state_.bodies.bytes(), std::memory_order_relaxed);
    }
}

/// Continues unfinished transfers in turn: each response once, then uploads while the common rate
/// permits. The remaining ones come first in the next iteration, after the requests that have
/// arrived meanwhile.
void Reactor::continue_transfers(std::vector<Connection*>& turns) {
    turns.clear();
    turns.swap(state_.unfinished_transfers);
    const auto continue_transfer = [this](Connection& one) {
        invoke(one, [](Connection& connection) { return connection.continue_transfer(); });
    };
    const auto uploads = std::stable_partition(
        turns.begin(), turns.end(), [](const Connection* one) { return !one->is_receiving(); });
    std::for_each(turns.begin(), uploads, [&](Connection* one) { continue_transfer(*one); });
    const std::chrono::duration<double> elapsed =
        state_.now - std::exchange(upload_credit_since_, state_.now);
    upload_credit_ = std::min(upload_credit_ + elapsed.count() * upload_rate, upload_burst);
    auto next = uploads;
    while (next != turns.end() && upload_credit_ > 0.0) {
        const std::uint64_t before = state_.upload_bytes;
        continue_transfer(**next++);
        upload_credit_ -= static_cast<double>(state_.upload_bytes - before);
    }
    only_uploads_wait_ = next != turns.end() && state_.unfinished_transfers.empty();
    state_.unfinished_transfers.insert(state_.unfinished_transfers.begin(), next, turns.end());
}

int Reactor::milliseconds_to_wait() const {
    if (!state_.unfinished_transfers.empty()) return only_uploads_wait_ ? 1 : 0;
    const Clock::time_point until =
        std::min({state_.deadlines.next(), shutdown_grace_end_, accepting_again_});
    if (until == Clock::time_point::max()) return -1;
    const auto remaining = std::chrono::ceil<milliseconds>(until - Clock::now()).count();
    return static_cast<int>(std::clamp<std::int64_t>(remaining, 0, 3'600'000));
}

// --- Accepting ----------------------------------------------------------------------------------

void Reactor::watch_listener(bool watch) {
    accepting_again_ = watch ? Clock::time_point::max() : state_.now + pause;
    if (codec_.socket() < 0) return;
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.ptr = &codec_;
    epoll_ctl(epoll_, watch ? EPOLL_CTL_ADD : EPOLL_CTL_DEL, codec_.socket(), &event);
}

void Reactor::accept_all() {
    for (int i = 0; i < most_accepted_per_turn && codec_.socket() >= 0; ++i) {
        sockaddr_storage address{};
        socklen_t size = sizeof address;
        const int socket = ::accept4(codec_.socket(), reinterpret_cast<sockaddr*>(&address), &size,
                                     SOCK_CLOEXEC | SOCK_NONBLOCK);
        if (socket >= 0) {
            add_connection(socket, address_of(address));
        } else if (errno == EMFILE || errno == ENFILE) {
            handle_descriptor_exhaustion();
        } else if (errno != EINTR && errno != ECONNABORTED) {
            if (errno != EAGAIN) watch_listener(false);
            return;
        }
    }
}

bool Reactor::has_too_many(const Address& peer) const {
    const auto found = connections_per_client_.find(client_of(peer));
    return found != connections_per_client_.end() && found->second >= options_.most_of_client;
}

void Reactor::add_connection(int socket, const Address& peer) {
    const bool is_counted = options_.most_of_client > 0 && !options_.proxies.trusted.contains(peer);
    const bool limited = is_counted && has_too_many(peer);
    const std::size_t open = connections_.size() - ended_.size();
    const bool full = !limited && open >= options_.most_connections && !evict_idle();
    if (limited) ++limited_;
    if (full) ++refused_;
    if ((full && open >= options_.most_connections + most_turned_away) ||
        (limited && limited_now_ >= most_turned_away)) {
        ::close(socket);
        return;
    }
    auto accepted = std::make_unique<Connection>(state_, socket, peer);
    Connection& connection = *accepted;
    connection.index = connections_.size();
    connections_.push_back(std::move(accepted));
    if (limited) {
        connection.mark_limited();
        ++limited_now_;
    } else if (is_counted) {
        connection.is_counted = true;
        ++connections_per_client_[client_of(peer)];
    }
    epoll_event event{};
    event.events = EPOLLIN | EPOLLOUT | EPOLLRDHUP | EPOLLET;
    event.data.ptr = &connection;
    invoke(connection, [&](Connection& one) {
        if (epoll_ctl(epoll_, EPOLL_CTL_ADD, socket, &event) != 0) return false;
        return !full || one.refuse_connection();
    });
}

/// Closes the connection that has been idle longest.
///
/// returns  false if no connection may be closed
bool Reactor::evict_idle() {
    Connection* longest = nullptr;
    for (const auto& one : connections_)
        if (!one->ended && one->is_evictable() &&
            (!longest || one->deadline() < longest->deadline()))
            longest = one.get();
    if (!longest) return false;
    invoke(*longest, [](Connection&) { return false; });
    return true;
}

/// Aborts the responses to the slowest clients while the memory of responses in flight exceeds its
/// limit. A single response is never aborted.
void Reactor::limit_response_memory() {
    while (state_.in_flight_buffers.bytes() > options_.most_pinned) {
        Connection* slowest = nullptr;
        double least = 0.0;
        std::size_t count = 0;
        for (const auto& one : connections_) {
            const std::optional<double> rate = one->ended ? std::nullopt : one->rate();
            if (!rate) continue;
            ++count;
            if (slowest && *rate >= least) continue;
            slowest = one.get();
            least = *rate;
        }
        if (count < 2) break;
        ++aborted_responses_;
        invoke(*slowest, [](Connection& one) { return one.abort_response(); });
    }
    pinned_.store(state_.in_flight_buffers.bytes(), std::memory_order_relaxed);
}

/// Aborts uploads until the memory of request bodies is within its limits.
void Reactor::limit_body_memory() {
    BodyMemory& bodies = state_.bodies;
    std::vector<Address> over_limit;
    over_limit.swap(state_.over_limit);
    for (const Address& client : over_limit)
        while (bodies.is_exceeded_by(client) && abort_one_upload(&client, share_exceeded)) continue;
    while (bodies.is_exceeded() &&
           abort_one_upload(nullptr, "the memory for bodies is full; try again in a moment"))
        continue;
}

/// Aborts one upload: among the clients that hold at least the mean of all clients, and among their
/// uploads of at least mean size, the slowest. So neither a small nor a fast upload is aborted in
/// favour of a large slow one.
///
/// of_client  considers uploads of this client only, as far as its limit applies; nullptr: all
/// returns    false if there was none
bool Reactor::abort_one_upload(const Address* of_client, std::string_view detail) {
    struct Candidate {
        Connection* connection;
        Connection::Upload upload;
    };
    std::vector<Candidate> candidates;
    for (const auto& one : connections_) {
        const std::optional<Connection::Upload> upload = one->ended ? std::nullopt : one->upload();
        if (!upload || (of_client && (upload->client != *of_client || !upload->has_share)))
            continue;
        candidates.push_back({one.get(), *upload});
    }
    if (candidates.empty()) return false;
    const auto restrict_to = [&](const auto& condition) {
        if (std::any_of(candidates.begin(), candidates.end(), condition))
            std::erase_if(candidates, [&](const Candidate& one) { return !condition(one); });
    };
    restrict_to(
        [&](const Candidate& one) { return state_.bodies.takes_at_least_mean(one.upload.client); });
    std::size_t sum = 0;
    for (const Candidate& one : candidates) sum += one.upload.bytes;
    restrict_to([count = candidates.size(), sum](const Candidate& one) {
        return one.upload.bytes * count >= sum;
    });
    const auto slowest = std::min_element(
        candidates.begin(), candidates.end(),
        [](const Candidate& a, const Candidate& b) { return a.upload.rate < b.upload.rate; });
    ++aborted_uploads_;
    invoke(*slowest->connection, [&](Connection& one) { return one.abort_upload(detail); });
    return true;
}

void Reactor::handle_descriptor_exhaustion() {
    if (spare_descriptor_ >= 0) ::close(spare_descriptor_);
    const int surplus = ::accept4(codec_.socket(), nullptr, nullptr, SOCK_CLOEXEC);
    if (surplus >= 0) ::close(surplus);
    ++refused_;
    spare_descriptor_ = open_spare_descriptor();
    if (spare_descriptor_ < 0) watch_listener(false);
}

// --- Ending -------------------------------------------------------------------------------------

void Reactor::begin_to_drain() {
    draining_ = true;
    shutdown_grace_end_ = state_.now + options_.shutdown_grace;
    for (const auto& one : connections_)
        invoke(*one, [](Connection& connection) { return connection.drain(); });
}

void Reactor::stop_listening() {
    accept_all();
    shutdown_grace_end_ = Clock::time_point::max();
    codec_.close();
}

void Reactor::reap() {
    for (Connection* one : ended_) {
        if (one->is_queued()) std::erase(state_.unfinished_transfers, one);
        if (one->is_limited()) --limited_now_;
        if (one->is_counted) {
            const auto of_client = connections_per_client_.find(client_of(one->peer()));
            if (--of_client->second == 0) connections_per_client_.erase(of_client);
        }
        const std::size_t index = one->index;
        std::swap(connections_[index], connections_.back());
        connections_[index]->index = index;
        connections_.pop_back();
    }
    ended_.clear();
}

}  // namespace sporeprint::server
