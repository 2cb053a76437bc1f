#include "server/transport.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <httplib.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <exception>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>
#include <utility>

#include "server/head.h"

namespace sporeprint::server {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr std::size_t small_body = 256u << 10;       ///< not counted against most_body_memory
constexpr std::size_t received_at_once = 64u << 10;  ///< bytes
constexpr std::size_t most_discarded = 16u << 20;  ///< bytes of a refused request read and dropped
constexpr milliseconds discarding{1000};           ///< at most so long
constexpr milliseconds glance_around{100};         ///< how often an idle connection looks up

int milliseconds_until(Clock::time_point deadline) {
    const auto left =
        std::chrono::duration_cast<milliseconds>(deadline - Clock::now() + milliseconds(1));
    return static_cast<int>(std::clamp<std::int64_t>(left.count(), 0, 3'600'000));
}

/// Polls one socket; returns its events, 0 at the deadline.
short await(int socket, short events, Clock::time_point deadline, int wake = -1) {
    for (;;) {
        std::array<pollfd, 2> polled = {{{socket, events, 0}, {wake, POLLIN, 0}}};
        const int ready = ::poll(polled.data(), wake < 0 ? 1 : 2, milliseconds_until(deadline));
        if (ready > 0) return polled[0].revents;  // 0 when only `wake` is readable
        if (ready == 0) return 0;
        if (errno != EINTR) return POLLERR;
    }
}

bool is_proper_id(std::string_view id) {
    return !id.empty() && id.size() <= 64 && std::all_of(id.begin(), id.end(), [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
               c == '_' || c == '-';
    });
}

/// IMF-fixdate of now.
std::string date() {
    constexpr std::array<const char*, 7> days = {"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
    constexpr std::array<const char*, 12> months = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                    "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    std::array<char, 64> text{};
    const int length =
        std::snprintf(text.data(), text.size(), "%s, %02d %s %04d %02d:%02d:%02d GMT",
                      days[static_cast<std::size_t>(utc.tm_wday)], utc.tm_mday,
                      months[static_cast<std::size_t>(utc.tm_mon)], utc.tm_year + 1900, utc.tm_hour,
                      utc.tm_min, utc.tm_sec);
    return {text.data(), static_cast<std::size_t>(length)};
}

/// Spreads a counter over 64 bits, so that ids cannot be guessed from one another at a glance.
std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

std::string hexadecimal(std::uint64_t x) {
    std::string text(16, '0');
    for (std::size_t i = 0; i < 16; ++i) text[15 - i] = "0123456789abcdef"[(x >> (4 * i)) & 15];
    return text;
}

/// Whether an answer of this kind has bytes after its head, and so a length.
bool has_length(const api::Answer& answer) {
    return answer.has_body && answer.status != 204 && answer.status != 304;
}

/// The head of a request, to be read, and the head of its answer, to be sent.
class HeadStream final : public httplib::Stream {
  public:
    HeadStream(std::string_view in, std::string& out, int socket)
        : in_(in), out_(out), socket_(socket) {}

    bool is_readable() const override { return !in_.empty(); }
    bool is_writable() const override { return true; }
    ssize_t read(char* to, std::size_t size) override {
        size = std::min(size, in_.size());
        in_.copy(to, size);
        in_.remove_prefix(size);
        return static_cast<ssize_t>(size);
    }
    ssize_t write(const char* from, std::size_t size) override {
        out_.append(from, size);
        return static_cast<ssize_t>(size);
    }
    void get_remote_ip_and_port(std::string&, int&) const override {}
    void get_local_ip_and_port(std::string&, int&) const override {}
    socket_t socket() const override { return socket_; }

  private:
    std::string_view in_;
    std::string& out_;
    int socket_;
};

}  // namespace

// --- cpp-httplib -------------------------------------------------------------------------------

/// The library's server without its loop: it binds, parses request lines and formats heads. Its
/// handlers are registered once and find what they serve through `current`.
class Transport::Listener final : public httplib::Server {
  public:
    /// One request on its way through the library.
    struct Exchange {
        std::function<api::Answer()> make;              ///< the answer to a request it accepts
        std::function<api::Answer(int status)> refuse;  ///< the answer when it does not
        std::function<bool()> closing;  ///< asked last: whether the connection ends after this
        api::Answer answer;
        bool answered = false;
    };

