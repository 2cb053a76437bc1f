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

constexpr std::size_t turned_away_at_once = 256;  ///< connections beyond a limit that are told so
constexpr int accepted_in_a_turn = 64;
constexpr milliseconds upload_share{1};  ///< of a round
constexpr milliseconds pause{10};  ///< of accepting, when the system is out of memory or buffers

int spare_descriptor() { return ::open("/dev/null", O_RDONLY | O_CLOEXEC); }

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
        const int why = errno;
        if (epoll_ >= 0) ::close(epoll_);
        throw std::runtime_error(std::string("Cannot make an epoll: ") + std::strerror(why));
    }
    spare_ = spare_descriptor();
    for (const auto& [target, response] : handlers.pinned_responses) {
        const Sending sending = codec.send(
            "GET " + target + " HTTP/1.1", [&one = response] { return one; },
            [](int) { return api::Response(); }, [] { return false; });
        if (auto hot = hot_response(target, sending, shared_.label("GET", target)))
            state_.hot.pin(std::move(hot));
    }
}

Reactor::~Reactor() {
    if (spare_ >= 0) ::close(spare_);
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
    load.given_up = given_up_;
    load.body_bytes = body_bytes_;
    load.uploads_given_up = uploads_given_up_;
    const HotTable::Stats& hot = state_.hot.stats();
    load.hot_hits = hot.hits;
    load.hot_not_modified = hot.not_modified;
    load.hot_evictions = hot.evictions;
    load.hot_bytes = hot.bytes;
    load.hot_entries = hot.entries;
    return load;
}

template <class Call>
void Reactor::let(Connection& connection, Call&& call) {
    if (connection.ended) return;
    bool goes_on = false;
    try {
        goes_on = call(connection);
    } catch (...) {  // out of memory: this connection ends, the server does not
        goes_on = connection.phase() == Connection::Phase::busy;
    }
    if (goes_on) return;
    connection.ended = true;
    ended_.push_back(&connection);
}

void Reactor::run() {
    std::array<epoll_event, 256> events;
    std::vector<Connection*> again;
    const std::function<void(Timed&)> late = [this](Timed& timed) {
        let(static_cast<Connection&>(timed), [](Connection& one) { return one.is_late(); });
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
                let(*static_cast<Connection*>(event.data.ptr),
                    [&](Connection& one) { return one.happened(event.events); });
        }
        if (called) {
            state_.keep_up();
            for (Reply& reply : mailbox_.take()) {
                Connection& to = *reply.to;
                let(to, [&](Connection& one) { return one.responded(std::move(reply)); });
            }
            if (shared_.draining && !draining_) begin_to_drain();
        }
        state_.deadlines.expire(state_.now, late);
        continue_transfers(again);
        if (state_.now >= accepting_again_) watch_listener(true);
        if (state_.now >= shutdown_grace_end_) stop_listening();
        spare_memory();
        spare_body_memory();
        reap();
        body_bytes_.store(state_.bodies.bytes(), std::memory_order_relaxed);
    }
}

/// Lets connections with more to do take turns: each response once, then uploads until their share
/// of the round is used up. The others come first in the next round, after the requests that have
/// arrived meanwhile.
void Reactor::continue_transfers(std::vector<Connection*>& turns) {
    turns.clear();
    turns.swap(state_.again);
    const auto go_on = [this](Connection& one) {
        let(one, [](Connection& connection) { return connection.go_on(); });
    };
    const auto uploads = std::stable_partition(
        turns.begin(), turns.end(), [](const Connection* one) { return !one->is_receiving(); });
    std::for_each(turns.begin(), uploads, [&](Connection* one) { go_on(*one); });
    const Clock::time_point end = Clock::now() + upload_share;
    auto next = uploads;
    while (next != turns.end()) {
        go_on(**next++);
        if (Clock::now() >= end) break;
    }
    state_.again.insert(state_.again.begin(), next, turns.end());
}

int Reactor::milliseconds_to_wait() const {
    if (!state_.again.empty()) return 0;
    const Clock::time_point until =
        std::min({state_.deadlines.next(), shutdown_grace_end_, accepting_again_});
    if (until == Clock::time_point::max()) return -1;
    const auto left = std::chrono::ceil<milliseconds>(until - Clock::now()).count();
    return static_cast<int>(std::clamp<std::int64_t>(left, 0, 3'600'000));
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
    for (int i = 0; i < accepted_in_a_turn && codec_.socket() >= 0; ++i) {
        sockaddr_storage address{};
        socklen_t size = sizeof address;
        const int socket = ::accept4(codec_.socket(), reinterpret_cast<sockaddr*>(&address), &size,
                                     SOCK_CLOEXEC | SOCK_NONBLOCK);
        if (socket >= 0) {
            welcome(socket, address_of(address));
        } else if (errno == EMFILE || errno == ENFILE) {
            survive_exhaustion();
        } else if (errno != EINTR && errno != ECONNABORTED) {
            if (errno != EAGAIN) watch_listener(false);
            return;
        }
    }
}

bool Reactor::has_too_many(const Address& peer) const {
    const auto found = of_client_.find(client_of(peer));
    return found != of_client_.end() && found->second >= options_.most_of_client;
}

