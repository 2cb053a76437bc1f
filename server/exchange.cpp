#include "server/exchange.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "server/hot_table.h"

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

api::Answer Backroom::refusal(const api::Request& request, int status,
                              std::string_view detail) const {
    try {
        return handlers.refuse(request, status, detail);
    } catch (...) {
        api::Answer bare;
        bare.status = status;
        return bare;
    }
}

std::optional<api::Answer> Backroom::judge_head(const api::Request& request) const {
    if (!handlers.judge_head) return std::nullopt;
    try {
        return handlers.judge_head(request);
    } catch (...) {
        return std::nullopt;
    }
}

std::string Backroom::label(std::string_view method, std::string_view target) const {
    try {
        return handlers.label(method, target);
    } catch (...) {
        return {};
    }
}

Exchange::~Exchange() {
    if (!answered_) reply(back_.refusal(request_, 500, {}));
}

void Exchange::start() {
    try {
        epoch_ = back_.epoch;
        label_ = back_.label(request_.method, request_.target);
        back_.handlers.answer(shared_from_this());
    } catch (...) {
        reply(back_.refusal(request_, 500, {}));
    }
}

void Exchange::end(Over why) {
    if (why == Over::left) gone_ = true;
    std::function<void(Over)> tell;
    {
        const std::lock_guard lock(mutex_);
        if (over_) return;
        over_ = why;
        tell.swap(tell_);
    }
    if (tell) resume([tell = std::move(tell), why] { tell(why); });
}

void Exchange::drop() { static_cast<void>(claim()); }

bool Exchange::claim() {
    if (answered_.exchange(true)) return false;
    std::function<void(Over)> tell;  // destroyed outside the lock
    const std::lock_guard lock(mutex_);
    tell.swap(tell_);
    return true;
}

void Exchange::reply(api::Answer answer) {
    if (!claim()) return;
    bool closing = closing_;
    Reply reply;
    reply.to = from_;
    reply.label = std::move(label_);
    reply.epoch = epoch_;
    reply.sending = back_.library.send(
        request_.method + ' ' + request_.target + " HTTP/1.1", [&] { return std::move(answer); },
        [&](int status) {
            closing = true;
            return back_.refusal(request_, status,
                                 status == 400 ? "the request line is malformed" : "");
        },
        [&] { return closing || back_.draining; });
    if (request_.method == "GET")
        reply.hot = hot_answer(request_.target, reply.sending, reply.label);
    back_.mailbox.post(std::move(reply));
}

void Exchange::resume(std::function<void()> go_on) {
    back_.workers.post([self = shared_from_this(), go_on = std::move(go_on)] {
        try {
            go_on();
        } catch (...) {
            self->reply(self->back_.refusal(self->request_, 500, {}));
        }
    });
}

void Exchange::wait(std::function<void(Over)> over) {
    std::optional<Over> already;
    {
        const std::lock_guard lock(mutex_);
        already = over_;
        if (!over_ && !answered_) tell_.swap(over);
    }
    if (already) over(*already);
}

}  // namespace sporeprint::server
