#include "server/operations/log.h"

#include <gtest/gtest.h>

#include "api/products/photos.h"

namespace sporeprint::server::operations_log_test {
namespace {

TEST(Log, WritesOneLinePerRequestForAnyBytes) {
    Served served;
    served.method = "GET";
    served.target = "/a\r\n{\"level\":\"error\"}\x1b[31m\"\\{}%s\xff\xfe\x7f";
    served.id = "abc";
    served.status = 404;
    served.bytes = 17;
    served.milliseconds = 1.23456;
    served.cache = "x; hit";
    std::string forged(1000, 'a');
    served.peer = forged;

    testing::internal::CaptureStderr();
    {
        Log log(LogLevel::info);
        log.request(served);
        log.event(LogLevel::warning, "line\nbreak", {{"k", Value("\x01")}});
        log.event(LogLevel::debug, "too quiet");
        Served health;
        health.target = "/livez?x";
        health.status = 200;
        log.request(health);
    }
    const std::string text = testing::internal::GetCapturedStderr();
    std::vector<std::string> lines;
    for (std::size_t at = 0, end; (end = text.find('\n', at)) != std::string::npos; at = end + 1)
        lines.push_back(text.substr(at, end - at));
    ASSERT_EQ(lines.size(), 2u) << text;
    for (const std::string& line : lines) {
        std::vector<Problem> problems;
        const Value value = parse(line, problems);
        EXPECT_TRUE(problems.empty()) << line;
        EXPECT_TRUE(value.find("time") && value.find("level"));
        for (const char c : line) EXPECT_GE(static_cast<unsigned char>(c), 0x20) << line;
    }
    std::vector<Problem> ignored;
    const Value request = parse(lines[0], ignored);
    EXPECT_EQ(request.find("status")->as_number(), 404);
    EXPECT_EQ(request.find("ms")->as_number(), 1.235);
    EXPECT_EQ(request.find("cache")->as_string(), "x; hit");
    EXPECT_TRUE(request.find("target")->as_string().starts_with("/a\r\n{"));
}

TEST(Log, LimitsARepeatedWarningAndCountsIt) {
    using Clock = RepeatedWarning::Clock;
    const Clock::time_point start = Clock::now();
    testing::internal::CaptureStderr();
    {
        Log log(LogLevel::info);
        RepeatedWarning warning(log, "no room", std::chrono::seconds(60));
        for (int second = 0; second < 130; ++second)
            warning({{"at", Value(second)}}, start + std::chrono::seconds(second));
    }
    const std::string text = testing::internal::GetCapturedStderr();
    for (const char* line : {"\"level\":\"warning\",\"message\":\"no room\",\"at\":0,\"times\":1}",
                             "\"at\":60,\"times\":60}", "\"at\":120,\"times\":60}"})
        EXPECT_NE(text.find(line), std::string::npos) << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3) << text;
}

TEST(Log, RedactsSignatures) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"/a", "/a"},
        {"/sig=1", "/sig=1"},
        {"/a?", "/a?"},
        {"/a?sig", "/a?sig"},
        {"/a?x=1&key=k1&expires=9&sig=AbC_-1", "/a?x=1&key=k1&expires=9&sig=[redacted]"},
        {"/a?sig=AbC&x=1&sig=DeF", "/a?sig=[redacted]&x=1&sig=[redacted]"},
        {"/a?sig=a=b?c", "/a?sig=[redacted]?c"},
        {"/a?Sig=AbC;SIG=x#sig=y", "/a?Sig=[redacted];SIG=[redacted]#sig=[redacted]"},
        {"/a?%73i%67=AbC&s%49g=AbC", "/a?%73i%67=[redacted]&s%49g=[redacted]"},
        {"/a?design=1&sigma=2&si=3&%zzsig=4&sig%=5", "/a?design=1&sigma=2&si=3&%zzsig=4&sig%=5"},
        {"http://h/a?sig=AbC", "http://h/a?sig=[redacted]"}};
    testing::internal::CaptureStderr();
    {
        Log log(LogLevel::info);
        for (const auto& [target, shown] : cases) {
            Served served;
            served.target = target;
            log.request(served);
        }
    }
    const std::string text = testing::internal::GetCapturedStderr();
    EXPECT_EQ(text.find("AbC"), std::string::npos) << text;
    for (const auto& [target, shown] : cases) {
        EXPECT_EQ(redacted(target), shown);
        EXPECT_NE(text.find("\"target\":\"" + shown + '"'), std::string::npos) << text;
    }
}

TEST(Log, NeverHasTheNameOfAPhotograph) {
    testing::internal::CaptureStderr();
    {
        Log log(LogLevel::info);
        Served served;
        served.target = "/v1/photos/T3UJ47QBlBLrfrujPzBREA.jpg";
        served.label = api::photo_pattern;
        log.request(served);
    }
    const std::string text = testing::internal::GetCapturedStderr();
    EXPECT_EQ(text.find("T3UJ47"), std::string::npos) << text;
    EXPECT_NE(text.find("/v1/photos/{photo}.jpg"), std::string::npos) << text;
}

TEST(Log, DoesNotHaveTheKeysOfShares) {
    Served served;
    served.method = "GET";
    served.label = "/v1/library/{species}";
    served.target = "/v1/library/~kaja.red_bolete?sh%61re=sps_abcdefgh_secret";
    testing::internal::CaptureStderr();
    {
        Log log(LogLevel::info);
        log.request(served);
    }
    const std::string text = testing::internal::GetCapturedStderr();
    EXPECT_NE(text.find("/v1/library/~kaja.red_bolete\""), std::string::npos) << text;
    EXPECT_EQ(text.find("secret"), std::string::npos) << text;

    served.label = "";
    served.target = "/v1/tokens/spk_abcdefgh_secret-Of_it/x?share=sps_abcdefgh_secret";
    testing::internal::CaptureStderr();
    {
        Log log(LogLevel::info);
        log.request(served);
    }
    const std::string elsewhere = testing::internal::GetCapturedStderr();
    EXPECT_NE(elsewhere.find("/v1/tokens/[redacted]/x?share=[redacted]"), std::string::npos)
        << elsewhere;
}

}  // namespace
}  // namespace sporeprint::server::operations_log_test
