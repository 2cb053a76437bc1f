// Client addresses: parsing, trusted proxies, and the grouping of addresses into clients.
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

/// An IP address. IPv4 addresses are stored as ::ffff:a.b.c.d, so that each address has one form.
struct Address {
    std::array<std::uint8_t, 16> bytes{};

    bool operator==(const Address&) const = default;
    bool operator<(const Address& other) const { return bytes < other.bytes; }
    [[nodiscard]] bool is_v4() const;
};

/// Parses "192.0.2.1" or "2001:db8::1", without port, brackets or zone; nothing for anything else.
[[nodiscard]] std::optional<Address> address_in(std::string_view text);

/// Returns the address in a socket address; :: if it is neither IPv4 nor IPv6.
[[nodiscard]] Address address_of(const sockaddr_storage& socket);

/// Formats an address: "192.0.2.1", "2001:db8::1".
[[nodiscard]] std::string text_of(const Address& address);

/// Returns the key under which an address is limited: an IPv4 address itself, or the /64 network of
/// an IPv6 address, since a client usually controls a whole /64.
[[nodiscard]] Address client_of(const Address& address);

/// A list of CIDR blocks, "10.0.0.0/8, 2001:db8::/32, 192.0.2.1".
class Networks {
  public:
    Networks() = default;

    /// throws  InvalidInput with every element of the list that is not a network or has bits set
    ///         beyond its prefix length
    explicit Networks(std::string_view list);

    /// Returns true if any of the networks contains the address.
    [[nodiscard]] bool contains(const Address& address) const;
    [[nodiscard]] bool empty() const { return networks_.empty(); }

  private:
    struct Network {
        Address address;
        int bits = 128;  ///< prefix length, of 128
    };
    std::vector<Network> networks_;
};

/// The header in which proxies report the address of their client.
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

/// The trusted proxies, as CIDR blocks whose forwarding header is trusted.
struct Proxies {
    Networks trusted;
    ProxyHeader header = ProxyHeader::x_forwarded_for;

    /// Returns the address of the client that sent a request: the peer, or if the peer is a trusted
    /// proxy, the last address in its forwarding header; if that is a trusted proxy too, the
    /// address to its left, and so on. Addresses to the left of the first untrusted one may be
    /// forged by the client and are ignored. An element that is not an address ("unknown") ends the
    /// search at the proxy that wrote it. Only the configured header is read, since a proxy passes
    /// the other one on as the client sent it.
    ///
    /// cost    O(bytes of the headers); lists are split at each comma, quoted or not, so that an
    ///         unclosed quote of the client hides nothing that a proxy appends
    /// source  [RFC7239]
    [[nodiscard]] Address client_address(const Address& peer,
                                         std::span<const api::Header> headers) const;
};

}  // namespace sporeprint::server
