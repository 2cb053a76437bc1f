#include "server/http/head_codec.h"

#include <fcntl.h>
#include <httplib.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <stdexcept>
#include <utility>

#include "server/http/head.h"

namespace sporeprint::server {

namespace {

/// Returns true if a response of this kind has a Content-Length.
bool has_length(const api::Response& response) {
    return response.has_body && response.status != 204 && response.status != 304;
}

/// The stream of one request: the library reads the request head from it and writes the response
/// head to it.
class HeadStream final : public httplib::Stream {
  public:
    HeadStream(std::string_view in, std::string& out) : in_(in), out_(out) {}

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
    socket_t socket() const override { return INVALID_SOCKET; }

  private:
    std::string_view in_;
    std::string& out_;
};

/// One call of send(). The handlers of the library are registered once and find it by `current`.
struct CodecCall {
    const std::function<api::Response()>& make;
    const std::function<api::Response(int status)>& refuse;
    const std::function<bool()>& closing;
    Sending& sending;
    bool responded = false;
};

thread_local CodecCall* current = nullptr;

/// Replaces the headers set by the library: ranges are served elsewhere, and lengths are set here.
void write_headers(CodecCall& call, httplib::Headers& headers) {
    const api::Response& response = call.sending.response;
    const std::string keep_alive =
        headers.count("Keep-Alive") ? headers.find("Keep-Alive")->second : std::string();
    headers.clear();
    for (const auto& [name, value] : response.headers) {
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
    headers.emplace("Date", http_date());
    if (has_length(response))
        headers.emplace("Content-Length", std::to_string(size_of(response.body)));
    call.sending.closing = call.closing();
    if (call.sending.closing)
        headers.emplace("Connection", "close");
    else if (!keep_alive.empty())
        headers.emplace("Keep-Alive", keep_alive);
}

}  // namespace

class HttpHeadCodec::Server final : public httplib::Server {
  public:
    explicit Server(const TransportOptions& options) {
        set_tcp_nodelay(true);
        set_keep_alive_timeout(std::max<std::time_t>(options.idle.count() / 1000, 1));
        set_keep_alive_max_count(options.most_requests);
        set_socket_options([](socket_t socket) {
            const int yes = 1;  // without SO_REUSEPORT: a second server must not share the port
            setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        });
        set_pre_routing_handler([](const httplib::Request&, httplib::Response& res) {
            CodecCall& call = *current;
            call.sending.response = call.make();
            call.responded = true;
            res.status = call.sending.response.status;
            return HandlerResponse::Handled;
        });
        set_error_handler([](const httplib::Request&, httplib::Response& res) {
            CodecCall& call = *current;
            if (!call.responded) {
                call.sending.response = call.refuse(res.status);
                call.responded = true;
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

    void bind(const std::string& host, int port, int backlog) {
        errno = 0;
        const bool bound = port == 0 ? bind_to_any_port(host) > 0 : bind_to_port(host, port);
        const int code = errno;
        if (!bound) {
            std::string text =
                "Cannot listen on port " + std::to_string(port) + " of " + host + ": ";
            text += code == EADDRINUSE
                        ? "it is in use. Stop the server that runs there, or choose another --port"
                    : code == EACCES || code == EADDRNOTAVAIL || code == EMFILE
                        ? std::strerror(code)
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

    /// Processes one request by the library's protected entry point.
    void process(httplib::Stream& stream) {
        bool ignored = false;
        process_request(stream, false, ignored, [](httplib::Request& req) { req.ranges.clear(); });
    }
};

HttpHeadCodec::HttpHeadCodec(const TransportOptions& options)
    : server_(std::make_unique<Server>(options)) {}
HttpHeadCodec::~HttpHeadCodec() { server_->close(); }

void HttpHeadCodec::bind(const std::string& host, int port, int backlog) {
    server_->bind(host, port, backlog);
}

int HttpHeadCodec::socket() const { return server_->socket(); }
void HttpHeadCodec::close() { server_->close(); }

Sending HttpHeadCodec::send(const std::string& request_line,
                            const std::function<api::Response()>& make,
                            const std::function<api::Response(int status)>& refuse,
                            const std::function<bool()>& closing) {
    Sending sending;
    const std::string_view method =
        std::string_view(request_line).substr(0, request_line.find(' '));
    const bool is_known = method == "GET" || method == "HEAD" || method == "POST";
    const std::string in =
        (is_known ? request_line : "GET" + request_line.substr(method.size())) + "\r\n\r\n";
    HeadStream stream(in, sending.head);
    CodecCall call{make, refuse, closing, sending};
    current = &call;
    try {
        server_->process(stream);
    } catch (...) {
        sending.head.clear();
    }
    current = nullptr;
    sending.with_body = method != "HEAD" && has_length(sending.response);
    return sending;
}

const std::string& http_date() {
    constexpr std::array<const char*, 7> days = {"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
    constexpr std::array<const char*, 12> months = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                    "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
    thread_local std::time_t formatted_at = -1;
    thread_local std::string date;
    const std::time_t now = std::time(nullptr);
    if (now == formatted_at) return date;
    std::tm utc{};
    gmtime_r(&now, &utc);
    std::array<char, 64> text{};
    const int length =
        std::snprintf(text.data(), text.size(), "%s, %02d %s %04d %02d:%02d:%02d GMT",
                      days[static_cast<std::size_t>(utc.tm_wday)], utc.tm_mday,
                      months[static_cast<std::size_t>(utc.tm_mon)], utc.tm_year + 1900, utc.tm_hour,
                      utc.tm_min, utc.tm_sec);
    date.assign(text.data(), static_cast<std::size_t>(length));
    formatted_at = now;
    return date;
}

}  // namespace sporeprint::server
