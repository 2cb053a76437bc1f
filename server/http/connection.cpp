#include "server/http/connection.h"

#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <random>
#include <utility>

#include "api/http/encoding.h"
#include "server/http/trace.h"

namespace sporeprint::server {

namespace {

using std::chrono::milliseconds;

constexpr std::size_t head_chunk = 16u << 10;      ///< bytes per recv() of a head
constexpr std::size_t most_per_turn = 64u << 10;   ///< bytes received before other connections
constexpr std::size_t discard_chunk = 1u << 20;    ///< bytes per recv() that discards
constexpr std::size_t most_discarded = 16u << 20;  ///< bytes of a refused request
constexpr milliseconds discard_time{1000};         ///< limit for the same
constexpr milliseconds first_request_grace{500};   ///< for a new connection
constexpr milliseconds half_close_grace{100};  ///< before a half-closed connection counts as closed
constexpr std::string_view too_many_of_client =
    "too many connections from this address; close some, or try again in a moment";
constexpr std::size_t least_send_rate = 16 * 1024;  ///< bytes per second

bool is_valid_id(std::string_view id) {
    return !id.empty() && id.size() <= 64 && std::all_of(id.begin(), id.end(), [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
               c == '_' || c == '-';
    });
}

/// Returns a 64-bit hash of a counter, so that consecutive ids look unrelated.
std::uint64_t hash_of(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// Adds to a counter that is written by this thread only.
template <class Count>
void add(std::atomic<Count>& counter, Count change) {
    counter.store(counter.load(std::memory_order_relaxed) + change, std::memory_order_relaxed);
}

}  // namespace

ReactorState::ReactorState(const TransportOptions& the_options, SharedState& the_shared)
    : options(the_options),
      shared(the_shared),
      now(Clock::now()),
      deadlines(now),
      hot(the_options.hot_bytes),
      bodies(the_options.most_body_memory, the_options.most_body_of_client) {
    std::random_device entropy;
    id_prefix_ = (static_cast<std::uint64_t>(entropy()) << 32) | entropy();
}

void ReactorState::clear_if_stale() {
    const std::uint64_t current = shared.epoch;
    if (std::exchange(epoch, current) != current) hot.clear();
}

std::string ReactorState::new_id() {
    const std::uint64_t x = hash_of(id_prefix_ + ++last_id_);
    std::string text(16, '0');
    for (std::size_t i = 0; i < 16; ++i) text[15 - i] = "0123456789abcdef"[(x >> (4 * i)) & 15];
    return text;
}

Connection::Connection(ReactorState& reactor_state, int socket, const Address& peer)
    : state_(reactor_state),
      socket_(socket),
      peer_(peer),
      client_(peer),
      peer_text_(text_of(peer)),
      by_proxy_(reactor_state.options.proxies.trusted.contains(peer)),
      phase_start_(reactor_state.now) {
    add(state_.phases[static_cast<std::size_t>(phase_)], std::size_t{1});
    const milliseconds timeout =
        state_.shared.draining ? 2 * state_.options.shutdown_grace : state_.options.idle;
    set_deadline(state_.now + timeout);
}

Connection::~Connection() {
    add(state_.phases[static_cast<std::size_t>(phase_)], std::size_t(-1));
    release_body();
    release_in_flight();
    ::close(socket_);
}

// --- Events from the reactor --------------------------------------------------------------------

bool Connection::handle_events(std::uint32_t events) {
    if ((events & (EPOLLIN | EPOLLRDHUP | EPOLLHUP | EPOLLERR)) != 0) readable_ = true;
    if ((events & (EPOLLOUT | EPOLLHUP | EPOLLERR)) != 0) writable_ = true;
    if ((events & (EPOLLRDHUP | EPOLLHUP | EPOLLERR)) != 0) peer_closed_ = true;
    if (phase_ == Phase::busy && peer_closed_) {
        if ((events & (EPOLLHUP | EPOLLERR)) != 0)
            cancel_request();
        else
            set_deadline(std::min(deadline(), state_.now + half_close_grace));
    }
    // Uploads wait for their share of the iteration, so that small requests are served first.
    if (is_receiving()) return yield() != Step::end;
    return advance();
}

bool Connection::continue_transfer() {
    is_queued_ = false;
    return advance();
}

bool Connection::handle_deadline() {
    switch (phase_) {
        case Phase::idle:
            if (limited_) return refuse(429, too_many_of_client) != Step::end && advance();
            return !in_.empty();  // bytes already received are served in its turn
        case Phase::lingering:
            return false;
        case Phase::head: {
            Scan scan = scan_head(in_);
            method_ = std::move(scan.head.method);
            target_ = std::move(scan.head.target);
            id_ = state_.new_id();
            return refuse(408, "the head of the request did not arrive in time") != Step::end &&
                   advance();
        }
        case Phase::body:
            return refuse(408, "the body did not arrive in time") != Step::end && advance();
        case Phase::busy:
            if (peer_closed_)
                cancel_request();
            else if (const auto worker_request = worker_request_.lock())
                worker_request->cancel(PendingRequest::CancelReason::timed_out);
            return true;  // the worker sends a response at once
        case Phase::writing:
            report(false);
            return false;
    }
    return false;
}

bool Connection::handle_reply(Reply reply) {
    release_body();  // the request has been processed
    label_ = std::move(reply.label);
    if (reply.hot && reply.epoch == state_.shared.epoch) state_.hot.insert(std::move(reply.hot));
    const auto sending = std::make_shared<const Sending>(std::move(reply.sending));
    return send(sending) != Step::end && advance();
}

bool Connection::drain() {
    if (phase_ != Phase::idle) return true;
    // A connection that has been served is closed; a new one has a short time for its request.
    set_deadline(std::min(
        deadline(), served_ > 0 ? state_.now : state_.now + 2 * state_.options.shutdown_grace));
    return true;
}

bool Connection::refuse_connection() {
    id_ = state_.new_id();
    return refuse(503, "too many connections; try again in a moment") != Step::end && advance();
}

std::optional<double> Connection::rate() const {
    if (phase_ != Phase::writing || !holds_in_flight_) return std::nullopt;
    const std::chrono::duration<double> taken = state_.now - send_start_;
    return static_cast<double>(out_.sent()) / std::max(taken.count(), 1e-3);
}

bool Connection::abort_response() {
    report(false);
    return false;
}

std::optional<Connection::Upload> Connection::upload() const {
    if (phase_ != Phase::body || (body_bytes_ == 0 && !waits_for_memory_)) return std::nullopt;
    const std::chrono::duration<double> taken = state_.now - body_start_;
    return Upload{body_client_, body_bytes_,
                  static_cast<double>(body_bytes_) / std::max(taken.count(), 1e-3),
                  body_has_share_};
}

bool Connection::abort_upload(std::string_view detail) {
    return refuse(503, detail) != Step::end && advance();
}

void Connection::mark_limited() {
    limited_ = true;
    set_deadline(state_.now + first_request_grace);
}

bool Connection::is_evictable() const {
    return phase_ == Phase::idle && in_.empty() && !readable_ &&
           (served_ > 0 || state_.now - phase_start_ >= first_request_grace);
}

// --- State machine ------------------------------------------------------------------------------

bool Connection::advance() {
    received_in_turn_ = 0;
    for (;;) {
        Step step = Step::wait;
        switch (phase_) {
            case Phase::idle:
            case Phase::head:
                step = read_head();
                break;
            case Phase::body:
                step = read_body();
                break;
            case Phase::busy:
                break;
            case Phase::writing:
                step = write();
                break;
            case Phase::lingering:
                step = discard();
                break;
        }
        if (step != Step::on) return step != Step::end;
    }
}

Connection::Step Connection::read_head() {
    const bool may_be_complete =
        in_.find('\n', scanned_) != std::string::npos || in_.size() > longest_uri;
    if (in_.size() > scanned_) {
        if (phase_ == Phase::idle) {
            phase_start_ = state_.now;
            enter(Phase::head);
        }
        scanned_ = in_.size();
        if (may_be_complete) {
            Scan scan = scan_head(in_);
            if (scan.state != Scan::State::incomplete) return begin(std::move(scan));
        }
        set_deadline(
            std::min(phase_start_ + state_.options.head, state_.now + state_.options.silence));
    }
    return receive(&in_, head_chunk);
}

Connection::Step Connection::begin(Scan scan) {
    Head& head = scan.head;
    const Trace trace = trace_in(head.headers).value_or(Trace());
    trace_id_ = trace.trace_id;
    parent_id_ = trace.parent_id;
    if (by_proxy_) client_ = state_.options.proxies.client_address(peer_, head.headers);
    if (scan.state == Scan::State::complete && respond_from_hot_table(head)) {
        in_.erase(0, scan.used);
        scanned_ = 0;
        return Step::on;
    }
    request_ = api::Request();
    routed_ = nullptr;
    request_.method = std::move(head.method);
    request_.target = std::move(head.target);
    request_.headers = std::move(head.headers);
    method_ = request_.method;
    target_ = request_.target;
    const std::string_view given_id = request_.header("X-Request-Id");
    id_ = is_valid_id(given_id) ? std::string(given_id) : state_.new_id();
    request_.id = id_;
    if (scan.state == Scan::State::refused) return refuse(scan.status, scan.detail);
    if (limited_) return refuse(429, too_many_of_client);
    in_.erase(0, scan.used);
    scanned_ = 0;
    closing_ = !head.keep_alive || served_ + 1 >= state_.options.most_requests;

    const std::uint64_t length = head.content_length.value_or(0);
    if (length == 0) return dispatch();
    routed_ = state_.shared.route(request_);
    if (routed_ && routed_->response && head.expects_continue && in_.size() < length)
        return refuse([routed = routed_] { return *routed->response; });
    std::size_t most = routed_ ? routed_->most_body : 0;
    body_client_ = client_of(client_);
    body_has_share_ = !state_.options.proxies.trusted.contains(client_);
    most = std::min(most, body_has_share_ ? state_.options.most_body_of_client
                                          : state_.options.most_body_memory);
    if (length > most)
        return refuse(413, "the body has " + std::to_string(length) + " bytes; at most " +
                               std::to_string(most) + " are taken here");
    body_length_ = static_cast<std::size_t>(length);
    if (head.expects_continue && in_.size() < body_length_) {
        // Omitted if the socket buffer is full: the client need not wait for it.
        constexpr std::string_view go = "HTTP/1.1 100 Continue\r\n\r\n";
        const ssize_t sent = ::send(socket_, go.data(), go.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent >= 0 && static_cast<std::size_t>(sent) < go.size()) return Step::end;
    }
    // Growing step by step would copy up to half of the body at once and stop all connections for tens
    // of milliseconds. Memory is used only as bytes arrive.
    if (body_length_ >= mapped_block) request_.body.reserve(body_length_);
    enter(Phase::body);
    body_start_ = state_.now;
    return Step::on;
}

/// Sends the response from the hot-response table if it has one.
///
/// returns  true if it does; the head is consumed
bool Connection::respond_from_hot_table(const Head& head) {
    const HotLookup lookup = hot_lookup(head);
    if (!lookup.simple || (limited_ && !state_.hot.is_pinned(head.target))) return false;
    state_.clear_if_stale();
    const auto* const found = state_.hot.find(head.target, lookup.accept_encoding);
    if (!found) return false;
    const HotResponse& hot = **found;
    const std::string_view condition = lookup.if_none_match();
    const bool fresh = !hot.etag.empty() && !condition.empty() &&
                       (api::names_etag(condition, hot.etag) || api::names_any(condition));
    // The service responds to a client that has the identity variant, with the ETag of that.
    if (!fresh && !condition.empty() && !hot.identity_etag.empty() &&
        api::names_etag(condition, hot.identity_etag))
        return false;
    received_at_ = Clock::now();
    closing_ = !head.keep_alive || limited_ || served_ + 1 >= state_.options.most_requests ||
               state_.shared.draining.load(std::memory_order_relaxed);
    method_ = head.method;
    target_ = head.target;
    id_ = is_valid_id(lookup.id) ? std::string(lookup.id) : state_.new_id();
    label_ = hot.label;
    status_ = fresh ? 304 : 200;
    cache_ = fresh ? hot.cache_not_modified : hot.cache;
    text_.assign("Date: ").append(http_date());
    if (hot.has_request_id) text_.append("\r\nX-Request-Id: ").append(id_);
    text_.append("\r\n").append(closing_ ? "Connection: close\r\n" : hot.keep_alive).append("\r\n");

    const std::string& start = fresh ? hot.not_modified : hot.head;
    out_.begin(*found);
    out_.add(start.data(), start.size());
    out_.add(text_.data(), text_.size());
    if (!fresh && head.method == "GET") {
        out_.add(hot.body);
        if (hot.file >= 0) out_.add_file(hot.file, hot.size);
    }
    auto& stats = state_.hot.stats();
    add(fresh ? stats.not_modified : stats.hits, std::uint64_t{1});
    begin_to_send();
    return true;
}

Connection::Step Connection::read_body() {
    std::string& body = request_.body;
    if (!in_.empty()) {
        const std::size_t available = std::min(body_length_ - body.size(), in_.size());
        body.append(in_, 0, available);
        in_.erase(0, available);
    }
    count_body();
    if (body.size() >= body_length_) return dispatch();
    // Nothing more is received while memory is exhausted; the reactor aborts an upload before the
    // next iteration.
    waits_for_memory_ = !has_body_memory();
    if (waits_for_memory_) {
        state_.over_limit.push_back(body_client_);
        return yield();
    }
    set_deadline(std::min(body_deadline(), state_.now + state_.options.silence));
    if (received_in_turn_ >= most_per_turn) return yield();
    return receive(&body, body_length_ - body.size());
}

bool Connection::has_body_memory() const {
    return !state_.bodies.is_exceeded() &&
           !(body_has_share_ && state_.bodies.is_exceeded_by(body_client_));
}

/// Returns when the client is too slow if nothing more arrives: a body of n bytes has to arrive
/// within T = body + n / body_rate, and after the first `body` the share of n received must not be
/// less than the share of T elapsed.
Clock::time_point Connection::body_deadline() const {
    using Seconds = std::chrono::duration<double>;
    const Seconds grace = state_.options.body;
    const auto length = static_cast<double>(body_length_);
    const Seconds all = grace + Seconds(length / static_cast<double>(state_.options.body_rate));
    const Seconds earned = all * (static_cast<double>(request_.body.size()) / length);
    return body_start_ + std::chrono::duration_cast<Clock::duration>(std::max(grace, earned));
}

/// Counts the bytes of the body received since the last call.
void Connection::count_body() {
    const std::size_t bytes = request_.body.size();
    state_.bodies.add(body_client_, bytes - body_bytes_);
    body_bytes_ = bytes;
}

void Connection::release_body() {
    state_.bodies.remove(body_client_, std::exchange(body_bytes_, 0));
}

Connection::Step Connection::dispatch() {
    received_at_ = Clock::now();
    const auto worker_request = std::make_shared<WorkerRequest>(
        state_.shared, *this, std::move(request_), routed_, client_, closing_);
    bool is_queued = false;
    try {
        is_queued = state_.shared.workers.offer([worker_request] { worker_request->start(); });
    } catch (...) {  // out of memory: refused below
    }
    if (!is_queued) {
        worker_request->drop();
        return refuse(503, "too many requests are waiting; try again in a moment");
    }
    worker_request_ = worker_request;
    enter(Phase::busy);
    set_deadline(state_.now + (peer_closed_ ? half_close_grace : state_.options.response));
    return Step::wait;
}

Connection::Step Connection::refuse(int status, std::string_view detail) {
    api::Request request;
    request.method = method_;
    request.target = target_;
    request.id = id_;
    if (!routed_ && !target_.empty()) routed_ = state_.shared.route(request);
    return refuse([&] { return state_.shared.refusal(request, status, detail); });
}

/// Responds to a request of which no more is read; the connection is closed afterwards.
Connection::Step Connection::refuse(const std::function<api::Response()>& make) {
    closing_ = unread_ = true;
    received_at_ = Clock::now();
    label_ = label_of(routed_);
    request_ = api::Request();
    release_body();
    return send(std::make_shared<const Sending>(state_.shared.codec.send(
        method_ == "HEAD" ? "HEAD / HTTP/1.1" : "GET / HTTP/1.1", make, [&](int) { return make(); },
        [] { return true; })));
}

Connection::Step Connection::send(const std::shared_ptr<const Sending>& sending) {
    const api::Response& response = sending->response;
    closing_ = closing_ || sending->closing;
    status_ = response.status;
    cache_.clear();
    for (const auto& [name, value] : response.headers)
        if (same_token(name, "Cache-Status")) cache_ = value;
    out_.begin(sending);
    if (status_ == client_left || sending->head.empty()) {
        report(false);
        return Step::end;
    }
    out_.add(sending->head.data(), sending->head.size());
    if (sending->with_body) out_.add(response.body);
    begin_to_send();
    return Step::on;
}

void Connection::begin_to_send() {
    send_start_ = state_.now;
    send_deadline_ = state_.now + 4 * state_.options.blocked_write +
                     std::chrono::seconds(out_.total() / least_send_rate);
    enter(Phase::writing);
}

Connection::Step Connection::write() {
    if (!writable_) return Step::wait;
    const std::uint64_t had = out_.sent();
    switch (out_.send(socket_)) {
        case Outgoing::Progress::failed:
            report(false);
            return Step::end;
        case Outgoing::Progress::blocked:
            writable_ = false;
            if (!std::exchange(holds_in_flight_, true)) state_.in_flight_buffers.add(out_.held());
            if (had == 0 || out_.sent() > had)
                set_deadline(std::min(send_deadline_, state_.now + state_.options.blocked_write));
            return Step::wait;
        case Outgoing::Progress::more:
            set_deadline(std::min(send_deadline_, state_.now + state_.options.blocked_write));
            return yield();
        case Outgoing::Progress::done:
            break;
    }
    report(true);
    if (closing_) return linger();
    ++served_;
    phase_start_ = state_.now;
    enter(Phase::idle);
    set_deadline(state_.shared.draining ? state_.now : state_.now + state_.options.idle);
    return in_.empty() ? Step::on : yield();
}

/// Closes the connection: at once, or after reading what the client still sends (lingering close),
/// as unread bytes would cause a reset, which discards the response.
Connection::Step Connection::linger() {
    if (in_.empty() && !unread_ && !readable_) return Step::end;
    ::shutdown(socket_, SHUT_WR);
    enter(Phase::lingering);
    discarded_ = in_.size();
    in_ = std::string();
    set_deadline(state_.now + discard_time);
    return Step::on;
}

Connection::Step Connection::discard() {
    if (discarded_ > most_discarded) return Step::end;
    if (received_in_turn_ >= most_per_turn) return yield();
    const std::size_t had = received_in_turn_;
    const Step step = receive(nullptr, discard_chunk);
    discarded_ += received_in_turn_ - had;
    return step;
}

Connection::Step Connection::yield() {
    if (!is_queued_) state_.unfinished_transfers.push_back(this);
    is_queued_ = true;
    return Step::wait;
}

// --- Helpers ------------------------------------------------------------------------------------

/// Calls recv() once.
///
/// returns  on: bytes arrived; wait: none yet; end: none will
Connection::Step Connection::receive(std::string* to, std::size_t most) {
    if (!readable_) return Step::wait;
    // With MSG_TRUNC the kernel discards bytes of a TCP socket instead of copying them.
    if (to) most = std::min(most, state_.receive_buffer.size());
    const ssize_t got = to ? ::recv(socket_, state_.receive_buffer.data(), most, MSG_DONTWAIT)
                           : ::recv(socket_, nullptr, most, MSG_DONTWAIT | MSG_TRUNC);
    if (got == 0) return Step::end;
    if (got < 0) {
        if (errno == EINTR) return Step::on;
        if (errno != EAGAIN) return Step::end;
        readable_ = false;
        return Step::wait;
    }
    const auto bytes = static_cast<std::size_t>(got);
    // The buffer is empty: epoll reports the next byte, unless the peer has closed, which it has
    // reported already.
    if (bytes < most && !peer_closed_) readable_ = false;
    if (to) to->append(state_.receive_buffer.data(), bytes);
    received_in_turn_ += bytes;
    if (is_receiving()) state_.upload_bytes += bytes;
    return Step::on;
}

void Connection::enter(Phase phase) {
    add(state_.phases[static_cast<std::size_t>(phase_)], std::size_t(-1));
    add(state_.phases[static_cast<std::size_t>(phase)], std::size_t{1});
    phase_ = phase;
}

void Connection::cancel_request() {
    if (const auto worker_request = worker_request_.lock())
        worker_request->cancel(PendingRequest::CancelReason::disconnected);
}

void Connection::release_in_flight() {
    if (std::exchange(holds_in_flight_, false)) state_.in_flight_buffers.remove(out_.held());
}

void Connection::report(bool complete) {
    Served& served = state_.served;
    served.method = method_;
    served.target = target_;
    served.id = id_;
    served.peer = peer_text_;
    served.client = by_proxy_ && client_ != peer_ ? text_of(client_) : std::string();
    served.trace_id = trace_id_;
    served.parent_id = parent_id_;
    served.label = label_;
    served.status = status_;
    served.bytes = out_.sent();
    served.milliseconds =
        std::chrono::duration<double, std::milli>(Clock::now() - received_at_).count();
    served.cache = cache_;
    served.complete = complete;
    try {
        state_.shared.handlers.served(served);
    } catch (...) {  // a request that cannot be logged has still been served
    }
    release_in_flight();
    out_.end();
}

}  // namespace sporeprint::server
