// Bytes on their way into a socket that does not wait: pieces of memory that somebody keeps, and
// perhaps a file, sent with as few calls as the socket takes them.
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

class Outgoing {
  public:
    enum class Progress { done, more, blocked, failed };

    /// Forgets what was there. What is added below must live as long as `keeper`.
    void begin(std::shared_ptr<const void> keeper);

    void add(const void* data, std::size_t size);
    void add(const Body& body);

    /// All of a file, as the last; it is sent without being copied.
    void add_file(int descriptor, std::size_t size);

    /// Sends what the socket takes now; `more` when it took so much that others come first.
    Progress send(int socket);

    /// Lets go of the memory; sent() stays.
    void end();

    /// What it keeps in memory until end(), but for heads.
    [[nodiscard]] const std::vector<HeldBuffer>& held() const { return held_; }

    [[nodiscard]] std::uint64_t sent() const { return sent_; }    ///< bytes, since begin()
    [[nodiscard]] std::uint64_t total() const { return total_; }  ///< bytes added

  private:
    std::shared_ptr<const void> keeper_;
    std::vector<iovec> parts_;
    std::vector<HeldBuffer> held_;
    std::size_t first_ = 0;
    int file_ = -1;
    off_t file_sent_ = 0, file_size_ = 0;
    std::uint64_t sent_ = 0, total_ = 0;
};

}  // namespace sporeprint::server
