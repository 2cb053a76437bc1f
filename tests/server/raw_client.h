// An HTTP test client that sends exactly the given bytes and reads responses strictly.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sporeprint::server {

/// One connection to a server on this machine.
class RawClient {
  public:
    /// from  local address; nullptr: 127.0.0.1
    explicit RawClient(int port, int receive_buffer = 0, const char* from = nullptr)
        : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
        if (receive_buffer > 0)
            setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        if (from) {
            sockaddr_in own{};
            own.sin_family = AF_INET;
            inet_pton(AF_INET, from, &own.sin_addr);
            static_cast<void>(::bind(socket_, reinterpret_cast<sockaddr*>(&own), sizeof own));
        }
        connected_ = ::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
    }
    ~RawClient() { close(); }
    RawClient(const RawClient&) = delete;
    RawClient& operator=(const RawClient&) = delete;

    bool connected() const { return connected_; }

    void close() {
        if (socket_ >= 0) ::close(socket_);
        socket_ = -1;
    }

    /// Closes with a reset.
    void reset() {
        const linger now{1, 0};
        setsockopt(socket_, SOL_SOCKET, SO_LINGER, &now, sizeof now);
        close();
    }

    /// Closes the sending direction.
    void finish() { ::shutdown(socket_, SHUT_WR); }

    /// Sends all bytes; returns false if the server no longer accepts them.
    bool send(std::string_view text) {
        while (!text.empty()) {
            const ssize_t sent = ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
            if (sent <= 0) return false;
            text.remove_prefix(static_cast<std::size_t>(sent));
        }
        return true;
    }

    struct Response {
        int status = 0;  ///< 0: the connection was closed without a response
        std::vector<std::pair<std::string, std::string>> headers;
        std::string head, body;

        std::string header(std::string_view name) const {
            for (const auto& [key, value] : headers)
                if (key == name) return value;
            return {};
        }
        std::size_t count(std::string_view name) const {
            std::size_t found = 0;
            for (const auto& header : headers) found += header.first == name ? 1 : 0;
            return found;
        }
    };

    /// Reads one response: a body of Content-Length bytes, none after HEAD, 204 and 304.
    Response receive(bool to_head = false) {
        Response response;
        std::size_t end = 0;
        while ((end = buffer_.find("\r\n\r\n")) == std::string::npos)
            if (!more()) return response;
        response.head = buffer_.substr(0, end + 2);
        buffer_.erase(0, end + 4);
        response.status = std::atoi(response.head.substr(9, 3).c_str());
        std::size_t at = response.head.find("\r\n") + 2;
        while (at < response.head.size()) {
            const std::size_t stop = response.head.find("\r\n", at);
            const std::string line = response.head.substr(at, stop - at);
            const std::size_t colon = line.find(": ");
            response.headers.emplace_back(line.substr(0, colon), line.substr(colon + 2));
            at = stop + 2;
        }
        if (to_head || response.status == 204 || response.status == 304 || response.status == 100)
            return response;
        const std::size_t length =
            std::strtoull(response.header("Content-Length").c_str(), nullptr, 10);
        while (buffer_.size() < length)
            if (!more()) break;
        response.body = buffer_.substr(0, length);
        buffer_.erase(0, length);
        return response;
    }

    /// Sends a request and reads the response.
    Response ask(std::string_view request, bool to_head = false) {
        send(request);
        return receive(to_head);
    }

    /// Reads until the server closes the connection.
    std::string receive_all() {
        while (more()) continue;
        return std::exchange(buffer_, {});
    }

    /// Returns true if the server closes the connection within `timeout` without another byte.
    bool is_closed(std::chrono::milliseconds timeout = std::chrono::seconds(10)) {
        pollfd polled{socket_, POLLIN, 0};
        if (!buffer_.empty() || ::poll(&polled, 1, static_cast<int>(timeout.count())) <= 0)
            return false;
        char byte = 0;
        return ::recv(socket_, &byte, 1, 0) <= 0;
    }

  private:
    bool more() {
        pollfd polled{socket_, POLLIN, 0};
        if (::poll(&polled, 1, 20'000) <= 0) return false;
        char bytes[65536];
        const ssize_t got = ::recv(socket_, bytes, sizeof bytes, 0);
        if (got <= 0) return false;
        buffer_.append(bytes, static_cast<std::size_t>(got));
        return true;
    }

    int socket_;
    bool connected_ = false;
    std::string buffer_;
};

}  // namespace sporeprint::server
