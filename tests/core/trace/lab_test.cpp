#include "core/trace/lab.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <glm/geometric.hpp>

namespace sporeprint::trace_lab_test {
namespace {

TEST(LabOf, HasTheKnownValuesOfPrimaryColours) {
    const auto near = [](const glm::dvec3& rgb, const glm::dvec3& lab) {
        return glm::length(trace::lab_of(rgb) - lab) < 0.2;
    };
    EXPECT_TRUE(near({255.0, 255.0, 255.0}, {100.0, 0.0, 0.0}));
    EXPECT_TRUE(near({0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}));
    EXPECT_TRUE(near({255.0, 0.0, 0.0}, {53.24, 80.09, 67.20}));
    EXPECT_TRUE(near({0.0, 255.0, 0.0}, {87.73, -86.18, 83.18}));
    EXPECT_TRUE(near({0.0, 0.0, 255.0}, {32.30, 79.19, -107.86}));
}

RC_GTEST_PROP(RgbOf, IsTheInverse, ()) {
    glm::dvec3 rgb(0.0);
    for (int c = 0; c < 3; ++c) rgb[c] = *rc::gen::inRange(0, 256);
    RC_ASSERT(glm::length(trace::rgb_of(trace::lab_of(rgb)) - rgb) < 0.2);
}

TEST(RgbOf, StaysWithinTheColoursThatExist) {
    for (const double lightness : {-20.0, 50.0, 130.0})
        for (const double hue : {-200.0, 200.0}) {
            const glm::dvec3 rgb = trace::rgb_of({lightness, hue, -hue});
            for (int c = 0; c < 3; ++c) {
                EXPECT_GE(rgb[c], 0.0);
                EXPECT_LE(rgb[c], 255.0);
            }
        }
}

}  // namespace
}  // namespace sporeprint::trace_lab_test
