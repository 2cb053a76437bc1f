#include "core/params/blend.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <vector>

#include "tests/core/params/arbitrary.h"
#include "tests/core/params/sample.h"

namespace sporeprint::params_blend_test {
namespace {

using sample::Request;

template <class T>
Shares<T> shares_of(const std::vector<T>& values, const std::vector<double>& weights) {
    Shares<T> shares;
    for (std::size_t i = 0; i < values.size(); ++i) shares.add(values[i], weights[i]);
    return shares;
}

template <class T>
T blended(const std::vector<T>& values, const std::vector<double>& weights) {
    return blend(shares_of(values, weights));
}

std::vector<double> arbitrary_weights(std::size_t count) {
    std::vector<double> weights;
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        weights.push_back(0.001 + arbitrary_fraction());
        sum += weights.back();
    }
    for (double& w : weights) w /= sum;
    return weights;
}

/// Returns requests with the same counts, so that an end is exactly one of them.
std::vector<Request> arbitrary_requests(std::size_t count) {
    std::vector<Request> requests;
    for (std::size_t i = 0; i < count; ++i) {
        requests.push_back(arbitrary_of<Request>());
        requests.back().cap.radius = 0.5;  // the cross-field rule
    }
    return requests;
}

struct Sizes {
    double radius = 0.1;
    double height = 0.0;
    int count = 1;