    explicit Listener(const TransportOptions& options) {
        set_tcp_nodelay(true);
        set_keep_alive_timeout(std::max<std::time_t>(options.idle.count() / 1000, 1));
        set_keep_alive_max_count(options.most_requests);
        set_socket_options([](socket_t socket) {
            const int yes = 1;  // and no SO_REUSEPORT: a second server must not share the port
            setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        });
        set_pre_routing_handler([](const httplib::Request&, httplib::Response& res) {
            Exchange& exchange = *current;
            exchange.answer = exchange.make();
            exchange.answered = true;
            res.status = exchange.answer.status;
            return HandlerResponse::Handled;
        });
        set_error_handler([](const httplib::Request&, httplib::Response& res) {
            Exchange& exchange = *current;
            if (!exchange.answered) {
                exchange.answer = exchange.refuse(res.status);
                exchange.answered = true;
            }
        });
        set_exception_handler([](const httplib::Request&, httplib::Response& res,
                                 std::exception_ptr) { res.status = 500; });
        set_post_routing_handler([](const httplib::Request&, httplib::Response& res) {
            try {
                write_headers(*current, res.headers);
            } catch (...) {
                res.headers.clear();
            }
        });
    }

    /// throws  std::runtime_error with a sentence
    void bind(const std::string& host, int port, int backlog) {
        errno = 0;
        const bool bound = port == 0 ? bind_to_any_port(host) > 0 : bind_to_port(host, port);
        const int why = errno;
        if (!bound) {
            std::string text =
                "Cannot listen on port " + std::to_string(port) + " of " + host + ": ";
            text += why == EADDRINUSE
                        ? "it is in use. Stop the server that runs there, or choose another --port"
                    : why == EACCES || why == EADDRNOTAVAIL || why == EMFILE
                        ? std::strerror(why)
                        : "this host name or address is not known here";
            throw std::runtime_error(text);
        }
        const int flags = fcntl(svr_sock_, F_GETFL);
        if (::listen(svr_sock_, backlog) != 0 || flags < 0 ||
            fcntl(svr_sock_, F_SETFL, flags | O_NONBLOCK) != 0)
            throw std::runtime_error(std::string("Cannot listen: ") + std::strerror(errno));
    }

    void close() {
        const socket_t socket = svr_sock_.exchange(INVALID_SOCKET);
        if (socket != INVALID_SOCKET) ::close(socket);
    }

    [[nodiscard]] int socket() const { return svr_sock_; }

    /// Lets the library parse the request line and format the head of what `exchange` answers.
    ///
    /// returns  the head, ready to be sent; empty when none could be made
    std::string head_of(const std::string& request_line, int socket, Exchange& exchange) {
        std::string out;
        const std::string in = request_line + "\r\n\r\n";
        HeadStream stream(in, out, socket);
        current = &exchange;
        try {
            bool ignored = false;
            process_request(stream, false, ignored,
                            [](httplib::Request& req) { req.ranges.clear(); });
        } catch (...) {
            out.clear();
        }
        current = nullptr;
        return out;
    }

  private:
    /// Replaces what the library has put in: no range is served here, lengths are our own.
    static void write_headers(Exchange& exchange, httplib::Headers& headers) {
        const api::Answer& answer = exchange.answer;
        const std::string keep_alive =
            headers.count("Keep-Alive") ? headers.find("Keep-Alive")->second : std::string();
        headers.clear();
        for (const auto& [name, value] : answer.headers) {
            if (name.empty() || name.find_first_of("\r\n:", 0) != std::string::npos ||
                value.find_first_of(std::string_view("\r\n\0", 3)) != std::string::npos)
                continue;
            const auto old = headers.find(name);
            if (old == headers.end())
                headers.emplace(name, value);
            else if (same_token(name, "Vary"))
                old->second += ", " + value;
            else
                old->second = value;
        }
        for (const char* ours : {"Content-Length", "Connection", "Keep-Alive", "Date"})
            headers.erase(ours);
        headers.emplace("Date", date());
        if (has_length(answer))
            headers.emplace("Content-Length", std::to_string(size_of(answer.body)));
        if (exchange.closing())
            headers.emplace("Connection", "close");
        else if (!keep_alive.empty())
            headers.emplace("Keep-Alive", keep_alive);
    }

