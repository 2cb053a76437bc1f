#include "core/surface/metrics.h"

#include <gtest/gtest.h>

namespace sporeprint::surface_metrics_test {
namespace {

TEST(Metrics, EveryStepIsTheNearestToItsOwnLength) {
    // Below step -581 a length is shorter than the shortest allowed, 1e-5 m.
    for (int step = -581; step <= 100; ++step)
        EXPECT_EQ(quantised_length(length_of_step(step)), step);
}

TEST(Metrics, AStepIsTwoPercent) {
    EXPECT_DOUBLE_EQ(length_of_step(0), 1.0);
    for (int step = -600; step < 100; ++step)
        EXPECT_NEAR(length_of_step(step + 1) / length_of_step(step), 1.02, 1e-12);
}

TEST(Metrics, LengthsAreWithinOnePercent) {
    for (double length = 2e-5; length < 5.0; length *= 1.0037)
        EXPECT_NEAR(length_of_step(quantised_length(length)) / length, 1.0, 0.0101);
}

TEST(Metrics, InvalidLengthsCountAsTheShortest) {
    const int shortest = quantised_length(1e-5);
    EXPECT_EQ(quantised_length(0.0), shortest);
    EXPECT_EQ(quantised_length(-1.0), shortest);
    EXPECT_EQ(quantised_length(1e9), 100);
    EXPECT_GE(shortest, -600);
}

}  // namespace
}  // namespace sporeprint::surface_metrics_test