void Reactor::welcome(int socket, const Address& peer) {
    const bool counts = options_.most_of_client > 0 && !options_.proxies.trusted.contains(peer);
    const bool limited = counts && has_too_many(peer);
    const std::size_t open = connections_.size() - ended_.size();
    const bool full = !limited && open >= options_.most_connections && !make_room();
    if (limited) ++limited_;
    if (full) ++refused_;
    if ((full && open >= options_.most_connections + turned_away_at_once) ||
        (limited && limited_now_ >= turned_away_at_once)) {
        ::close(socket);
        return;
    }
    auto generated = std::make_unique<Connection>(state_, socket, peer);
    Connection& connection = *generated;
    connection.place = connections_.size();
    connections_.push_back(std::move(generated));
    if (limited) {
        connection.limit();
        ++limited_now_;
    } else if (counts) {
        connection.counts = true;
        ++of_client_[client_of(peer)];
    }
    epoll_event event{};
    event.events = EPOLLIN | EPOLLOUT | EPOLLRDHUP | EPOLLET;
    event.data.ptr = &connection;
    let(connection, [&](Connection& one) {
        if (epoll_ctl(epoll_, EPOLL_CTL_ADD, socket, &event) != 0) return false;
        return !full || one.turn_away();
    });
}

/// Ends the connection that has waited longest for a request.
bool Reactor::make_room() {
    Connection* longest = nullptr;
    for (const auto& one : connections_)
        if (!one->ended && one->may_make_room() &&
            (!longest || one->deadline() < longest->deadline()))
            longest = one.get();
    if (!longest) return false;
    let(*longest, [](Connection&) { return false; });
    return true;
}

/// Gives up the slowest clients while more is pinned than may be; one alone has all the room.
void Reactor::spare_memory() {
    while (state_.in_flight_buffers.bytes() > options_.most_pinned) {
        Connection* slowest = nullptr;
        double least = 0.0;
        std::size_t slow = 0;
        for (const auto& one : connections_) {
            const std::optional<double> pace = one->ended ? std::nullopt : one->pace();
            if (!pace) continue;
            ++slow;
            if (slowest && *pace >= least) continue;
            slowest = one.get();
            least = *pace;
        }
        if (slow < 2) break;
        ++given_up_;
        let(*slowest, [](Connection& one) { return one.give_up(); });
    }
    pinned_.store(state_.in_flight_buffers.bytes(), std::memory_order_relaxed);
}

/// Gives uploads up until those that wait for room have it, or are given up themselves.
void Reactor::spare_body_memory() {
    BodyMemory& bodies = state_.bodies;
    std::vector<Address> exceeding;
    exceeding.swap(state_.exceeding);
    for (const Address& client : exceeding)
        while (bodies.is_exceeded_by(client) &&
               give_up_an_upload(&client,
                                 "this client sends more at once than its share of the "
                                 "memory for bodies; send one after another"))
            continue;
    while (bodies.is_exceeded() &&
           give_up_an_upload(nullptr, "the memory for bodies is full; try again in a moment"))
        continue;
}

/// Refuses one upload midway: of the clients that take at least as much as their mean, among the
/// uploads that are at least as large as the mean of theirs, the slowest. So neither a small upload
/// nor a quick one ends for the sake of a large slow one.
///
/// of_client  only its uploads come into question, as far as its share binds them; nullptr for all
/// returns    whether there was one
bool Reactor::give_up_an_upload(const Address* of_client, std::string_view why) {
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
    const auto keep = [&](const auto& much) {
        if (std::any_of(candidates.begin(), candidates.end(), much))
            std::erase_if(candidates, [&](const Candidate& one) { return !much(one); });
    };
    keep([&](const Candidate& one) { return state_.bodies.takes_at_least_mean(one.upload.client); });
    std::size_t sum = 0;
    for (const Candidate& one : candidates) sum += one.upload.bytes;
    keep([count = candidates.size(), sum](const Candidate& one) {
        return one.upload.bytes * count >= sum;
    });
    const auto slowest = std::min_element(
        candidates.begin(), candidates.end(),
        [](const Candidate& a, const Candidate& b) { return a.upload.pace < b.upload.pace; });
    ++uploads_given_up_;
    let(*slowest->connection, [&](Connection& one) { return one.give_up_upload(why); });
    return true;
}

void Reactor::survive_exhaustion() {
    if (spare_ >= 0) ::close(spare_);
    const int surplus = ::accept4(codec_.socket(), nullptr, nullptr, SOCK_CLOEXEC);
    if (surplus >= 0) ::close(surplus);
    ++refused_;
    spare_ = spare_descriptor();
    if (spare_ < 0) watch_listener(false);
}

// --- Ending -------------------------------------------------------------------------------------

void Reactor::begin_to_drain() {
    draining_ = true;
    shutdown_grace_end_ = state_.now + options_.shutdown_grace;
    for (const auto& one : connections_)
        let(*one, [](Connection& connection) { return connection.drain(); });
}

void Reactor::stop_listening() {
    accept_all();
    shutdown_grace_end_ = Clock::time_point::max();
    codec_.close();
}

void Reactor::reap() {
    for (Connection* one : ended_) {
        if (one->is_on_the_list()) std::erase(state_.again, one);
        if (one->is_limited()) --limited_now_;
        if (one->counts) {
            const auto of_client = of_client_.find(client_of(one->peer()));
            if (--of_client->second == 0) of_client_.erase(of_client);
        }
        const std::size_t place = one->place;
        std::swap(connections_[place], connections_.back());
        connections_[place]->place = place;
        connections_.pop_back();
    }
    ended_.clear();
}

}  // namespace sporeprint::server
