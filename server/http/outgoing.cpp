#include "server/http/outgoing.h"

#include <sys/sendfile.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace sporeprint::server {

void Outgoing::begin(std::shared_ptr<const void> owner) {
    owner_ = std::move(owner);
    parts_.clear();
    held_.clear();
    first_ = 0;
    file_ = -1;
    sent_ = total_ = 0;
}

void Outgoing::add(const void* data, std::size_t size) {
    if (size == 0) return;
    parts_.push_back({const_cast<void*>(data), size});
    total_ += size;
}

void Outgoing::add(const Body& body) {
    for (const Slice& slice : body) {
        add(slice.data(), slice.size);
        if (slice.size > 0) held_.push_back({slice.owner.get(), slice.owner->size()});
    }
}

void Outgoing::add_file(int descriptor, std::size_t size) {
    file_ = descriptor;
    held_.push_back({owner_.get(), size});
    file_sent_ = 0;
    file_size_ = static_cast<off_t>(size);
    total_ += size;
}

Outgoing::Progress Outgoing::send(int socket) {
    constexpr std::size_t most_parts = 64;
    constexpr std::uint64_t most_at_once = 4u << 20;
    const std::uint64_t had = sent_;
    while (first_ < parts_.size()) {
        if (sent_ - had >= most_at_once) return Progress::more;
        msghdr message{};
        message.msg_iov = &parts_[first_];
        message.msg_iovlen = std::min(parts_.size() - first_, most_parts);
        const ssize_t sent =
            ::sendmsg(socket, &message, MSG_NOSIGNAL | MSG_DONTWAIT | (file_ >= 0 ? MSG_MORE : 0));
        if (sent < 0) {
            if (errno == EINTR) continue;
            return errno == EAGAIN ? Progress::blocked : Progress::failed;
        }
        sent_ += static_cast<std::uint64_t>(sent);
        auto written = static_cast<std::size_t>(sent);
        while (first_ < parts_.size() && written >= parts_[first_].iov_len)
            written -= parts_[first_++].iov_len;
        if (first_ < parts_.size() && written > 0) {
            parts_[first_].iov_base = static_cast<char*>(parts_[first_].iov_base) + written;
            parts_[first_].iov_len -= written;
        }
    }
    while (file_ >= 0 && file_sent_ < file_size_) {
        if (sent_ - had >= most_at_once) return Progress::more;
        const ssize_t sent = ::sendfile(socket, file_, &file_sent_,
                                        static_cast<std::size_t>(file_size_ - file_sent_));
        if (sent < 0 && errno == EINTR) continue;
        if (sent < 0 && errno == EAGAIN) return Progress::blocked;
        if (sent <= 0) return Progress::failed;
        sent_ += static_cast<std::uint64_t>(sent);
    }
    return Progress::done;
}

void Outgoing::end() {
    owner_.reset();
    file_ = -1;
    parts_.clear();
    held_.clear();
    first_ = 0;
}

}  // namespace sporeprint::server
