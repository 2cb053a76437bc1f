// Accounting of the memory of request bodies, in total and per client, from their first byte until
// the response is ready.
#pragma once

#include <cstddef>
#include <map>
#include <string_view>

#include "server/http/addresses.h"

namespace sporeprint::server {

/// Size from which malloc() maps a block of its own (set by bound_malloc()): such a block takes memory
/// only for the pages that have been written, and none once it is freed. Bytes.
inline constexpr std::size_t mapped_block = 4u << 20;

/// The reason of a refusal, for the client.
inline constexpr std::string_view share_exceeded =
    "this client sends more at once than its share of the memory for bodies; send one after "
    "another";

/// Counts the bytes of request bodies. Used on one thread.
class BodyMemory {
  public:
    /// most            limit for all bodies together, bytes
    /// most_of_client  limit for the bodies of one client, bytes
    BodyMemory(std::size_t most, std::size_t most_of_client)
        : most_(most), most_of_client_(most_of_client) {}

    /// Counts bytes received from a client; bytes beyond the limits are counted too.
    void add(const Address& client, std::size_t bytes) {
        if (bytes == 0) return;
        of_client_[client] += bytes;
        bytes_ += bytes;
    }

    /// Subtracts bytes of an earlier add() for the same client.
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

    /// Returns true if all bodies together exceed their limit.
    [[nodiscard]] bool is_exceeded() const { return bytes_ > most_; }

    /// Returns true if the bodies of one client exceed their limit.
    [[nodiscard]] bool is_exceeded_by(const Address& client) const {
        return bytes_of(client) > most_of_client_;
    }

    /// Returns true if a client takes at least the mean of all clients with bodies.
    [[nodiscard]] bool takes_at_least_mean(const Address& client) const {
        return bytes_of(client) * of_client_.size() >= bytes_;
    }

  private:
    std::size_t most_, most_of_client_;
    std::size_t bytes_ = 0;
    std::map<Address, std::size_t> of_client_;  ///< bytes per client, never 0
};

}  // namespace sporeprint::server
