#include "server/hot_table.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace sporeprint::server {
namespace {

Sending sending_of(std::size_t body, std::string more = {}) {
    Sending sending;
    sending.answer.repeatable = true;
    sending.answer.body = {slice_of(std::string(body, 'b'))};
    sending.head =
        "HTTP/1.1 200 OK\r\nCache-Control: public\r\nCache-Status: x; hit\r\nContent-Length: " +
        std::to_string(body) +
        "\r\nContent-Location: /a\r\nContent-Type: text/plain\r\nDate: then\r\nETag: \"t\"\r\n"
        "Keep-Alive: timeout=1\r\n" +
        more + "X-Request-Id: theirs\r\n\r\n";
    return sending;
}

Head head_of(std::string method, std::vector<api::Header> headers = {}) {
    Head head;
    head.method = std::move(method);
    head.target = "/a";
    head.headers = std::move(headers);
    return head;
}

TEST(HotAnswer, LacksWhatChangesWithEachRequest) {
    const auto hot = hot_answer("/a?b", sending_of(10), "/a");
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
    EXPECT_TRUE(hot->tells_id);
    EXPECT_EQ(hot->size, 10u);
    const auto large = hot_answer("/a", sending_of(1 << 20), "/a");
    ASSERT_TRUE(large);
    EXPECT_TRUE(large->file >= 0 && large->body.empty()) << "in a file of its own";
    EXPECT_GT(large->weight(), 1u << 20);
}

TEST(HotAnswer, IsNotMadeOfWhatMayDiffer) {
    EXPECT_FALSE(hot_answer("/a", sending_of(10, "Vary: Accept-Encoding\r\n"), ""));
    Sending sending = sending_of(10);
    sending.answer.repeatable = false;
    EXPECT_FALSE(hot_answer("/a", sending, ""));
    sending = sending_of(10);
    sending.answer.status = 404;
    EXPECT_FALSE(hot_answer("/a", sending, ""));
    sending = sending_of(10);
    sending.closing = true;
    EXPECT_FALSE(hot_answer("/a", sending, ""));
}

TEST(HotQuestion, IsSimpleWhenNothingCouldChangeTheAnswer) {
    EXPECT_TRUE(hot_question(head_of("GET")).simple);
    EXPECT_TRUE(hot_question(head_of("HEAD", {{"Host", "x"},
                                              {"Accept-Encoding", "gzip"},
                                              {"Cookie", "a"},
                                              {"Connection", "close"}}))
                    .simple);
    const Head conditional =
        head_of("GET", {{"if-none-match", "\"a\", \"b\""}, {"x-request-id", "7"}});
    const HotQuestion question = hot_question(conditional);
    EXPECT_TRUE(question.simple);
    EXPECT_EQ(question.if_none_match, "\"a\", \"b\"");
    EXPECT_EQ(question.id, "7");
    for (const char* name : {"Range", "If-Match", "If-Modified-Since", "if-unmodified-since",
                             "If-Range", "If-", "Cache-Control", "Pragma", "Expect"})
        EXPECT_FALSE(hot_question(head_of("GET", {{name, "x"}})).simple) << name;
    EXPECT_FALSE(
        hot_question(head_of("GET", {{"If-None-Match", "a"}, {"If-None-Match", "b"}})).simple);
    EXPECT_FALSE(hot_question(head_of("POST")).simple);
    Head with_body = head_of("GET");
    with_body.content_length = 1;
    EXPECT_FALSE(hot_question(with_body).simple);
}

TEST(HotTable, KeepsWithinItsBudgetAndGivesOnlyWhatItWasGiven) {
    constexpr std::size_t budget = 200'000;
    HotTable table(budget);
    std::mt19937 random(3);
    std::map<std::string, std::shared_ptr<const HotAnswer>> given;
    std::size_t found = 0;
    for (int step = 0; step < 5000; ++step) {
        const std::string target = "/" + std::to_string(random() % 100);
        if (const auto* answer = table.find(target)) {
            ++found;
            EXPECT_EQ(*answer, given[target]);
            EXPECT_EQ((*answer)->target, target);
        } else {
            given[target] = hot_answer(target, sending_of(random() % 30'000), "");
            table.insert(given[target]);
        }
        EXPECT_LE(table.stats().bytes, budget);
    }
    EXPECT_GT(found, 500u);
    EXPECT_GT(table.stats().evictions, 100u);
    EXPECT_GE(table.stats().entries, 4u);
}

TEST(HotTable, KeepsWhatIsAskedForBesideAStreamOfOthers) {
    HotTable table(100'000);
    table.insert(hot_answer("/popular", sending_of(5000), ""));
    table.pin(hot_answer("/livez", sending_of(5), ""));
    std::size_t missing = 0;
    for (int i = 0; i < 2000; ++i) {
        if (!table.find("/popular")) ++missing;
        EXPECT_TRUE(table.find("/livez"));
        table.insert(hot_answer("/once/" + std::to_string(i), sending_of(5000), ""));
    }
    EXPECT_EQ(missing, 2000u / 256) << "only when the caches behind are to hear of it";
    HotTable none(0);
    none.insert(hot_answer("/a", sending_of(10), ""));
    EXPECT_FALSE(none.find("/a"));
}

}  // namespace
}  // namespace sporeprint::server
