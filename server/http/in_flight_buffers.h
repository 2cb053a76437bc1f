// Accounting of the memory held by responses in flight to slow clients. Each buffer is counted
// once, however many responses share it.
#pragma once

#include <cstddef>
#include <span>
#include <unordered_map>

namespace sporeprint::server {

/// A buffer in memory, or in an in-memory file, held by a response in flight.
struct HeldBuffer {
    const void* owner = nullptr;  ///< identity of the buffer
    std::size_t bytes = 0;
};

/// Counts the bytes of held buffers. Used on one thread.
class InFlightBuffers {
  public:
    /// Adds one reference to each buffer.
    void add(std::span<const HeldBuffer> buffers) {
        for (const HeldBuffer& buffer : buffers)
            if (references_[buffer.owner]++ == 0) bytes_ += buffer.bytes;
    }

    /// Removes the references of an add() of the same buffers.
    void remove(std::span<const HeldBuffer> buffers) {
        for (const HeldBuffer& buffer : buffers) {
            const auto found = references_.find(buffer.owner);
            if (--found->second > 0) continue;
            references_.erase(found);
            bytes_ -= buffer.bytes;
        }
    }

    [[nodiscard]] std::size_t bytes() const { return bytes_; }

  private:
    std::unordered_map<const void*, std::size_t> references_;  ///< responses per buffer
    std::size_t bytes_ = 0;
};

}  // namespace sporeprint::server
