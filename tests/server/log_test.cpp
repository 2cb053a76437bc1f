#include "server/log.h"

#include <gtest/gtest.h>

namespace sporeprint::server {
namespace {

TEST(Log, WritesOneLineWhateverAClientSends) {
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

}  // namespace
}  // namespace sporeprint::server
