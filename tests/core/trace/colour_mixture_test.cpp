#include "core/trace/colour_mixture.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

#include "core/math/elementary.h"

namespace sporeprint::trace_colour_mixture_test {
namespace {

using trace::ColourMixture;
using trace::WeightedColour;

TEST(ColourMixture, OfOneColourIsAGaussianOfTheLeastVariance) {
    const std::vector<WeightedColour> colours(7, {{10.0, 20.0, 30.0}, 1.0});
    const ColourMixture mixture(colours);
    const double constant = 1.5 * std::log(2.0 * pi * 4.0);
    EXPECT_NEAR(mixture.cost({10.0, 20.0, 30.0}), constant, 1e-9);
    EXPECT_NEAR(mixture.cost({12.0, 20.0, 30.0}), constant + 0.5, 1e-9);
    EXPECT_NEAR(mixture.cost({10.0, 24.0, 27.0}), constant + 25.0 / 8.0, 1e-9);
}

TEST(ColourMixture, SharesItsWeightBetweenDistantColours) {
    const std::vector<WeightedColour> colours = {{{0.0, 0.0, 0.0}, 3.0}, {{200.0, 0.0, 0.0}, 1.0}};
    const ColourMixture mixture(colours);
    EXPECT_NEAR(mixture.cost({200.0, 0.0, 0.0}) - mixture.cost({0.0, 0.0, 0.0}), std::log(3.0),
                1e-9);
}

TEST(ColourMixture, IsADensity) {
    const std::vector<WeightedColour> colours = {{{60.0, 100.0, 90.0}, 1.0},
                                                 {{80.0, 90.0, 100.0}, 2.0},
                                                 {{74.0, 110.0, 120.0}, 1.0},
                                                 {{90.0, 120.0, 95.0}, 1.5}};
    const ColourMixture mixture(colours);
    double sum = 0.0;
    for (double r = 40.0; r < 110.0; r += 1.0)
        for (double g = 70.0; g < 140.0; g += 1.0)
            for (double b = 70.0; b < 140.0; b += 1.0) sum += std::exp(-mixture.cost({r, g, b}));
    EXPECT_NEAR(sum, 1.0, 1e-3);
}

RC_GTEST_PROP(ColourMixture, DoesNotDependOnTheUnitOfItsWeights, ()) {
    std::vector<WeightedColour> colours(*rc::gen::inRange<std::size_t>(1, 60)), heavier;
    const auto channel = [] { return static_cast<double>(*rc::gen::inRange(0, 256)); };
    for (WeightedColour& one : colours) {
        one = {{channel(), channel(), channel()}, 1.0 + *rc::gen::inRange(0, 3)};
        heavier.push_back({one.colour, 4.0 * one.weight});
    }
    const glm::dvec3 colour(channel(), channel(), channel());
    const double cost = ColourMixture(colours).cost(colour);
    RC_ASSERT(std::isfinite(cost));
    RC_ASSERT(std::abs(cost - ColourMixture(heavier).cost(colour)) < 1e-6 * (1.0 + std::abs(cost)));
}

}  // namespace
}  // namespace sporeprint::trace_colour_mixture_test
