#include "api/answers.h"

#include <gtest/gtest.h>

namespace sporeprint::api {
namespace {

std::string bounded(std::string cache_control, std::int64_t seconds_left) {
    Answer answer;
    answer.headers = {{"Content-Type", "image/jpeg"}, {"cache-control", std::move(cache_control)}};
    bound_freshness(answer, seconds_left);
    return std::string(header_of(answer, "Cache-Control"));
}

TEST(Answers, max_age_is_never_more_than_what_is_left_of_the_url) {
    for (const bool versioned : {false, true}) {
        EXPECT_EQ(bounded(cache_control(versioned), 3), "public, max-age=3, must-revalidate");
        EXPECT_EQ(bounded(cache_control(versioned), 0), "public, max-age=0, must-revalidate");
        EXPECT_EQ(bounded(cache_control(versioned), -7), "public, max-age=0, must-revalidate");
    }
    EXPECT_EQ(bounded(cache_control(false), 864'000), "public, max-age=3600, must-revalidate");
    EXPECT_EQ(bounded(cache_control(true), 864'000), "public, max-age=864000, must-revalidate");
    EXPECT_EQ(bounded(cache_control(true), INT64_MAX), "public, max-age=31536000, must-revalidate");
    EXPECT_EQ(bounded("no-store", 100), "no-store");
    EXPECT_EQ(bounded("no-cache", 100), "no-cache");
}

}  // namespace
}  // namespace sporeprint::api