    static thread_local Exchange* current;
};

thread_local Transport::Listener::Exchange* Transport::Listener::current = nullptr;

// --- One connection ----------------------------------------------------------------------------

class Transport::Connection {
  public:
    Connection(Transport& owner, int socket)
        : owner_(owner), options_(owner.options_), socket_(socket) {
        sockaddr_storage address{};
        socklen_t size = sizeof address;
        std::array<char, INET6_ADDRSTRLEN> text{};
        if (getpeername(socket_, reinterpret_cast<sockaddr*>(&address), &size) == 0) {
            const void* bytes =
                address.ss_family == AF_INET6
                    ? static_cast<const void*>(
                          &reinterpret_cast<const sockaddr_in6*>(&address)->sin6_addr)
                    : &reinterpret_cast<const sockaddr_in*>(&address)->sin_addr;
            if (inet_ntop(address.ss_family, bytes, text.data(), text.size())) peer_ = text.data();
        }
    }
    ~Connection() { ::close(socket_); }
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    void run() {
        for (served_ = 0; served_ < options_.most_requests; ++served_) {
            if (buffer_.empty() && !first_byte()) return;
            if (!exchange()) break;
        }
        if (!buffer_.empty() || unread_) discard();
    }

    /// 503 without reading anything, on the accepting thread: never waits.
    void turn_away() {
        closing_ = true;
        api::Request request;
        request.id = owner_.new_id();
        const Clock::time_point now = Clock::now();
        Sending sending = formatted("GET / HTTP/1.1", [&] {
            return refusal(request, 503, "too many connections; try again in a moment");
        });
        std::array<char, 4096> dropped;
        while (::recv(socket_, dropped.data(), dropped.size(), MSG_DONTWAIT) > 0) continue;
        send(sending, now);
        ::shutdown(socket_, SHUT_WR);
    }

  private:
    struct Sending {
        std::string head;
        api::Answer answer;
        bool with_body = true;
    };

