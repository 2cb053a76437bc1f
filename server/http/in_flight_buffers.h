// What answers that wait for slow clients keep in memory: each piece is counted once, however many wait with it.
#pragma once

#include <cstddef>
#include <span>
#include <unordered_map>

namespace sporeprint::server {

/// A piece of memory, or of a file in memory, that an answer on its way holds.
struct HeldBuffer {
    const void* owner = nullptr;  ///< the same for all that share it
    std::size_t bytes = 0;
};

class InFlightBuffers {
  public:
    void add(std::span<const HeldBuffer> pieces) {
        for (const HeldBuffer& piece : pieces)
            if (pieces_[piece.owner]++ == 0) bytes_ += piece.bytes;
    }

    /// Takes back an add() of the same pieces.
    void remove(std::span<const HeldBuffer> pieces) {
        for (const HeldBuffer& piece : pieces) {
            const auto found = pieces_.find(piece.owner);
            if (--found->second > 0) continue;
            pieces_.erase(found);
            bytes_ -= piece.bytes;
        }
    }

    [[nodiscard]] std::size_t bytes() const { return bytes_; }

  private:
    std::unordered_map<const void*, std::size_t> pieces_;  ///< how many wait with each
    std::size_t bytes_ = 0;
};

}  // namespace sporeprint::server
