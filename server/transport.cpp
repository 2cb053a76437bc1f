#include "server/transport.h"

#include <netinet/in.h>
#include <sys/socket.h>

#include <utility>

#include "server/library.h"
#include "server/reactor.h"

namespace sporeprint::server {

Transport::Transport(TransportOptions options, Handlers handlers)
    : options_(std::move(options)),
      handlers_(std::move(handlers)),
      library_(std::make_unique<Library>(options_)) {
    library_->bind(options_.host, options_.port, options_.backlog);
    reactor_ = std::make_unique<Reactor>(options_, handlers_, *library_);
}

Transport::~Transport() { drain(); }

void Transport::start() {
    thread_ = std::jthread([this] { reactor_->run(); });
}

void Transport::drain() {
    if (draining_.exchange(true)) return;
    reactor_->drain();
    if (thread_.joinable()) thread_.join();
    library_->close();
}

void Transport::forget() { reactor_->forget(); }

int Transport::port() const {
    sockaddr_storage address{};
    socklen_t size = sizeof address;
    if (getsockname(library_->socket(), reinterpret_cast<sockaddr*>(&address), &size) != 0)
        return options_.port;
    return ntohs(address.ss_family == AF_INET6
                     ? reinterpret_cast<const sockaddr_in6*>(&address)->sin6_port
                     : reinterpret_cast<const sockaddr_in*>(&address)->sin_port);
}

Transport::Load Transport::load() const { return reactor_->load(); }

}  // namespace sporeprint::server
