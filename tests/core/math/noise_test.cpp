#include "core/math/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

#include "core/problems.h"

namespace sporeprint::math_noise_test {
namespace {

struct Points {
    std::vector<float> x, y, z;
};

// The count is odd, so that every instruction set has a remainder.
Points scattered(std::size_t count) {
    Points points;
    std::uint32_t state = 12345;
    const auto next = [&] {
        state = state * 1664525U + 1013904223U;
        return static_cast<float>(static_cast<int>(state >> 8U) - (1 << 23)) / 65536.0F;
    };
    for (std::size_t i = 0; i < count; ++i) {
        points.x.push_back(next());
        points.y.push_back(next());
        points.z.push_back(next());
    }
    return points;
}

class EverySimd : public ::testing::Test {
  protected:
    void TearDown() override { force_simd("auto"); }
};
using Noise = EverySimd;

TEST_F(Noise, HasEqualBitsWithEveryInstructionSet) {
    const Points at = scattered(4099);
    std::vector<float> periodic_x;
    for (const float x : at.x) periodic_x.push_back(std::abs(x) * 0.5F);
    std::vector<float> first;
    for (const std::string& name : simd_names()) {
        force_simd(name);
        std::vector<float> all(3 * at.x.size());
        const std::span<float> out(all);
        const std::size_t n = at.x.size();
        gradient_noise(at.x, at.y, 7, out.subspan(0, n));
        gradient_noise(at.x, at.y, at.z, 7, out.subspan(n, n));
        periodic_noise(periodic_x, at.y, 65, 7, out.subspan(2 * n, n));
        if (first.empty()) first = all;
        EXPECT_EQ(std::memcmp(first.data(), all.data(), all.size() * sizeof(float)), 0) << name;
    }
    EXPECT_GE(simd_names().size(), 2U);
}

TEST_F(Noise, HasMeanZeroAndTheStatedSpread) {
    const Points at = scattered(200000);
    for (const bool solid : {false, true}) {
        std::vector<float> out(at.x.size());
        if (solid)
            gradient_noise(at.x, at.y, at.z, 3, out);
        else
            gradient_noise(at.x, at.y, 3, out);
        double sum = 0.0, squares = 0.0, most = 0.0;
        for (const float v : out) {
            sum += static_cast<double>(v);
            squares += static_cast<double>(v) * static_cast<double>(v);
            most = std::max(most, std::abs(static_cast<double>(v)));
        }
        const double n = static_cast<double>(out.size());
        EXPECT_NEAR(sum / n, 0.0, 0.01);
        EXPECT_NEAR(std::sqrt(squares / n), 0.33, 0.06);
        EXPECT_LT(most, 2.0);
    }
}

TEST_F(Noise, VanishesAtIntegers) {
    std::vector<float> x, y, out;
    for (int i = -20; i <= 20; ++i) {
        x.push_back(static_cast<float>(i));
        y.push_back(static_cast<float>(3 * i - 7));
    }
    out.resize(x.size());
    gradient_noise(x, y, 1, out);
    for (const float v : out) EXPECT_EQ(v, 0.0F);
}

TEST_F(Noise, IsContinuousAcrossCells) {
    std::vector<float> x, y, out;
    for (int i = 0; i < 4000; ++i) {
        x.push_back(-2.0F + static_cast<float>(i) * 0.001F);
        y.push_back(0.37F);
    }
    out.resize(x.size());
    gradient_noise(x, y, 5, out);
    for (std::size_t i = 1; i < out.size(); ++i) EXPECT_NEAR(out[i], out[i - 1], 0.012F);
}

TEST_F(Noise, RepeatsAfterItsPeriod) {
    for (const int period : {1, 2, 7, 100}) {
        std::vector<float> x, moved, y;
        for (int i = 0; i < 64; ++i) {
            // Multiples of 1/64 survive the shift without rounding.
            x.push_back(static_cast<float>(i) / 64.0F * static_cast<float>(period) * 0.5F);
            moved.push_back(x.back() + static_cast<float>(period));
            y.push_back(static_cast<float>(i) * 0.3F);
        }
        std::vector<float> a(x.size()), b(x.size());
        periodic_noise(x, y, period, 9, a);
        periodic_noise(moved, y, period, 9, b);
        for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 2e-5F) << period;
    }
}

TEST_F(Noise, DependsOnItsSeed) {
    const Points at = scattered(1000);
    std::vector<float> a(1000), b(1000);
    gradient_noise(at.x, at.y, 1, a);
    gradient_noise(at.x, at.y, 2, b);
    double product = 0.0, square = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        product += static_cast<double>(a[i] * b[i]);
        square += static_cast<double>(a[i] * a[i]);
    }
    EXPECT_LT(std::abs(product / square), 0.12);
}

TEST_F(Noise, RefusesArraysOfDifferentLengths) {
    std::vector<float> three(3), four(4);
    EXPECT_THROW(gradient_noise(three, four, 1, three), InvalidInput);
    EXPECT_THROW(gradient_noise(three, three, four, 1, three), InvalidInput);
    EXPECT_THROW(periodic_noise(three, three, 0, 1, three), InvalidInput);
}

TEST_F(Noise, AnUnknownInstructionSetIsRefusedAndNamed) {
    try {
        force_simd("avx9");
        FAIL();
    } catch (const InvalidInput& error) {
        ASSERT_EQ(error.problems().size(), 1U);
        EXPECT_EQ(error.problems()[0].path, "simd");
        EXPECT_NE(error.problems()[0].message.find("'avx9' is none of auto, scalar"),
                  std::string::npos);
    }
}

}  // namespace
}  // namespace sporeprint::math_noise_test
