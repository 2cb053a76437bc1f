#include "server/http/transport.h"

#include <netinet/in.h>
#include <sys/socket.h>

#include <utility>

#include "server/http/head_codec.h"
#include "server/http/reactor.h"

namespace sporeprint::server {

Transport::Transport(TransportOptions options, Handlers handlers)
    : options_(std::move(options)),
      handlers_(std::move(handlers)),
      codec_(std::make_unique<HttpHeadCodec>(options_)) {
    codec_->bind(options_.host, options_.port, options_.backlog);
    reactor_ = std::make_unique<Reactor>(options_, handlers_, *codec_);
}

Transport::~Transport() { drain(); }

void Transport::start() {
    thread_ = std::jthread([this] { reactor_->run(); });
}

void Transport::drain() {
    if (draining_.exchange(true)) return;
    reactor_->drain();
    if (thread_.joinable()) thread_.join();
    codec_->close();
}

void Transport::invalidate() { reactor_->invalidate(); }

int Transport::port() const {
    sockaddr_storage address{};
    socklen_t size = sizeof address;
    if (getsockname(codec_->socket(), reinterpret_cast<sockaddr*>(&address), &size) != 0)
        return options_.port;
    return ntohs(address.ss_family == AF_INET6
                     ? reinterpret_cast<const sockaddr_in6*>(&address)->sin6_port
                     : reinterpret_cast<const sockaddr_in*>(&address)->sin_port);
}

Transport::Load Transport::load() const { return reactor_->load(); }

}  // namespace sporeprint::server