    /// Receives what has come. Returns false when the client has closed or reset.
    bool receive(std::string& to, std::size_t most) {
        const std::size_t had = to.size();
        to.resize(had + most);
        const ssize_t got = ::recv(socket_, to.data() + had, most, MSG_DONTWAIT);
        const int why = errno;
        to.resize(had + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
        return got > 0 || (got < 0 && (why == EAGAIN || why == EINTR));
    }

    /// Waits for a request to begin. Idle connections make room when others wait, and end when the
    /// server drains; one that has just come gets a moment to say what it wants.
    bool first_byte() {
        Clock::time_point deadline = Clock::now() + options_.idle;
        bool hurried = false;
        for (;;) {
            const bool draining = owner_.draining_;
            if (draining && !hurried) {
                hurried = true;
                deadline = std::min(
                    deadline, Clock::now() + (served_ ? milliseconds(0) : 2 * options_.farewell));
            }
            const Clock::time_point slice = std::min(deadline, Clock::now() + glance_around);
            if (await(socket_, POLLIN, slice, draining ? -1 : owner_.wake_) != 0)
                return receive(buffer_, 4096) && (!buffer_.empty() || first_byte());
            if (Clock::now() >= deadline) return false;
            if (served_ > 0 && owner_.crowded()) return false;
        }
    }

    /// Reads one request and answers it. Returns whether the connection may go on.
    bool exchange() {
        const Clock::time_point began = Clock::now();
        Scan scan = scan_head(buffer_);
        while (scan.state == Scan::State::incomplete) {
            const Clock::time_point deadline =
                std::min(began + options_.head, Clock::now() + options_.silence);
            if (await(socket_, POLLIN, deadline) == 0) {
                scan.state = Scan::State::refused;
                scan.status = 408;
                scan.detail = "the head of the request did not arrive in time";
                break;
            }
            if (!receive(buffer_, 4096)) return false;
            scan = scan_head(buffer_);
        }
        api::Request request;
        request.method = std::move(scan.head.method);
        request.target = std::move(scan.head.target);
        request.headers = std::move(scan.head.headers);
        const std::string_view asked_id = request.header("X-Request-Id");
        request.id = is_proper_id(asked_id) ? std::string(asked_id) : owner_.new_id();
        if (scan.state == Scan::State::refused) return refuse(request, scan.status, scan.detail);
        buffer_.erase(0, scan.used);

        const std::uint64_t length = scan.head.content_length.value_or(0);
        const std::size_t most = most_body(request);
        if (length > most)
            return refuse(request, 413,
                          "the body has " + std::to_string(length) + " bytes; at most " +
                              std::to_string(most) + " are taken here");
        const BodyMemory memory(owner_, static_cast<std::size_t>(length));
        if (!memory.granted())
            return refuse(request, 503, "too many large bodies are being received; try again");
        if (length > 0) {
            if (scan.head.expects_continue && buffer_.size() < length &&
                !send_plain("HTTP/1.1 100 Continue\r\n\r\n"))
                return false;
            if (!read_body(request.body, static_cast<std::size_t>(length)))
                return body_is_late_ && refuse(request, 408, "the body did not arrive in time");
        }

        closing_ = !scan.head.keep_alive || served_ + 1 >= options_.most_requests;
        const Clock::time_point ready = Clock::now();
        const Gone gone = [this] { return has_left(); };
        const Sending sending = formatted(request.method + ' ' + request.target + " HTTP/1.1",
                                          [&] { return answer(request, gone); });
        return finish(request, sending, ready);
    }

    /// Accounts for large bodies, so that many of them together cannot take all memory.
    class BodyMemory {
      public:
        BodyMemory(Transport& owner, std::size_t bytes)
            : owner_(owner), bytes_(bytes > small_body ? bytes : 0) {
            granted_ = bytes_ == 0 || owner_.body_memory_.fetch_add(bytes_) + bytes_ <=
                                          owner_.options_.most_body_memory;
        }
        ~BodyMemory() { owner_.body_memory_ -= bytes_; }
        BodyMemory(const BodyMemory&) = delete;
        BodyMemory& operator=(const BodyMemory&) = delete;
        [[nodiscard]] bool granted() const { return granted_; }

      private:
        Transport& owner_;
        std::size_t bytes_;
        bool granted_ = true;
    };

    bool read_body(std::string& body, std::size_t length) {
        const std::size_t there = std::min(length, buffer_.size());
        body.assign(buffer_, 0, there);
        buffer_.erase(0, there);
        const auto allowance = options_.body * static_cast<int>(1 + length / small_body);
        const Clock::time_point end = Clock::now() + allowance;
        while (body.size() < length) {
            const Clock::time_point deadline = std::min(end, Clock::now() + options_.silence);
            if (await(socket_, POLLIN, deadline) == 0) {
                body_is_late_ = true;
                return false;
            }
            if (!receive(body, std::min(length - body.size(), received_at_once))) return false;
        }
        return true;
    }

    std::size_t most_body(const api::Request& request) const {
        try {
            return owner_.handlers_.most_body(request.method, request.target);
        } catch (...) {
            return 0;
        }
    }

    api::Answer answer(const api::Request& request, const Gone& gone) const {
        try {
            return owner_.handlers_.answer(request, gone);
        } catch (...) {
            return refusal(request, 500, {});
        }
    }

    api::Answer refusal(const api::Request& request, int status, std::string_view detail) const {
        try {
            return owner_.handlers_.refuse(request, status, detail);
        } catch (...) {
            api::Answer bare;
            bare.status = status;
            return bare;
        }
    }

    /// Answers with a problem and ends the connection: what follows cannot be told apart.
    bool refuse(const api::Request& request, int status, std::string_view detail) {
        closing_ = true;
        unread_ = true;
        const Sending sending =
            formatted("GET / HTTP/1.1", [&] { return refusal(request, status, detail); });
        return finish(request, sending, Clock::now());
    }

    Sending formatted(const std::string& request_line, std::function<api::Answer()> make) {
        api::Request bare;
        bare.id = owner_.new_id();
        Listener::Exchange exchange;
        exchange.make = std::move(make);
        exchange.refuse = [&](int status) {
            closing_ = true;
            return refusal(bare, status, status == 400 ? "the request line is malformed" : "");
        };
        exchange.closing = [this] { return closing_ = closing_ || owner_.draining_; };
        Sending sending;
        sending.head = owner_.listener_->head_of(request_line, socket_, exchange);
        sending.answer = std::move(exchange.answer);
        sending.with_body = !request_line.starts_with("HEAD ") && has_length(sending.answer);
        return sending;
    }

    /// Sends, tells what was served, and returns whether the connection may go on.
    bool finish(const api::Request& request, const Sending& sending, Clock::time_point ready) {
        Served served;
        served.method = request.method;
        served.target = request.target;
        served.id = request.id;
        served.peer = peer_;
        served.status = sending.answer.status;
        for (const auto& [name, value] : sending.answer.headers)
            if (same_token(name, "Cache-Status")) served.cache = value;
        if (sending.answer.status == client_left || sending.head.empty())
            served.complete = false;
        else
            served.complete = send(sending, Clock::now());
        served.bytes = sent_;
        served.milliseconds =
            std::chrono::duration<double, std::milli>(Clock::now() - ready).count();
        try {
            owner_.handlers_.served(served);
        } catch (...) {  // a request that cannot be logged has still been answered
        }
        return served.complete && !closing_;
    }

    /// Head and slices in as few calls as the socket takes them; nothing is copied.
    bool send(const Sending& sending, Clock::time_point began) {
        std::vector<iovec> parts;
        parts.reserve(1 + sending.answer.body.size());
        const auto add = [&](const void* data, std::size_t size) {
            if (size > 0) parts.push_back({const_cast<void*>(data), size});
        };
        add(sending.head.data(), sending.head.size());
        if (sending.with_body)
            for (const Slice& slice : sending.answer.body) add(slice.data(), slice.size);
        return send(parts, began);
    }

    bool send_plain(std::string_view text) {
        std::vector<iovec> parts = {{const_cast<char*>(text.data()), text.size()}};
        return send(parts, Clock::now());
    }

    bool send(std::vector<iovec>& parts, Clock::time_point began) {
        constexpr std::size_t most_parts = 64;
        constexpr std::size_t slowest = 16 * 1024;  // bytes in a second
        sent_ = 0;
        std::size_t total = 0;
        for (const iovec& part : parts) total += part.iov_len;
        const Clock::time_point end =
            began + 4 * options_.blocked_write + std::chrono::seconds(total / slowest);
        for (std::size_t first = 0; first < parts.size();) {
            msghdr message{};
            message.msg_iov = &parts[first];
            message.msg_iovlen = std::min(parts.size() - first, most_parts);
            ssize_t went = ::sendmsg(socket_, &message, MSG_NOSIGNAL | MSG_DONTWAIT);
            if (went < 0) {
                if (errno == EINTR) continue;
                if (errno != EAGAIN) return false;
                const Clock::time_point deadline =
                    std::min(end, Clock::now() + options_.blocked_write);
                const short events = await(socket_, POLLOUT, deadline);
                if (events == 0 || (events & (POLLERR | POLLNVAL)) != 0) return false;
                continue;
            }
            sent_ += static_cast<std::uint64_t>(went);
            while (first < parts.size() && static_cast<std::size_t>(went) >= parts[first].iov_len)
                went -= static_cast<ssize_t>(parts[first++].iov_len);
            if (first < parts.size() && went > 0) {
                parts[first].iov_base = static_cast<char*>(parts[first].iov_base) + went;
                parts[first].iov_len -= static_cast<std::size_t>(went);
            }
        }
        return true;
    }

    /// Reads and drops what a refused client still sends, or the reset would destroy its answer.
    void discard() {
        ::shutdown(socket_, SHUT_WR);
        const Clock::time_point deadline = Clock::now() + discarding;
        std::string dropped;
        for (std::size_t total = 0; total < most_discarded;) {
            if (await(socket_, POLLIN, deadline) == 0) return;
            dropped.clear();
            if (!receive(dropped, received_at_once)) return;
            total += dropped.size();
        }
    }

    bool has_left() const {
        pollfd polled{socket_, POLLRDHUP, 0};
        return ::poll(&polled, 1, 0) > 0 && (polled.revents & (POLLRDHUP | POLLHUP | POLLERR)) != 0;
    }

    Transport& owner_;
    const TransportOptions& options_;
    int socket_;
    std::string peer_;
    std::string buffer_;
    std::size_t served_ = 0;
    std::uint64_t sent_ = 0;
    bool closing_ = false;
    bool unread_ = false;
    bool body_is_late_ = false;
};

// --- All connections ---------------------------------------------------------------------------

Transport::Transport(TransportOptions options, Handlers handlers)
    : options_(std::move(options)),
      handlers_(std::move(handlers)),
      listener_(std::make_unique<Listener>(options_)) {
    std::random_device entropy;
    id_prefix_ = (static_cast<std::uint64_t>(entropy()) << 32) | entropy();
    listener_->bind(options_.host, options_.port, options_.backlog);
    wake_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    if (wake_ < 0) {
        listener_->close();
        throw std::runtime_error(std::string("Cannot make an eventfd: ") + std::strerror(errno));
    }
}

Transport::~Transport() {
    drain();
    ::close(wake_);
}

void Transport::start() {
    acceptor_ = std::jthread([this] { accept_all(); });
}

void Transport::drain() {
    if (draining_.exchange(true)) return;
    const std::uint64_t one = 1;
    static_cast<void>(::write(wake_, &one, sizeof one));
    if (acceptor_.joinable()) acceptor_.join();
    listener_->close();
    {
        const std::lock_guard lock(mutex_);
        closed_ = true;
    }
    arrived_.notify_all();
    threads_.clear();  // joins
}

int Transport::port() const {
    sockaddr_storage address{};
    socklen_t size = sizeof address;
    if (getsockname(listener_->socket(), reinterpret_cast<sockaddr*>(&address), &size) != 0)
        return options_.port;
    return ntohs(address.ss_family == AF_INET6
                     ? reinterpret_cast<const sockaddr_in6*>(&address)->sin6_port
                     : reinterpret_cast<const sockaddr_in*>(&address)->sin_port);
}

Transport::Load Transport::load() const {
    const std::lock_guard lock(mutex_);
    return {busy_, waiting_.size(), refused_};
}

std::string Transport::new_id() { return hexadecimal(mixed(id_prefix_ + ++last_id_)); }

void Transport::accept_all() {
    const int listening = listener_->socket();
    int spare = ::open("/dev/null", O_RDONLY | O_CLOEXEC);  // to refuse when descriptors run out
    std::optional<Clock::time_point> last;
    for (;;) {
        if (draining_ && !last) last = Clock::now() + options_.farewell;
        const Clock::time_point never = Clock::now() + std::chrono::hours(1);
        const short events = await(listening, POLLIN, last.value_or(never), last ? -1 : wake_);
        if (last && events == 0) break;
        const int socket = ::accept4(listening, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
        if (socket >= 0) {
            if (!admit(socket)) turn_away(socket);
        } else if ((errno == EMFILE || errno == ENFILE) && spare >= 0) {
            ::close(spare);
            const int surplus = ::accept4(listening, nullptr, nullptr, SOCK_CLOEXEC);
            if (surplus >= 0) ::close(surplus);
            ++refused_;
            spare = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
        } else if (errno != EAGAIN && errno != EINTR && errno != ECONNABORTED) {
            std::this_thread::sleep_for(milliseconds(10));  // out of memory or buffers: go on later
        }
        if (last && Clock::now() >= *last + options_.farewell) break;
    }
    if (spare >= 0) ::close(spare);
}

bool Transport::admit(int socket) {
    {
        const std::lock_guard lock(mutex_);
        if (waiting_.size() >= options_.waiting) return false;
        waiting_.push_back(socket);
        if (waiting_.size() > idle_ && !hire()) {
            crowded_ = true;
            if (threads_.empty()) {
                waiting_.pop_back();
                return false;
            }
        }
    }
    arrived_.notify_one();
    return true;
}

bool Transport::hire() {
    if (threads_.size() >= options_.threads) return false;
    try {
        threads_.emplace_back([this] { serve_connections(); });
        return true;
    } catch (const std::system_error&) {  // the system has no more: those there are go on
        return false;
    }
}

void Transport::turn_away(int socket) {
    ++refused_;
    try {
        Connection(*this, socket).turn_away();
    } catch (...) {  // closed by the destructor
    }
}

void Transport::serve_connections() {
    std::unique_lock lock(mutex_);
    for (;;) {
        ++idle_;
        arrived_.wait(lock, [&] { return closed_ || !waiting_.empty(); });
        --idle_;
        if (waiting_.empty()) return;
        const int socket = waiting_.front();
        waiting_.pop_front();
        crowded_ = !waiting_.empty();
        ++busy_;
        lock.unlock();
        try {
            Connection(*this, socket).run();
        } catch (...) {  // out of memory: this connection ends, the server does not
        }
        lock.lock();
        --busy_;
    }
}

}  // namespace sporeprint::server