    static constexpr void fields(auto visit) {
        visit(&Sizes::radius,
              Info{.name = "radius", .unit = "m", .min = 0.01, .max = 10, .doc = "Never 0."});
        visit(&Sizes::height,
              Info{.name = "height", .unit = "m", .min = 0, .max = 10, .doc = "May be 0."});
        visit(&Sizes::count, Info{.name = "count", .min = 0, .max = 10, .doc = "A count."});
    }
    bool operator==(const Sizes&) const = default;
};

TEST(Blend, ASingleValueOfWeightOneIsExact) {
    EXPECT_TRUE(rc::check([] {
        const Request a = arbitrary_of<Request>();
        RC_ASSERT(blended<Request>({a}, {1.0}) == a);
        RC_ASSERT(blended<Request>({a, a, a}, arbitrary_weights(3)) == a);
    }));
    EXPECT_EQ((blended<Sizes>({{0.1, 1.0, 3}, {7.0, 0.3, 2}}, {1.0, 0.0})), (Sizes{0.1, 1.0, 3}));
}

TEST(Blend, StaysInsideTheRanges) {
    EXPECT_TRUE(rc::check([] {
        const auto count = *rc::gen::inRange<std::size_t>(1, 9);
        RC_ASSERT(
            problems_in(blended(arbitrary_requests(count), arbitrary_weights(count))).empty());
    }));
}

TEST(Blend, NumbersBlendLinearlyAndSizesGeometrically) {
    EXPECT_EQ(blended<double>({1.0, 3.0}, {0.75, 0.25}), 1.5);
    EXPECT_NEAR(blended<double>({1.0, 3.0, 8.0}, {0.5, 0.25, 0.25}), 3.25, 1e-15);
    EXPECT_EQ(blended<Range>({{0, 2}, {1, 4}}, {0.5, 0.5}), (Range{0.5, 3}));
    EXPECT_EQ((blended<std::vector<double>>({{0, 1}, {1, 3}}, {0.5, 0.5})),
              (std::vector<double>{0.5, 2}));
    const Sizes half = blended<Sizes>({{0.1, 0.0}, {0.4, 1.0}}, {0.5, 0.5});
    EXPECT_NEAR(half.radius, 0.2, 1e-15) << "twice the smaller, half the larger";
    EXPECT_EQ(half.height, 0.5) << "what may be absent grows from nothing";
    const Sizes third = blended<Sizes>({{0.1}, {0.2}, {0.8}}, {1.0 / 3, 1.0 / 3, 1.0 / 3});
    EXPECT_NEAR(third.radius, std::cbrt(0.1 * 0.2 * 0.8), 1e-15);
}

TEST(Blend, CountsAreTheMaximumForAllWeights) {
    for (const double t : {0.0, 0.001, 0.5, 1.0}) {
        EXPECT_EQ((blended<int>({3, 7}, {1.0 - t, t})), 7);
        EXPECT_EQ((blended<std::uint32_t>({4294967295u, 0u}, {1.0 - t, t})), 4294967295u);
    }
}

TEST(Blend, ColoursBlendInLinearLight) {
    // Half the light of white is sRGB 188 (IEC 61966-2-1: 1.055 * 0.5^(1/2.4) - 0.055 = 0.7354).
    EXPECT_EQ((blended<Colour>({{0, 0, 0}, {255, 255, 255}}, {0.5, 0.5})), (Colour{188, 188, 188}));
    EXPECT_EQ((blended<Colour>({{255, 0, 7}, {0, 255, 7}}, {0.5, 0.5})), (Colour{188, 188, 7}));
    // A third of it is 156 (0.6096).
    EXPECT_EQ(
        (blended<Colour>({{255, 0, 0}, {0, 255, 0}, {0, 0, 255}}, {1.0 / 3, 1.0 / 3, 1.0 / 3})),
        (Colour{156, 156, 156}));
}

TEST(Blend, OtherValuesComeFromTheLargestWeight) {
    using sample::Animation;
    EXPECT_EQ((blended<Animation>({Animation::none, Animation::growth}, {0.25, 0.75})),
              Animation::growth);
    EXPECT_EQ((blended<Animation>({Animation::none, Animation::growth}, {0.5, 0.5})),
              Animation::none);
    EXPECT_EQ((blended<std::optional<double>>({1.0, std::nullopt}, {0.75, 0.25})), 1.0);
    EXPECT_EQ((blended<Choice<1, 2>>({{1}, {2}}, {0.25, 0.75}).value), 2);
    EXPECT_EQ((blended<std::vector<double>>({{1, 2, 3}, {5}}, {0.4, 0.6})),
              (std::vector<double>{5}));
    using Shape = std::variant<sample::Swept, sample::Branched>;
    EXPECT_EQ((blended<Shape>({sample::Branched{2}, sample::Branched{6}}, {0.5, 0.5})),
              Shape(sample::Branched{6}));
    EXPECT_EQ((blended<Shape>({sample::Branched{2}, sample::Swept{}}, {0.75, 0.25})),
              Shape(sample::Branched{2}));
}

TEST(Blend, TheOrderDoesNotMatter) {
    EXPECT_TRUE(rc::check([] {
        std::vector<Sizes> sizes;
        for (int i = 0; i < 3; ++i) sizes.push_back(arbitrary_of<Sizes>());
        std::vector<double> weights = arbitrary_weights(3);
        const Sizes once = blended(sizes, weights);
        std::swap(sizes[0], sizes[2]);
        std::swap(weights[0], weights[2]);
        const Sizes again = blended(sizes, weights);
        RC_ASSERT(std::abs(once.radius - again.radius) < 1e-14 * once.radius + 1e-15);
        RC_ASSERT(std::abs(once.height - again.height) < 1e-14);
        RC_ASSERT(once.count == again.count);
    }));
}

TEST(Overlay, CopiesWhatIsSetAlsoInNestedStructs) {
    sample::DeformationOf<Plain> values;
    values.low.bend_deg = 10.0;
    values.high.bend_deg = 20.0;
    values.taper = 0.5;
    sample::DeformationOf<Maybe> overrides;
    sample::DeformationOf<Plain> copy = values;
    overlay(overrides, copy);
    EXPECT_EQ(copy, values);
    overrides.high.bend_deg = 0.0;
    overrides.low.mode = sample::Animation::growth;
    overlay(overrides, copy);
    EXPECT_EQ(copy.low.bend_deg, 10.0);
    EXPECT_EQ(copy.high.bend_deg, 0.0);
    EXPECT_EQ(copy.low.mode, sample::Animation::growth);
    EXPECT_EQ(copy.high.mode, sample::Animation::none);
    EXPECT_EQ(copy.taper, 0.5);
}

TEST(Overlay, ProofRefusesDifferentStructs) {
    static_assert(same_fields<sample::DeformationOf<Maybe>, sample::DeformationOf<Plain>>());
    static_assert(!same_fields<sample::DeformationOf<Plain>, sample::DeformationOf<Plain>>());
    static_assert(!same_fields<sample::BendOf<Maybe>, sample::Knot>());
}

}  // namespace
}  // namespace sporeprint::params_blend_test
