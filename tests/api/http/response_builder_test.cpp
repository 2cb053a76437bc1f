#include "api/http/response_builder.h"

#include <gtest/gtest.h>

namespace sporeprint::api::http_response_builder_test {
namespace {

std::string bounded(std::string cache_control, std::int64_t seconds_left) {
    Response response;
    response.headers = {{"Content-Type", "image/jpeg"},
                        {"cache-control", std::move(cache_control)}};
    bound_freshness(response, seconds_left);
    return std::string(header_of(response, "Cache-Control"));
}

TEST(ResponseBuilder, MaxAgeIsNeverMoreThanWhatIsLeftOfTheUrl) {
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
}  // namespace sporeprint::api::http_response_builder_test
