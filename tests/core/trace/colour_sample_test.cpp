#include "core/trace/colour_sample.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "core/trace/lab.h"

namespace sporeprint::trace_colour_sample_test {
namespace {

using trace::ColourSample;
using trace::Pixel;

void add(ColourSample& sample, const Pixel& pixel, int count) {
    for (int i = 0; i < count; ++i) sample.add(pixel);
}

double distance(const std::optional<glm::dvec3>& lab, const glm::dvec3& rgb) {
    return glm::length(lab.value() - trace::lab_of(rgb));
}

TEST(ColourSample, HasNoColourOfTooFewPixels) {
    ColourSample sample;
    add(sample, {200, 40, 30}, 23);
    EXPECT_FALSE(sample.colour(sample.commonest_hue()).has_value());
    add(sample, {200, 40, 30}, 1);
    EXPECT_LT(distance(sample.colour(sample.commonest_hue()), {200, 40, 30}), 1e-9);
}

TEST(ColourSample, HasTheColourOfMostPixelsWithoutSpotsAndShade) {
    ColourSample sample;
    add(sample, {200, 40, 30}, 60);
    add(sample, {250, 250, 240}, 30);  // warts
    add(sample, {100, 20, 15}, 20);    // shade
    EXPECT_LT(distance(sample.colour(sample.commonest_hue()), {200, 40, 30}), 1.0);
}

TEST(ColourSample, CountsOnlyPixelsOfAGivenHueIfThereAreEnough) {
    const trace::Hue red = trace::hue_of({200, 40, 30});
    ColourSample sample;
    add(sample, {60, 160, 60}, 70);
    add(sample, {200, 40, 30}, 30);
    EXPECT_LT(distance(sample.colour(red), {200, 40, 30}), 1.0);
    add(sample, {60, 160, 60}, 200);
    EXPECT_LT(distance(sample.colour(red), {60, 160, 60}), 1.0);
}

TEST(ColourSample, JoinsOthers) {
    ColourSample one, other;
    add(one, {10, 200, 10}, 12);
    add(other, {10, 200, 10}, 12);
    one.add(other);
    EXPECT_TRUE(one.colour(one.commonest_hue()).has_value());
}

}  // namespace
}  // namespace sporeprint::trace_colour_sample_test
