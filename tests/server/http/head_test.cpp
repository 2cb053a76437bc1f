#include "server/http/head.h"

#include <gtest/gtest.h>

#include <random>

namespace sporeprint::server::http_head_test {
namespace {

using State = Scan::State;

std::string with(const std::string& headers) {
    return "POST /a?b=1 HTTP/1.1\r\n" + headers + "\r\n";
}

int status_of(const std::string& bytes) {
    const Scan scan = scan_head(bytes);
    return scan.state == State::refused ? scan.status : scan.state == State::complete ? 200 : 0;
}

TEST(Head, IsReadWithoutDecoding) {
    const Scan scan = scan_head(
        "\r\nGET /x%20y?q=%0d HTTP/1.1\r\nHost: here\r\nX-Odd:\t a%0d%0ab \r\nEmpty:\r\n\r\nrest");
    ASSERT_EQ(scan.state, State::complete);
    EXPECT_EQ(scan.used, std::string("\r\nGET /x%20y?q=%0d HTTP/1.1\r\nHost: here\r\n"
                                     "X-Odd:\t a%0d%0ab \r\nEmpty:\r\n\r\n")
                             .size());
    EXPECT_EQ(scan.head.method, "GET");
    EXPECT_EQ(scan.head.target, "/x%20y?q=%0d");
    ASSERT_EQ(scan.head.headers.size(), 3u);
    EXPECT_EQ(scan.head.headers[1], api::Header("X-Odd", "a%0d%0ab")) << "never percent-decoded";
    EXPECT_EQ(scan.head.headers[2], api::Header("Empty", ""));
    EXPECT_TRUE(scan.head.keep_alive);
    EXPECT_FALSE(scan.head.content_length);
}

TEST(Head, DeterminesWhetherTheConnectionPersists) {
    const auto keeps = [](const std::string& version, const std::string& header) {
        return scan_head("GET / " + version + "\r\n" + header + "\r\n").head.keep_alive;
    };
    EXPECT_TRUE(keeps("HTTP/1.1", ""));
    EXPECT_FALSE(keeps("HTTP/1.1", "connection: Close\r\n"));
    EXPECT_FALSE(keeps("HTTP/1.1", "Connection: upgrade, close\r\n"));
    EXPECT_FALSE(keeps("HTTP/1.0", ""));
    EXPECT_TRUE(keeps("HTTP/1.0", "Connection: Keep-Alive\r\n"));
}

TEST(Head, RefusesAmbiguousFraming) {
    EXPECT_EQ(status_of(with("Content-Length: 5\r\n")), 200);
    EXPECT_EQ(status_of(with("Content-Length: 5\r\nContent-Length: 5\r\n")), 400);
    for (const char* length : {"", "-1", "+5", "5 5", "0x5", "5,5", "1e3", "5\t5"})
        EXPECT_EQ(status_of(with("Content-Length: " + std::string(length) + "\r\n")), 400)
            << length;
    EXPECT_EQ(scan_head(with("Content-Length: 99999999999999999999999\r\n")).head.content_length,
              UINT64_MAX);
    EXPECT_EQ(status_of(with("Transfer-Encoding: chunked\r\n")), 411);
    EXPECT_EQ(status_of(with("Content-Length: 5\r\ntransfer-encoding: identity\r\n")), 411);
    EXPECT_EQ(status_of(with("Content-Encoding: gzip\r\n")), 415);
    EXPECT_EQ(status_of(with("A: b\r\n folded\r\n")), 400);
    EXPECT_EQ(status_of(with("A : b\r\n")), 400);
    EXPECT_EQ(status_of(with("no colon\r\n")), 400);
    EXPECT_EQ(status_of(with(": no name\r\n")), 400);
    EXPECT_EQ(status_of(with(std::string("A: b\0c\r\n", 8))), 400);
    EXPECT_EQ(status_of(with("A: b\rc\r\n")), 400);
    EXPECT_EQ(status_of("GET / HTTP/1.1\nHost: a\n\n"), 400) << "bare line feeds";
    EXPECT_EQ(status_of("\nGET / HTTP/1.1\r\n\r\n"), 400);
}

TEST(Head, RefusesMalformedRequestLines) {
    for (const char* line :
         {"GET", "GET /", "GET  / HTTP/1.1", "GET / HTTP/1.1 x", " GET / HTTP/1.1",
          "G\tT / HTTP/1.1", "GET /\x01 HTTP/1.1", "GET /\xc3\xa9 HTTP/1.1", "GET / http/1.1",
          "GET a HTTP/1.1", "GET ftp://a/ HTTP/1.1", "{} / HTTP/1.1", "GET / XTTP/1.1"})
        EXPECT_EQ(status_of(std::string(line) + "\r\n\r\n"), 400) << line;
    EXPECT_EQ(status_of("BREW / HTTP/1.1\r\n\r\n"), 200) << "any token is a method";
    EXPECT_EQ(status_of(std::string(longest_method, 'A') + " / HTTP/1.1\r\n\r\n"), 200);
    EXPECT_EQ(status_of(std::string(longest_method + 1, 'A') + " / HTTP/1.1\r\n\r\n"), 400);
    EXPECT_EQ(status_of("GET / HTTP/2.0\r\n\r\n"), 400);
    EXPECT_EQ(status_of("GET http://host/path HTTP/1.1\r\n\r\n"), 200);
    EXPECT_EQ(status_of("OPTIONS * HTTP/1.1\r\n\r\n"), 200);
}

TEST(Head, HasLimits) {
    EXPECT_EQ(status_of("GET /" + std::string(longest_uri - 1, 'a') + " HTTP/1.1\r\n\r\n"), 200);
    EXPECT_EQ(status_of("GET /" + std::string(longest_uri, 'a') + " HTTP/1.1\r\n\r\n"), 414);
    EXPECT_EQ(status_of("GET /" + std::string(2 * longest_uri, 'a')), 414)
        << "before the line is complete";
    std::string headers;
    for (std::size_t i = 0; i < most_headers; ++i) headers += "A: b\r\n";
    EXPECT_EQ(status_of(with(headers)), 200);
    EXPECT_EQ(status_of(with(headers + "A: b\r\n")), 431);
    EXPECT_EQ(status_of(with("A: " + std::string(longest_head, 'b') + "\r\n")), 431);
    EXPECT_EQ(status_of("GET / HTTP/1.1\r\nA: " + std::string(longest_head, 'b')), 431);
    EXPECT_EQ(status_of("GET / HTTP/1.1\r\nA: b\r\n"), 0) << "incomplete";
    EXPECT_EQ(status_of(""), 0);
    EXPECT_EQ(status_of("\r\n"), 0);
}

// However a request is split, the result is the same; nothing crashes.
TEST(Head, ScansArbitraryBytesTheSameInParts) {
    std::minstd_rand random(7);
    const std::string good =
        "POST /a?b HTTP/1.1\r\nHost: x\r\nContent-Length: 3\r\nConnection: close\r\n\r\nabc";
    const std::string alphabet = "\r\n :/GETHP1.0azA%\t,;\"\x7f\x80";
    for (int round = 0; round < 3000; ++round) {
        std::string bytes = good;
        for (std::uint32_t edits = random() % 4; edits > 0; --edits) {
            const std::size_t at = random() % bytes.size();
            const char c = alphabet[random() % alphabet.size()];
            if (random() % 2)
                bytes[at] = c;
            else
                bytes.insert(at, 1, c);
        }
        const Scan whole = scan_head(bytes);
        for (std::size_t cut = 0; cut < bytes.size(); ++cut) {
            const Scan part = scan_head(std::string_view(bytes).substr(0, cut));
            if (part.state == State::complete) {
                EXPECT_EQ(whole.state, State::complete) << bytes;
                EXPECT_EQ(whole.used, part.used) << bytes;
            }
            if (part.state == State::refused) {
                EXPECT_EQ(whole.state, State::refused) << bytes << " at " << cut;
            }
        }
    }
}

}  // namespace
}  // namespace sporeprint::server::http_head_test
