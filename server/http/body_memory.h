// The memory that request bodies take while they arrive and are worked on: in all, and for each
// client. Used on one thread.
#pragma once

#include <cstddef>
#include <map>

#include "server/http/addresses.h"

namespace sporeprint::server {

class BodyMemory {
  public:
    /// most            bytes of all bodies together
    /// most_of_client  of those, of one client
    BodyMemory(std::size_t most, std::size_t most_of_client)
        : most_(most), most_of_client_(most_of_client) {}

    /// Counts bytes that have arrived from a client; more than there is room for is counted too.
    void add(const Address& client, std::size_t bytes) {
        if (bytes == 0) return;
        of_client_[client] += bytes;
        bytes_ += bytes;
    }

    /// Takes back bytes of an earlier add() for the same client.
    void remove(const Address& client, std::size_t bytes) {
        if (bytes == 0) return;
        const auto found = of_client_.find(client);
        if ((found->second -= bytes) == 0) of_client_.erase(found);
        bytes_ -= bytes;
    }

    [[nodiscard]] std::size_t bytes() const { return bytes_; }
    [[nodiscard]] std::size_t most_of_client() const { return most_of_client_; }

    [[nodiscard]] std::size_t bytes_of(const Address& client) const {
        const auto found = of_client_.find(client);
        return found == of_client_.end() ? 0 : found->second;
    }

    /// Whether all bodies together take more than they may.
    [[nodiscard]] bool is_exceeded() const { return bytes_ > most_; }

    /// Whether those of one client do.
    [[nodiscard]] bool is_exceeded_by(const Address& client) const {
        return bytes_of(client) > most_of_client_;
    }

    /// Whether a client takes at least as much as the mean of all that take any.
    [[nodiscard]] bool takes_much(const Address& client) const {
        return bytes_of(client) * of_client_.size() >= bytes_;
    }

  private:
    std::size_t most_, most_of_client_;
    std::size_t bytes_ = 0;
    std::map<Address, std::size_t> of_client_;  ///< none is zero
};

}  // namespace sporeprint::server
