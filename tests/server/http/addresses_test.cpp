#include "server/http/addresses.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/problems.h"

namespace sporeprint::server::http_addresses_test {
namespace {

const std::string xff = "X-Forwarded-For", fwd = "Forwarded";

std::string client_address(const std::string& peer, const std::vector<api::Header>& headers,
                           ProxyHeader header = ProxyHeader::x_forwarded_for,
                           const std::string& trusted = "10.0.0.0/8, 2001:db8:f::/48") {
    const Proxies proxies{Networks(trusted), header};
    return text_of(proxies.client_address(address_in(peer).value(), headers));
}

rc::Gen<Address> any_address() {
    return rc::gen::map(
        rc::gen::container<std::vector<std::uint8_t>>(16, rc::gen::arbitrary<std::uint8_t>()),
        [](const std::vector<std::uint8_t>& bytes) {
            Address address;
            std::copy(bytes.begin(), bytes.end(), address.bytes.begin());
            if (bytes[0] % 2 == 0)
                address = address_in("::ffff:1.2.3.4").value(),
                std::copy(bytes.begin() + 12, bytes.end(), address.bytes.begin() + 12);
            return address;
        });
}

TEST(Addresses, HaveOneFormEach) {
    EXPECT_EQ(address_in("::ffff:192.0.2.1"), address_in("192.0.2.1"));
    EXPECT_EQ(text_of(*address_in("::ffff:c000:201")), "192.0.2.1");
    EXPECT_EQ(text_of(*address_in("2001:DB8:0::1")), "2001:db8::1");
    for (const char* none :
         {"", " ", "1.2.3", "1.2.3.4.5", "1.2.3.256", "01.2.3.4", "1.2.3.4 ", "0x1.2.3.4", "1",
          "[::1]", "::1%eth0", "1.2.3.4:80", ":::", "12345::", "unknown", "localhost", "1.2.3.4\n",
          "0000:0000:0000:0000:0000:0000:0000:0000:0000:0000:0000:0000:0000"})
        EXPECT_FALSE(address_in(none)) << none;
    EXPECT_FALSE(address_in(std::string_view("1.2.3.4\0x", 9)));
}

RC_GTEST_PROP(Addresses, RoundTripThroughText, ()) {
    const Address address = *any_address();
    RC_ASSERT(address_in(text_of(address)) == address);
    RC_ASSERT(client_of(client_of(address)) == client_of(address));
    RC_ASSERT(!address.is_v4() || client_of(address) == address);
}

RC_GTEST_PROP(Addresses, OfOneSubnetAreOneClient, ()) {
    const Address a = *any_address(), b = *any_address();
    RC_PRE(!a.is_v4() && !b.is_v4());
    Address of_a = b;
    std::copy(a.bytes.begin(), a.bytes.begin() + 8, of_a.bytes.begin());
    RC_PRE(!of_a.is_v4());
    RC_ASSERT(client_of(of_a) == client_of(a));
    const bool same = std::equal(a.bytes.begin(), a.bytes.begin() + 8, b.bytes.begin());
    RC_ASSERT((client_of(a) == client_of(b)) == same);
}

/// Compares bit by bit with the definition.
RC_GTEST_PROP(Networks, ContainAddressesWithTheirPrefix, ()) {
    const Address address = *any_address(), other = *any_address();
    const int most = address.is_v4() ? 32 : 128, first = 128 - most;
    const int length = *rc::gen::inRange(0, most + 1);
    const auto bit = [](const Address& of, int at) {
        return (of.bytes[static_cast<std::size_t>(at / 8)] >> (7 - at % 8)) & 1;
    };
    Address network = address, near = other;
    for (int i = 0; i < 128; ++i) {
        const auto mask = static_cast<std::uint8_t>(1 << (7 - i % 8));
        auto& zeroed = network.bytes[static_cast<std::size_t>(i / 8)];
        auto& begun = near.bytes[static_cast<std::size_t>(i / 8)];
        if (i >= first + length) zeroed &= static_cast<std::uint8_t>(~mask);
        if (i < first + length - *rc::gen::inRange(0, 2))
            begun = static_cast<std::uint8_t>((begun & ~mask) | (bit(address, i) ? mask : 0));
    }
    const Networks networks(text_of(network) + '/' + std::to_string(length));
    for (const Address& one : {address, other, near}) {
        bool same = true;
        for (int i = 0; i < first + length; ++i) same = same && bit(one, i) == bit(network, i);
        RC_ASSERT(networks.contains(one) == same);
    }
}

TEST(Networks, AreRefusedByName) {
    for (const char* bad : {"10.0.0.1/8", "10.0.0.0/33", "10.0.0.0/-1", "10.0.0.0/", "10.0.0.0/8x",
                            "10.0.0.0/8/8", "::/129", "2001:db8::1/64", "proxy.example", "/8", "10",
                            "10.0.0.0/8,,::1", "10.0.0.0/8;::1"})
        EXPECT_THROW(Networks{bad}, InvalidInput) << bad;
    try {
        Networks("1.2.3.4/40, ::1, nonsense");
        FAIL();
    } catch (const InvalidInput& invalid) {
        ASSERT_EQ(invalid.problems().size(), 2u) << "all at once";
        EXPECT_TRUE(invalid.problems()[0].message.starts_with("'nonsense' is not a network"));
        EXPECT_EQ(invalid.problems()[1].message, "'1.2.3.4/40' has a length outside 0..32");
    }
    EXPECT_TRUE(Networks("").empty());
    EXPECT_FALSE(Networks("").contains(*address_in("127.0.0.1")));
    EXPECT_TRUE(Networks("0.0.0.0/0").contains(*address_in("9.9.9.9")));
    EXPECT_FALSE(Networks("0.0.0.0/0").contains(*address_in("2001:db8::1")));
}

TEST(Proxies, AreReadFromTheRightAsFarAsTheyAreTrusted) {
    EXPECT_EQ(client_address("192.0.2.1", {{xff, "10.0.0.9"}}), "192.0.2.1") << "an untrusted peer";
    EXPECT_EQ(client_address("10.0.0.1", {}), "10.0.0.1");
    EXPECT_EQ(client_address("10.0.0.1", {{xff, "203.0.113.7"}}), "203.0.113.7");
    EXPECT_EQ(client_address("10.0.0.1", {{xff, "127.0.0.1, 8.8.8.8, 203.0.113.7"}}),
              "203.0.113.7");
    EXPECT_EQ(client_address("10.0.0.1", {{xff, "8.8.8.8, 203.0.113.7,10.2.3.4 ,\t10.9.9.9"}}),
              "203.0.113.7");
    EXPECT_EQ(client_address("10.0.0.1", {{xff, "8.8.8.8"}, {"x-forwarded-FOR", "203.0.113.7"}}),
              "203.0.113.7")
        << "the last line was added last";
    EXPECT_EQ(client_address("10.0.0.1", {{xff, "203.0.113.7, 10.1.1.1"}, {xff, "10.2.2.2"}}),
              "203.0.113.7");
    EXPECT_EQ(client_address("10.0.0.1", {{xff, "10.1.1.1, 10.2.2.2"}}), "10.1.1.1")
        << "all are proxies";
    EXPECT_EQ(client_address("2001:db8:f::1", {{xff, "2001:db8::7"}}), "2001:db8::7");
    EXPECT_EQ(client_address("10.0.0.1", {{xff, "[2001:db8::7]:4711"}}), "2001:db8::7");
    EXPECT_EQ(client_address("10.0.0.1", {{xff, "203.0.113.7:4711"}}), "203.0.113.7");
    EXPECT_EQ(client_address("10.0.0.1", {{xff, "::ffff:203.0.113.7"}}), "203.0.113.7");
    EXPECT_EQ(client_address("10.0.0.1", {{xff, "203.0.113.7,, ,"}}), "203.0.113.7")
        << "empty elements";
    EXPECT_EQ(client_address("10.0.0.1", {{fwd, "for=203.0.113.7"}}), "10.0.0.1")
        << "the other header";
    for (const char* nonsense :
         {"unknown", "_hidden", "1.2.3.4:99999999", "[1.2.3.4]", "[::1", "::1]",
          "1.2.3.4:", "1.2.3.4 5.6.7.8", "for=1.2.3.4", "\"1.2.3.4\"", "%31.2.3.4", "10.0.0.0/8"}) {
        EXPECT_EQ(client_address("10.0.0.1", {{xff, nonsense}}), "10.0.0.1") << nonsense;
        EXPECT_EQ(
            client_address("10.0.0.1", {{xff, "9.9.9.9, " + std::string(nonsense) + ", 10.3.3.3"}}),
            "10.3.3.3")
            << nonsense << ": the proxy that passed it on";
    }
}

TEST(Proxies, WithForwardedAreReadByThatHeaderOnly) {
    const auto of = [](const std::string& value) {
        return client_address("10.0.0.1", {{fwd, value}, {xff, "6.6.6.6"}}, ProxyHeader::forwarded);
    };
    EXPECT_EQ(of("for=192.0.2.60;proto=http;by=203.0.113.43"), "192.0.2.60");
    EXPECT_EQ(of("by=9.9.9.9; FOR=\"[2001:db8:cafe::17]:4711\""), "2001:db8:cafe::17");
    EXPECT_EQ(of("for=6.6.6.6, for=192.0.2.60, for=10.1.1.1"), "192.0.2.60");
    EXPECT_EQ(of("for=\"6.6.6.6, for=192.0.2.60"), "192.0.2.60") << "an open quote hides nothing";
    EXPECT_EQ(of("for=\"6.6.6.6;x=\\\", for=192.0.2.60"), "192.0.2.60");
    for (const char* nonsense : {"for=unknown", "for=_x", "by=192.0.2.60", "for", "for=", "=",
                                 "for =192.0.2.60", "192.0.2.60", "for=\"192.0.2.60"})
        EXPECT_EQ(of(nonsense), "10.0.0.1") << nonsense;
}

/// Whatever a client sends, only the parts appended by trusted proxies determine the result.
RC_GTEST_PROP(Proxies, IgnoreForgedElements, ()) {
    const std::string alphabet = "0123456789.:[]\"\\,;= \tfor_abx";
    const auto invented = *rc::gen::container<std::string>(rc::gen::elementOf(alphabet));
    const Address client = *any_address();
    const Networks trusted("10.0.0.0/8, 2001:db8:f::/48");
    RC_PRE(!trusted.contains(client));
    const bool plain = *rc::gen::arbitrary<bool>(), own_line = *rc::gen::arbitrary<bool>();
    const int hops = *rc::gen::inRange(0, 4);
    std::string added = text_of(client);
    if (!plain) added = "for=\"" + (client.is_v4() ? added : '[' + added + ']') + '"';
    for (int i = 0; i < hops; ++i)
        added += std::string(", ") + (plain ? "" : "for=") + "10.0.0." + std::to_string(i);
    const std::string& name = plain ? xff : fwd;
    std::vector<api::Header> headers = {{name, invented}};
    if (own_line)
        headers.emplace_back(name, added);
    else
        headers[0].second += "," + added;
    headers.emplace_back(plain ? fwd : xff, invented);
    const Proxies proxies{trusted, plain ? ProxyHeader::x_forwarded_for : ProxyHeader::forwarded};
    RC_ASSERT(proxies.client_address(*address_in("10.9.9.9"), headers) == client);
    RC_ASSERT(proxies.client_address(client, headers) == client);
}

}  // namespace
}  // namespace sporeprint::server::http_addresses_test
