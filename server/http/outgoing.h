// The output queue of a non-blocking socket: memory slices and perhaps a file, sent by
// scatter-gather I/O with few system calls.
#pragma once

#include <sys/uio.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/bytes.h"
#include "server/http/in_flight_buffers.h"

namespace sporeprint::server {

/// The bytes of one response that are still to be sent.
class Outgoing {
  public:
    /// `more`: the limit of one call is reached, and other connections come first; `blocked`: the
    /// socket buffer is full.
    enum class Progress { done, more, blocked, failed };

    /// Clears the queue. Memory and files added later must live as long as `keeper`.
    void begin(std::shared_ptr<const void> owner);

    void add(const void* data, std::size_t size);
    void add(const Body& body);

    /// Adds a whole file as the last part; it is sent by sendfile().
    void add_file(int descriptor, std::size_t size);

    /// Sends as much as the socket accepts now, up to the limit of one call.
    Progress send(int socket);

    /// Releases the memory; sent() stays valid.
    void end();

    /// Returns the buffers held until end(), except heads.
    [[nodiscard]] const std::vector<HeldBuffer>& held() const { return held_; }

    [[nodiscard]] std::uint64_t sent() const { return sent_; }    ///< bytes since begin()
    [[nodiscard]] std::uint64_t total() const { return total_; }  ///< bytes added

  private:
    std::shared_ptr<const void> owner_;
    std::vector<iovec> parts_;
    std::vector<HeldBuffer> held_;
    std::size_t first_ = 0;
    int file_ = -1;
    off_t file_sent_ = 0, file_size_ = 0;
    std::uint64_t sent_ = 0, total_ = 0;
};

}  // namespace sporeprint::server
