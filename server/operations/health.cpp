#include "server/operations/health.h"

#include <netdb.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <string_view>

namespace sporeprint::server {

namespace {

struct Socket {
    int number = -1;
    ~Socket() {
        if (number >= 0) ::close(number);
    }
};

}  // namespace

bool is_healthy(const std::string& url, std::string& reason) {
    constexpr std::string_view scheme = "http://";
    if (!url.starts_with(scheme)) {
        reason = "the address does not begin with http://";
        return false;
    }
    const std::string rest = url.substr(scheme.size());
    const std::size_t slash = rest.find('/');
    const std::string authority = rest.substr(0, slash);
    const std::string path = slash == std::string::npos ? "/" : rest.substr(slash);
    const std::size_t bracket = authority.find(']');
    const std::size_t colon = authority.find(':', bracket == std::string::npos ? 0 : bracket);
    std::string host = authority.substr(0, colon);
    const std::string port = colon == std::string::npos ? "80" : authority.substr(colon + 1);
    if (host.size() > 1 && host.front() == '[') host = host.substr(1, host.size() - 2);

    addrinfo hints{};
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    if (const int error = getaddrinfo(host.c_str(), port.c_str(), &hints, &found); error != 0) {
        reason = gai_strerror(error);
        return false;
    }
    const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> addresses(found, freeaddrinfo);
    const std::string request =
        "GET " + path + " HTTP/1.1\r\nHost: " + authority + "\r\nConnection: close\r\n\r\n";
    reason = "no address";
    for (const addrinfo* address = found; address; address = address->ai_next) {
        const Socket socket{::socket(address->ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0)};
        const timeval timeout{2, 0};
        setsockopt(socket.number, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
        setsockopt(socket.number, SOL_SOCKET, SO_SNDTIMEO, &timeout, sizeof timeout);
        std::array<char, 16> response{};
        std::size_t received = 0;
        if (::connect(socket.number, address->ai_addr, address->ai_addrlen) != 0 ||
            ::send(socket.number, request.data(), request.size(), MSG_NOSIGNAL) < 0) {
            reason = std::strerror(errno);
            continue;
        }
        while (received < 12) {
            const ssize_t more =
                ::recv(socket.number, response.data() + received, 12 - received, 0);
            if (more <= 0) break;
            received += static_cast<std::size_t>(more);
        }
        const std::string_view line(response.data(), received);
        if (line.size() == 12 && line.starts_with("HTTP/1.") && line.substr(8) == " 200")
            return true;
        reason = line.empty() ? "no answer in time" : "the answer was " + std::string(line);
        return false;
    }
    return false;
}

}  // namespace sporeprint::server
