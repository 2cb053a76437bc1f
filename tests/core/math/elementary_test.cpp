#include "core/math/elementary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/random.h"

namespace sporeprint::math_elementary_test {
namespace {

// The reference is libm in long double (64 bits of mantissa).

/// Returns the largest |function - truth| over random arguments from `low` to `high`, both ends
/// included.
template <class Function, class Truth>
double worst_error(double low, double high, const Function& function, const Truth& truth,
                   bool relative) {
    Random random(7, 0);
    double worst = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const double fine = random.uniform();
        const double coarse = random.uniform();
        const double x = i == 0   ? low
                         : i == 1 ? high
                                  : low + (high - low) * std::min(1.0, coarse + fine * 0x1p-24);
        const long double exact = truth(static_cast<long double>(x));
        const long double error = std::abs(static_cast<long double>(function(x)) - exact);
        worst = std::max(worst, static_cast<double>(relative ? error / std::abs(exact) : error));
    }
    return worst;
}

TEST(Elementary, SineAndCosineAgreeWithLibmForSmallAndLargeAngles) {
    for (const double reach : {0.8, 10.0, 1e3, 99999.0}) {
        const auto sin_true = [](long double x) { return std::sin(x); };
        const auto cos_true = [](long double x) { return std::cos(x); };
        EXPECT_LT(worst_error(-reach, reach, sine, sin_true, false), 2e-15) << reach;
        EXPECT_LT(worst_error(-reach, reach, cosine, cos_true, false), 2e-15) << reach;
    }
}

TEST(Elementary, SineAndCosineAgreeWithLibmAtEveryQuarterTurn) {
    for (int quarter = -4000; quarter <= 4000; ++quarter) {
        const double angle = quarter * (0.5 * pi);
        EXPECT_NEAR(sine(angle), static_cast<double>(std::sin(static_cast<long double>(angle))),
                    2e-15);
        EXPECT_NEAR(cosine(angle), static_cast<double>(std::cos(static_cast<long double>(angle))),
                    2e-15);
    }
}

TEST(Elementary, SineAndCosineLieOnTheUnitCircle) {
    Random random(3, 0);
    for (int i = 0; i < 10000; ++i) {
        const auto [s, c] = sine_cosine(random.uniform(-1e5, 1e5));
        EXPECT_NEAR(s * s + c * c, 1.0, 5e-15);
    }
    EXPECT_EQ(sine(0.0), 0.0);
    EXPECT_EQ(cosine(0.0), 1.0);
    EXPECT_EQ(sine(-0.7), -sine(0.7));
    EXPECT_EQ(cosine(-0.7), cosine(0.7));
}

TEST(Elementary, ExponentialAgreesWithLibmOverItsWholeRange) {
    const auto truth = [](long double x) { return std::exp(x); };
    for (const double reach : {0.1, 1.0, 40.0, 700.0})
        EXPECT_LT(worst_error(-reach, reach, exponential, truth, true), 1e-15) << reach;
    EXPECT_EQ(exponential(0.0), 1.0);
    EXPECT_EQ(exponential(-700.1), 0.0);
    EXPECT_EQ(exponential(900.0), exponential(700.0));
    EXPECT_TRUE(std::isfinite(exponential(700.0)));
}

TEST(Elementary, LogarithmAgreesWithLibmOverItsWholeRange) {
    for (const double x :
         {std::numeric_limits<double>::min(), 1e-300, 1e-9, 0.1, 0.5, 0.999999, 1.0, 1.000001,
          1.4142, 1.4143, 2.0, 10.0, 1e9, 1e300, std::numeric_limits<double>::max()}) {
        const double truth = static_cast<double>(std::log(static_cast<long double>(x)));
        EXPECT_NEAR(logarithm(x), truth, 1e-15 * std::max(1.0, std::abs(truth))) << x;
    }
    const auto truth = [](long double x) { return std::log(x); };
    EXPECT_LT(worst_error(0.5, 2.0, logarithm, truth, false), 1e-15);
    EXPECT_LT(worst_error(2.0, 1e6, logarithm, truth, true), 1e-15);
    EXPECT_EQ(logarithm(1.0), 0.0);
}

TEST(Elementary, ExponentialInvertsTheLogarithm) {
    Random random(11, 0);
    for (int i = 0; i < 10000; ++i) {
        const double x = random.uniform(1e-6, 1e3);
        EXPECT_NEAR(exponential(logarithm(x)) / x, 1.0, 1e-14);
    }
}

TEST(Elementary, PowerAgreesWithLibmAndKeepsItsExactPoints) {
    Random random(13, 0);
    for (int i = 0; i < 10000; ++i) {
        const double base = random.uniform(1e-4, 20.0);
        const double exponent = random.uniform(-6.0, 6.0);
        const long double truth = std::pow(static_cast<long double>(base), exponent);
        EXPECT_NEAR(static_cast<double>(power(base, exponent) / truth), 1.0, 4e-14)
            << base << "^" << exponent;
    }
    EXPECT_EQ(power(0.0, 0.0), 1.0);
    EXPECT_EQ(power(0.0, 2.4), 0.0);
    EXPECT_EQ(power(1.0, 1e9), 1.0);
    EXPECT_EQ(power(17.3, 0.0), 1.0);
}

TEST(Elementary, ArcTangentAgreesWithLibmInAllQuadrants) {
    Random random(17, 0);
    for (int i = 0; i < 20000; ++i) {
        const double x = random.symmetric();
        const double y = random.symmetric();
        const long double truth = std::atan2(static_cast<long double>(y), x);
        EXPECT_NEAR(arc_tangent(y, x), static_cast<double>(truth), 2e-15) << y << ", " << x;
    }
    EXPECT_EQ(arc_tangent(0.0, 0.0), 0.0);
    EXPECT_EQ(arc_tangent(0.0, 3.0), 0.0);
    EXPECT_EQ(arc_tangent(0.0, -3.0), pi);
    EXPECT_EQ(arc_tangent(2.0, 0.0), 0.5 * pi);
    EXPECT_EQ(arc_tangent(-2.0, 0.0), -0.5 * pi);
    EXPECT_NEAR(arc_tangent(1.0, 1.0), 0.25 * pi, 2e-16);
    EXPECT_NEAR(arc_tangent(1e-300, 1e300), 0.0, 1e-300);
}

TEST(Elementary, ArcTangentInvertsSineAndCosine) {
    for (int i = -1000; i <= 1000; ++i) {
        const double angle = 0.999 * pi * i / 1000.0;
        const auto [s, c] = sine_cosine(angle);
        EXPECT_NEAR(arc_tangent(s, c), angle, 4e-15);
    }
}

TEST(Elementary, SrgbTransferFunctionFollowsTheStandard) {
    for (int byte = 0; byte <= 255; ++byte) {
        const double encoded = byte / 255.0;
        const double linear = srgb_to_linear(encoded);
        const double truth =
            encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
        EXPECT_NEAR(linear, truth, 1e-14);
        EXPECT_NEAR(linear_to_srgb(linear), encoded, 1e-14);
    }
    EXPECT_EQ(srgb_to_linear(0.0), 0.0);
    EXPECT_EQ(srgb_to_linear(1.0), 1.0);
}

TEST(Elementary, SmoothStepHasZeroEndSlopesAndIsSymmetric) {
    EXPECT_EQ(smooth_step(1.0, 3.0, 0.5), 0.0);
    EXPECT_EQ(smooth_step(1.0, 3.0, 1.0), 0.0);
    EXPECT_EQ(smooth_step(1.0, 3.0, 2.0), 0.5);
    EXPECT_EQ(smooth_step(1.0, 3.0, 3.0), 1.0);
    EXPECT_EQ(smooth_step(1.0, 3.0, 9.0), 1.0);
    EXPECT_LT(smooth_step(1.0, 3.0, 1.0 + 2e-6), 4e-12);
    for (double x = 0.0; x <= 1.0; x += 0.01)
        EXPECT_NEAR(smooth_step(0.0, 1.0, x) + smooth_step(0.0, 1.0, 1.0 - x), 1.0, 1e-15);
}

}  // namespace
}  // namespace sporeprint::math_elementary_test
