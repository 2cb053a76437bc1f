#include "server/http/addresses.h"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <algorithm>
#include <charconv>
#include <cstring>

#include "core/params/messages.h"
#include "core/problems.h"
#include "server/http/head.h"

namespace sporeprint::server {

namespace {

constexpr std::array<std::uint8_t, 12> v4_prefix = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff};

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
}

bool is_port(std::string_view text) {
    return !text.empty() && text.size() <= 5 &&
           std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Parses an address as proxies write it: perhaps with brackets and a port.
std::optional<Address> node_in(std::string_view text) {
    if (text.starts_with('[')) {
        const std::size_t end = text.find(']');
        if (end == std::string_view::npos) return std::nullopt;
        const std::string_view rest = text.substr(end + 1);
        if (!rest.empty() && (rest[0] != ':' || !is_port(rest.substr(1)))) return std::nullopt;
        const std::optional<Address> found = address_in(text.substr(1, end - 1));
        return found && !found->is_v4() ? found : std::nullopt;
    }
    const std::size_t colon = text.find(':');
    const bool has_port = colon != std::string_view::npos && text.rfind(':') == colon;
    if (has_port && !is_port(text.substr(colon + 1))) return std::nullopt;
    return address_in(has_port ? text.substr(0, colon) : text);
}

/// Removes the last element of `list` and the separator before it, and returns the element.
std::string_view take_last(std::string_view& list, char separator) {
    const std::size_t at = list.rfind(separator);
    const std::string_view last = at == std::string_view::npos ? list : list.substr(at + 1);
    list = at == std::string_view::npos ? std::string_view() : list.substr(0, at);
    return trimmed(last);
}

/// Returns the node of the `for` parameter of one Forwarded element; empty if there is none.
std::string_view forwarded_for(std::string_view element) {
    while (!element.empty()) {
        const std::string_view pair = take_last(element, ';');
        const std::size_t equals = pair.find('=');
        if (equals == std::string_view::npos || !same_token(pair.substr(0, equals), "for"))
            continue;
        std::string_view node = pair.substr(equals + 1);
        if (node.size() >= 2 && node.front() == '"' && node.back() == '"')
            node = node.substr(1, node.size() - 2);
        return node;
    }
    return {};
}

}  // namespace

bool Address::is_v4() const {
    return std::equal(v4_prefix.begin(), v4_prefix.end(), bytes.begin());
}

std::optional<Address> address_in(std::string_view text) {
    std::array<char, INET6_ADDRSTRLEN> terminated{};
    if (text.size() >= terminated.size() || text.find('\0') != std::string_view::npos)
        return std::nullopt;
    std::copy(text.begin(), text.end(), terminated.begin());
    Address address;
    if (inet_pton(AF_INET6, terminated.data(), address.bytes.data()) == 1) return address;
    std::copy(v4_prefix.begin(), v4_prefix.end(), address.bytes.begin());
    if (inet_pton(AF_INET, terminated.data(), address.bytes.data() + v4_prefix.size()) == 1)
        return address;
    return std::nullopt;
}

Address address_of(const sockaddr_storage& socket) {
    Address address;
    if (socket.ss_family == AF_INET6) {
        std::memcpy(address.bytes.data(), &reinterpret_cast<const sockaddr_in6&>(socket).sin6_addr,
                    16);
    } else if (socket.ss_family == AF_INET) {
        std::copy(v4_prefix.begin(), v4_prefix.end(), address.bytes.begin());
        std::memcpy(address.bytes.data() + v4_prefix.size(),
                    &reinterpret_cast<const sockaddr_in&>(socket).sin_addr, 4);
    }
    return address;
}

std::string text_of(const Address& address) {
    std::array<char, INET6_ADDRSTRLEN> text{};
    const bool v4 = address.is_v4();
    const std::uint8_t* const bytes = address.bytes.data() + (v4 ? v4_prefix.size() : 0);
    return inet_ntop(v4 ? AF_INET : AF_INET6, bytes, text.data(), text.size()) ? text.data() : "";
}

Address client_of(const Address& address) {
    if (address.is_v4()) return address;
    Address client = address;
    std::fill(client.bytes.begin() + 8, client.bytes.end(), std::uint8_t{0});
    return client;
}

Networks::Networks(std::string_view list) {
    std::vector<Problem> problems;
    const auto wrong = [&](std::string_view part, const char* why) {
        report(problems, "", in_quotes(part) + why);
    };
    while (!list.empty()) {
        const std::string_view part = take_last(list, ',');
        const std::size_t slash = part.find('/');
        const std::optional<Address> address = address_in(part.substr(0, slash));
        if (!address) {
            wrong(part, " is not a network; allowed are 10.0.0.0/8, 2001:db8::/32, 192.0.2.1");
            continue;
        }
        const int most = address->is_v4() ? 32 : 128;
        int length = most;
        if (slash != std::string_view::npos) {
            const std::string_view digits = part.substr(slash + 1);
            const auto [end, error] =
                std::from_chars(digits.data(), digits.data() + digits.size(), length);
            if (error != std::errc() || end != digits.data() + digits.size() || length < 0 ||
                length > most) {
                wrong(part,
                      most == 32 ? " has a length outside 0..32" : " has a length outside 0..128");
                continue;
            }
        }
        Network network{*address, 128 - most + length};
        bool beyond = false;
        for (int bit = network.bits; bit < 128; ++bit)
            beyond =
                beyond ||
                ((address->bytes[static_cast<std::size_t>(bit / 8)] >> (7 - bit % 8)) & 1) != 0;
        if (beyond)
            wrong(part, " has bits beyond its length; a network is written with zeros there");
        else
            networks_.push_back(network);
    }
    if (!problems.empty()) throw InvalidInput(std::move(problems));
}

bool Networks::contains(const Address& address) const {
    return std::any_of(networks_.begin(), networks_.end(), [&](const Network& network) {
        const auto whole = static_cast<std::ptrdiff_t>(network.bits / 8);
        if (!std::equal(address.bytes.begin(), address.bytes.begin() + whole,
                        network.address.bytes.begin()))
            return false;
        if (network.bits % 8 == 0) return true;
        const auto at = static_cast<std::size_t>(whole);
        return ((address.bytes[at] ^ network.address.bytes[at]) >> (8 - network.bits % 8)) == 0;
    });
}

Address Proxies::client_address(const Address& peer, std::span<const api::Header> headers) const {
    Address known = peer;
    const bool plain = header == ProxyHeader::x_forwarded_for;
    for (std::size_t i = headers.size(); i-- > 0;) {
        if (!same_token(headers[i].first, plain ? "X-Forwarded-For" : "Forwarded")) continue;
        std::string_view list = headers[i].second;
        while (!list.empty()) {
            if (!trusted.contains(known)) return known;
            const std::string_view element = take_last(list, ',');
            if (element.empty()) continue;
            const std::optional<Address> named = node_in(plain ? element : forwarded_for(element));
            if (!named) return known;
            known = *named;
        }
    }
    return known;
}

}  // namespace sporeprint::server
