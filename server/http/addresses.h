// Addresses of clients: who is behind a connection, which proxies are believed, what counts as one
// client.
#pragma once

#include <sys/socket.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "api/http/message.h"

namespace sporeprint::server {

/// An address of the internet; one of IPv4 as ::ffff:a.b.c.d, so that each has one form.
struct Address {
    std::array<std::uint8_t, 16> bytes{};

    bool operator==(const Address&) const = default;
    bool operator<(const Address& other) const { return bytes < other.bytes; }
    [[nodiscard]] bool is_v4() const;
};

/// "192.0.2.1" or "2001:db8::1", without port, brackets or zone; nothing for anything else.
[[nodiscard]] std::optional<Address> address_in(std::string_view text);

/// The address of a socket's other end; :: when it is of no such kind.
[[nodiscard]] Address address_of(const sockaddr_storage& socket);

/// As people write it: "192.0.2.1", "2001:db8::1".
[[nodiscard]] std::string text_of(const Address& address);

/// What counts as one client: an address of IPv4, the /64 of one of IPv6, all of which whoever has
/// one can use.
[[nodiscard]] Address client_of(const Address& address);

/// Networks, "10.0.0.0/8, 2001:db8::/32, 192.0.2.1".
class Networks {
  public:
    Networks() = default;

    /// throws  InvalidInput with every part of the list that is no network, or has bits beyond its
    ///         length
    explicit Networks(std::string_view list);

    [[nodiscard]] bool contain(const Address& address) const;
    [[nodiscard]] bool empty() const { return networks_.empty(); }

  private:
    struct Network {
        Address address;
        int bits = 128;  ///< of the 128
    };
    std::vector<Network> networks_;
};

/// How proxies name those that they speak for.
enum class ProxyHeader { x_forwarded_for, forwarded };

constexpr const char* name(ProxyHeader header) {
    switch (header) {
        case ProxyHeader::x_forwarded_for:
            return "x_forwarded_for";
        case ProxyHeader::forwarded:
            return "forwarded";
    }
    return nullptr;
}

/// Whom the network's proxies speak for.
struct Proxies {
    Networks trusted;
    ProxyHeader header = ProxyHeader::x_forwarded_for;

    /// Who has sent a request: the peer, or when that is a trusted proxy, whom it names; when that
    /// is one too, whom that one names, and so on, from the right. What stands left of the first
    /// that is not trusted is the client's own invention. A name that is no address ("unknown")
    /// leaves the proxy that gave it. Only the one header is looked at: a proxy hands on the other
    /// as the client has made it up.
    ///
    /// cost    O(bytes of the headers); lists are cut at each comma, quoted or not, so that a quote
    ///         which the client leaves open hides nothing that a proxy appends
    /// source  [RFC7239]
    [[nodiscard]] Address behind(const Address& peer, std::span<const api::Header> headers) const;
};

}  // namespace sporeprint::server
