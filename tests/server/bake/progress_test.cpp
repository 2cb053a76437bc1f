#include "server/bake/progress.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/params/value.h"

namespace sporeprint::server::progress_test {
namespace {

std::string reported(ProgressStyle style, std::uint64_t items, std::uint64_t before, int done) {
    testing::internal::CaptureStderr();
    BakeProgress progress(style, items, before);
    for (int i = 0; i < done; ++i) progress.count(i % 4 == 0, 1000);
    EXPECT_EQ(progress.failed(), static_cast<std::uint64_t>((done + 3) / 4));
    progress.finish();
    return testing::internal::GetCapturedStderr();
}

TEST(BakeProgress, HasOneLine) {
    const std::string line = reported(ProgressStyle::line, 2000, 18'000, 1000);
    EXPECT_EQ(line.find("19,000 of 20,000 items, 250 failed, "), 0U) << line;
    EXPECT_NE(line.find("/s, "), std::string::npos);
    EXPECT_NE(line.find(" left\n"), std::string::npos);
    const std::string last = reported(ProgressStyle::line, 3, 0, 3);
    EXPECT_EQ(last.find("3 of 3 items, 1 failed, "), 0U) << last;
    EXPECT_EQ(last.find("left"), std::string::npos);
}

TEST(BakeProgress, IsAnObjectForPrograms) {
    std::vector<Problem> problems;
    const Value object = parse(reported(ProgressStyle::json, 10, 5, 6), problems);
    ASSERT_TRUE(problems.empty());
    EXPECT_EQ(object.find("items")->as_number(), 11.0);
    EXPECT_EQ(object.find("of")->as_number(), 15.0);
    EXPECT_EQ(object.find("failed")->as_number(), 2.0);
    EXPECT_EQ(object.find("bytes")->as_number(), 6000.0);
    EXPECT_TRUE(object.find("seconds_left")->is_number());
    EXPECT_TRUE(
        parse(reported(ProgressStyle::json, 10, 0, 0), problems).find("seconds_left")->is_null());
    EXPECT_EQ(reported(ProgressStyle::none, 10, 0, 5), "");
}

TEST(BakeProgress, WritesTimesAndNumbersForPeople) {
    EXPECT_EQ(time_text(0.2), "0 s");
    EXPECT_EQ(time_text(59.4), "59 s");
    EXPECT_EQ(time_text(59.6), "1 min");
    EXPECT_EQ(time_text(151), "2 min 31 s");
    EXPECT_EQ(time_text(3600 + 5 * 60), "1 h 5 min");
    EXPECT_EQ(time_text(2 * 86400 + 3 * 3600 + 9), "2 d 3 h");
    EXPECT_EQ(grouped(0), "0");
    EXPECT_EQ(grouped(999), "999");
    EXPECT_EQ(grouped(1000), "1,000");
    EXPECT_EQ(grouped(1'234'567), "1,234,567");
}

}  // namespace
}  // namespace sporeprint::server::progress_test
