#include "core/math/elementary.h"

#include <bit>
#include <cmath>
#include <cstdint>

namespace sporeprint {

namespace {

// This is pi/2 in three parts; the first two have trailing zeros, so that small multiples are exact
// (Cody and Waite).
constexpr double half_pi_1 = 1.57079632673412561417e+00;
constexpr double half_pi_2 = 6.07710050630396597660e-11;
constexpr double half_pi_3 = 2.02226624879595063154e-21;

double sine_of_small(double x) {
    const double z = x * x;
    double p = -1.0 / 1307674368000.0;
    p = p * z + 1.0 / 6227020800.0;
    p = p * z - 1.0 / 39916800.0;
    p = p * z + 1.0 / 362880.0;
    p = p * z - 1.0 / 5040.0;
    p = p * z + 1.0 / 120.0;
    p = p * z - 1.0 / 6.0;
    return x + x * z * p;
}

double cosine_of_small(double x) {
    const double z = x * x;
    double p = 1.0 / 20922789888000.0;
    p = p * z - 1.0 / 87178291200.0;
    p = p * z + 1.0 / 479001600.0;
    p = p * z - 1.0 / 3628800.0;
    p = p * z + 1.0 / 40320.0;
    p = p * z - 1.0 / 720.0;
    p = p * z + 1.0 / 24.0;
    return 1.0 - 0.5 * z + z * z * p;
}

double two_to(int exponent) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

}  // namespace

SineCosine sine_cosine(double angle) {
    const double quarter = std::floor(angle * (2.0 / pi) + 0.5);
    const double rest = ((angle - quarter * half_pi_1) - quarter * half_pi_2) - quarter * half_pi_3;
    const double s = sine_of_small(rest);
    const double c = cosine_of_small(rest);
    switch (static_cast<std::int64_t>(quarter) & 3) {
        case 0:
            return {s, c};
        case 1:
            return {c, -s};
        case 2:
            return {-s, -c};
        default:
            return {-c, s};
    }
}

double sine(double angle) { return sine_cosine(angle).sine; }

double cosine(double angle) { return sine_cosine(angle).cosine; }

double exponential(double x) {
    if (x < -700.0) return 0.0;
    if (x > 700.0) x = 700.0;
    const double k = std::floor(x * 1.44269504088896340736 + 0.5);
    const double r = (x - k * 6.93147180369123816490e-01) - k * 1.90821492927058770002e-10;
    double p = 1.0;
    for (int i = 14; i >= 1; --i) p = 1.0 + p * r / i;
    return p * two_to(static_cast<int>(k));
}

double logarithm(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    int exponent = static_cast<int>(bits >> 52) - 1023;
    double m = std::bit_cast<double>((bits & 0xFFFFFFFFFFFFFULL) | 0x3FF0000000000000ULL);
    if (m > 1.41421356237309504880) {
        m *= 0.5;
        ++exponent;
    }
    const double s = (m - 1.0) / (m + 1.0);
    const double z = s * s;
    double p = 0.0;
    for (int i = 23; i >= 3; i -= 2) p = (p + 1.0 / i) * z;
    return exponent * 6.93147180369123816490e-01 +
           (exponent * 1.90821492927058770002e-10 + 2.0 * (s + s * p));
}

double power(double base, double exponent) {
    if (exponent == 0.0) return 1.0;
    if (base <= 0.0) return 0.0;
    if (base == 1.0) return 1.0;
    return exponential(exponent * logarithm(base));
}

double arc_tangent(double y, double x) {
    const double ax = x < 0.0 ? -x : x;
    const double ay = y < 0.0 ? -y : y;
    if (ax == 0.0 && ay == 0.0) return 0.0;
    const bool steep = ay > ax;
    double t = steep ? ax / ay : ay / ax;
    // atan(t) = 2 atan(t / (1 + sqrt(1 + t^2))) is applied three times: from at most 1 to below
    // 0.1.
    for (int i = 0; i < 3; ++i) t = t / (1.0 + std::sqrt(1.0 + t * t));
    const double z = t * t;
    double p = 0.0;
    for (int i = 17; i >= 3; i -= 2) p = (((i & 2) != 0 ? -1.0 : 1.0) / i + p) * z;
    double angle = 8.0 * (t + t * p);
    if (steep) angle = 0.5 * pi - angle;
    if (x < 0.0) angle = pi - angle;
    return y < 0.0 ? -angle : angle;
}

double srgb_to_linear(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : power((encoded + 0.055) / 1.055, 2.4);
}

double linear_to_srgb(double linear) {
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * power(linear, 1.0 / 2.4) - 0.055;
}

}  // namespace sporeprint
