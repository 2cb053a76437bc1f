#include "server/http/hot_table.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace sporeprint::server::http_hot_table_test {
namespace {

Sending sending_of(std::size_t body, std::string more = {}) {
    Sending sending;
    sending.response.cacheable = true;
    sending.response.body = {slice_of(std::string(body, 'b'))};
    sending.head =
        "HTTP/1.1 200 OK\r\nCache-Control: public\r\nCache-Status: x; hit\r\nContent-Length: " +
        std::to_string(body) +
        "\r\nContent-Location: /a\r\nContent-Type: text/plain\r\nDate: then\r\nETag: \"t\"\r\n"
        "Keep-Alive: timeout=1\r\n" +
        more + "X-Request-Id: theirs\r\n\r\n";
    return sending;
}

std::shared_ptr<const HotResponse> gzip_of(const std::string& target, std::size_t size) {
    Sending sending = sending_of(size, "Content-Encoding: gzip\r\nVary: Accept-Encoding\r\n");
    sending.head.replace(sending.head.find("\"t\""), 3, "\"t-gz\"");
    return hot_response(target, sending, "");
}

Head head_of(std::string method, std::vector<api::Header> headers = {}) {
    Head head;
    head.method = std::move(method);
    head.target = "/a";
    head.headers = std::move(headers);
    return head;
}

TEST(HotResponse, LacksHeadersThatDifferPerRequest) {
    const auto hot = hot_response("/a?b", sending_of(10), "/a");
    ASSERT_TRUE(hot);
    EXPECT_EQ(hot->head,
              "HTTP/1.1 200 OK\r\nCache-Control: public\r\nCache-Status: x; hit\r\n"
              "Content-Length: 10\r\nContent-Location: /a\r\nContent-Type: text/plain\r\n"
              "ETag: \"t\"\r\n");
    EXPECT_EQ(hot->not_modified,
              "HTTP/1.1 304 Not Modified\r\nCache-Control: public\r\n"
              "Cache-Status: x; hit; detail=not-modified\r\nContent-Location: /a\r\n"
              "ETag: \"t\"\r\n");
    EXPECT_EQ(hot->keep_alive, "Keep-Alive: timeout=1\r\n");
    EXPECT_EQ(hot->etag, "\"t\"");
    EXPECT_TRUE(hot->has_request_id);
    EXPECT_EQ(hot->size, 10u);
    const auto large = hot_response("/a", sending_of(1 << 20), "/a");
    ASSERT_TRUE(large);
    EXPECT_TRUE(large->file >= 0 && large->body.empty()) << "in an in-memory file";
    EXPECT_GT(large->weight(), 1u << 20);
}

TEST(HotResponse, IsNotMadeOfUncacheableResponses) {
    EXPECT_FALSE(hot_response("/a", sending_of(10, "Vary: Cookie\r\n"), ""));
    EXPECT_FALSE(hot_response("/a", sending_of(10, "Vary: Accept-Encoding, Origin\r\n"), ""));
    Sending sending = sending_of(10);
    sending.response.cacheable = false;
    EXPECT_FALSE(hot_response("/a", sending, ""));
    sending = sending_of(10);
    sending.response.status = 404;
    EXPECT_FALSE(hot_response("/a", sending, ""));
    sending = sending_of(10);
    sending.closing = true;
    EXPECT_FALSE(hot_response("/a", sending, ""));
}

TEST(HotResponse, HasTheCodingOfItsResponse) {
    EXPECT_EQ(hot_response("/a", sending_of(10), "")->coding, Coding::any);
    const auto identity = hot_response("/a", sending_of(10, "Vary: Accept-Encoding\r\n"), "");
    ASSERT_TRUE(identity);
    EXPECT_EQ(identity->coding, Coding::identity);
    EXPECT_NE(identity->not_modified.find("Vary: Accept-Encoding\r\n"), std::string::npos);
    const auto gzip = gzip_of("/a", 10);
    ASSERT_TRUE(gzip);
    EXPECT_EQ(gzip->coding, Coding::gzip);
    EXPECT_EQ(gzip->etag, "\"t-gz\"");
    EXPECT_EQ(gzip->identity_etag, "\"t\"");
    EXPECT_NE(gzip->head.find("Content-Encoding: gzip\r\n"), std::string::npos);
    EXPECT_EQ(gzip->not_modified.find("Content-Encoding"), std::string::npos);
}

TEST(HotLookup, IsSimpleWithoutHeadersThatAffectTheResponse) {
    EXPECT_TRUE(hot_lookup(head_of("GET")).simple);
    EXPECT_TRUE(hot_lookup(head_of("HEAD", {{"Host", "x"},
                                            {"Accept-Encoding", "gzip"},
                                            {"Cookie", "a"},
                                            {"Connection", "close"}}))
                    .simple);
    const Head conditional =
        head_of("GET", {{"if-none-match", "\"a\", \"b\""}, {"x-request-id", "7"}});
    const HotLookup lookup = hot_lookup(conditional);
    EXPECT_TRUE(lookup.simple);
    EXPECT_EQ(lookup.if_none_match(), "\"a\", \"b\"");
    EXPECT_EQ(lookup.id, "7");
    for (const char* name : {"Range", "If-Match", "If-Modified-Since", "if-unmodified-since",
                             "If-Range", "If-", "Cache-Control", "Pragma", "Expect"})
        EXPECT_FALSE(hot_lookup(head_of("GET", {{name, "x"}})).simple) << name;
    const Head lines = head_of(
        "GET", {{"If-None-Match", "\"a\""}, {"If-None-Match", "\"b\""}, {"if-none-match", "*"}});
    EXPECT_TRUE(hot_lookup(lines).simple);
    EXPECT_EQ(hot_lookup(lines).if_none_match(), "\"a\", \"b\", *");
    EXPECT_EQ(hot_lookup(head_of("GET")).if_none_match(), "");
    const Head accepting = head_of("GET", {{"Accept-Encoding", "gzip, br"}});
    EXPECT_EQ(hot_lookup(accepting).accept_encoding, "gzip, br");
    EXPECT_FALSE(
        hot_lookup(head_of("GET", {{"Accept-Encoding", "br"}, {"accept-encoding", "gzip"}})).simple)
        << "all lines form one list";
    EXPECT_FALSE(hot_lookup(head_of("POST")).simple);
    Head with_body = head_of("GET");
    with_body.content_length = 1;
    EXPECT_FALSE(hot_lookup(with_body).simple);
}

TEST(HotTable, StaysWithinItsBudgetAndReturnsWhatWasInserted) {
    constexpr std::size_t budget = 200'000;
    HotTable table(budget);
    std::mt19937 random(3);
    std::map<std::string, std::shared_ptr<const HotResponse>> given;
    std::size_t found = 0;
    for (int step = 0; step < 5000; ++step) {
        const std::string target = "/" + std::to_string(random() % 60);
        // A fifth of the requests has targets that vary by encoding.
        const bool varies = random() % 5 == 0, gzip = random() % 2 == 0;
        const std::string key = varies ? target + (gzip ? "-gzip" : "-identity") : target;
        const std::string requested = varies ? target + "-varies" : target;
        if (const auto* response = table.find(requested, gzip ? "gzip" : "")) {
            ++found;
            EXPECT_EQ(*response, given[key]);
            EXPECT_EQ((*response)->target, requested);
        } else {
            const std::size_t size = random() % 30'000;
            given[key] =
                varies && gzip
                    ? gzip_of(requested, size)
                    : hot_response(requested,
                                   sending_of(size, varies ? "Vary: Accept-Encoding\r\n" : ""), "");
            table.insert(given[key]);
        }
        EXPECT_LE(table.stats().bytes, budget);
    }
    EXPECT_GT(found, 500u);
    EXPECT_GT(table.stats().evictions, 100u);
    EXPECT_GE(table.stats().entries, 4u);
}

TEST(HotTable, HasOneResponsePerEncoding) {
    HotTable table(100'000);
    const auto any = hot_response("/any", sending_of(10), "");
    table.insert(any);
    for (const char* accepted : {"", "gzip", "br"}) {
        ASSERT_TRUE(table.find("/any", accepted));
        EXPECT_EQ(*table.find("/any", accepted), any);
    }
    const auto identity_of = [](const std::string& target) {
        return hot_response(target, sending_of(10, "Vary: Accept-Encoding\r\n"), "");
    };
    for (const bool identity_first : {true, false}) {
        const std::string target = identity_first ? "/a" : "/b";
        const auto identity = identity_of(target), gzip = gzip_of(target, 10);
        table.insert(identity_first ? identity : gzip);
        EXPECT_FALSE(table.find(target, identity_first ? "gzip" : ""));
        table.insert(identity_first ? gzip : identity);
        for (const char* refusing : {"", "br", "gzip;q=0"}) {
            ASSERT_TRUE(table.find(target, refusing)) << refusing;
            EXPECT_EQ(*table.find(target, refusing), identity);
        }
        ASSERT_TRUE(table.find(target, "br, gzip"));
        EXPECT_EQ(*table.find(target, "br, gzip"), gzip);
        EXPECT_FALSE(table.is_pinned(target));
    }
    EXPECT_EQ(table.stats().entries, 5u);
    const auto again = gzip_of("/a", 20);
    table.insert(again);
    EXPECT_EQ(*table.find("/a", "gzip"), again);
    EXPECT_TRUE(table.find("/a"))
        << "the other variant stays, although the key pointed into the removed one";
    EXPECT_EQ(table.stats().entries, 5u);
    table.insert(hot_response("/a", sending_of(30), ""));
    EXPECT_EQ(*table.find("/a"), *table.find("/a", "gzip")) << "one for all replaces both variants";
    EXPECT_EQ(table.stats().entries, 4u);
    table.clear();
    EXPECT_EQ(table.stats().entries, 0u);
    EXPECT_EQ(table.stats().bytes, 0u);
    EXPECT_FALSE(table.find("/a"));
}

TEST(HotTable, RetainsAHotEntryInAScan) {
    HotTable table(100'000);
    table.insert(hot_response("/popular", sending_of(5000), ""));
    table.insert_pinned(hot_response("/livez", sending_of(5), ""));
    std::size_t missing = 0;
    for (int i = 0; i < 2000; ++i) {
        if (!table.find("/popular")) ++missing;
        EXPECT_TRUE(table.find("/livez"));
        table.insert(hot_response("/once/" + std::to_string(i), sending_of(5000), ""));
    }
    EXPECT_EQ(missing, 2000u / 256) << "only every 256th lookup, for the caches of the service";
    HotTable none(0);
    none.insert(hot_response("/a", sending_of(10), ""));
    EXPECT_FALSE(none.find("/a"));
}

}  // namespace
}  // namespace sporeprint::server::http_hot_table_test
