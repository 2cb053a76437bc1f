#include "server/http/worker_request.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "server/http/hot_table.h"

namespace sporeprint::server {

Mailbox::Mailbox() : descriptor_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (descriptor_ < 0)
        throw std::runtime_error(std::string("Cannot make an eventfd: ") + std::strerror(errno));
}

Mailbox::~Mailbox() { ::close(descriptor_); }

void Mailbox::post(Reply reply) {
    bool first = false;
    {
        const std::lock_guard lock(mutex_);
        first = replies_.empty();
        replies_.push_back(std::move(reply));
    }
    if (first) wake();
}

void Mailbox::wake() {
    const std::uint64_t one = 1;
    static_cast<void>(::write(descriptor_, &one, sizeof one));
}

std::vector<Reply> Mailbox::take() {
    std::uint64_t ignored = 0;
    static_cast<void>(::read(descriptor_, &ignored, sizeof ignored));
    std::vector<Reply> taken;
    const std::lock_guard lock(mutex_);
    taken.swap(replies_);
    return taken;
}

api::Response SharedState::refusal(const api::Request& request, int status,
                                   std::string_view detail) const {
    try {
        return handlers.refuse(request, status, detail);
    } catch (...) {
        api::Response bare;
        bare.status = status;
        return bare;
    }
}

std::shared_ptr<const api::RoutedRequest> SharedState::route(const api::Request& request) const {
    try {
        return handlers.route(request);
    } catch (...) {
        return nullptr;
    }
}

std::string label_of(const std::shared_ptr<const api::RoutedRequest>& routed) {
    return routed ? std::string(routed->label()) : "UNKNOWN";
}

WorkerRequest::~WorkerRequest() {
    if (!responded_) reply(shared_.refusal(request_, 500, {}));
}

void WorkerRequest::start() {
    try {
        epoch_ = shared_.epoch;
        if (!routed_) routed_ = shared_.handlers.route(request_);
        shared_.handlers.respond(shared_from_this());
    } catch (...) {
        reply(shared_.refusal(request_, 500, {}));
    }
}

void WorkerRequest::cancel(CancelReason reason) {
    if (reason == CancelReason::disconnected) is_disconnected_ = true;
    std::function<void(CancelReason)> on_cancel;
    {
        const std::lock_guard lock(mutex_);
        if (cancelled_) return;
        cancelled_ = reason;
        on_cancel.swap(on_cancel_);
    }
    if (on_cancel) resume([on_cancel = std::move(on_cancel), reason] { on_cancel(reason); });
}

void WorkerRequest::drop() { static_cast<void>(claim()); }

bool WorkerRequest::claim() {
    if (responded_.exchange(true)) return false;
    std::function<void(CancelReason)> released;  // destroyed outside the lock
    const std::lock_guard lock(mutex_);
    released.swap(on_cancel_);
    return true;
}

void WorkerRequest::reply(api::Response response) {
    if (!claim()) return;
    bool closing = closing_;
    Reply reply;
    reply.to = from_;
    reply.label = label_of(routed_);
    reply.epoch = epoch_;
    reply.sending = shared_.codec.send(
        request_.method + ' ' + request_.target + " HTTP/1.1", [&] { return std::move(response); },
        [&](int status) {
            closing = true;
            return shared_.refusal(request_, status,
                                   status == 400 ? "the request line is malformed" : "");
        },
        [&] { return closing || shared_.draining; });
    if (request_.method == "GET")
        reply.hot = hot_response(request_.target, reply.sending, reply.label);
    shared_.mailbox.post(std::move(reply));
}

void WorkerRequest::resume(std::function<void()> task) {
    shared_.workers.post([self = shared_from_this(), task = std::move(task)] {
        try {
            task();
        } catch (...) {
            self->reply(self->shared_.refusal(self->request_, 500, {}));
        }
    });
}

void WorkerRequest::wait(std::function<void(CancelReason)> on_cancel) {
    std::optional<CancelReason> already;
    {
        const std::lock_guard lock(mutex_);
        already = cancelled_;
        if (!cancelled_ && !responded_) on_cancel_.swap(on_cancel);
    }
    if (already) on_cancel(*already);
}

}  // namespace sporeprint::server
