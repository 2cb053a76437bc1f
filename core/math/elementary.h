// Elementary functions whose results are equal bit for bit on every machine: those of libm differ
// between CPUs, these use + - * / and sqrt only.
#pragma once

namespace sporeprint {

inline constexpr double pi = 3.14159265358979323846;

struct SineCosine {
    double sine, cosine;
};

/// Returns sine and cosine of an angle in radians, |angle| < 1e5; error below 2e-15.
[[nodiscard]] SineCosine sine_cosine(double angle);
/// Return the sine or the cosine alone, with the same bits.
[[nodiscard]] double sine(double angle);
[[nodiscard]] double cosine(double angle);

/// Returns e^x, relative error below 1e-15; 0 below -700, and x above 700 counts as 700.
[[nodiscard]] double exponential(double x);

/// Returns the natural logarithm of x > 0 (normal numbers), error below 1e-15 relative or absolute.
[[nodiscard]] double logarithm(double x);

/// Returns base^exponent for base >= 0. 0^0 is 1; 0 to any other exponent, also a negative one,
/// is 0.
[[nodiscard]] double power(double base, double exponent);

/// Returns the angle from the x axis to the point (x, y), like std::atan2: radians, -pi..pi; 0 for
/// the origin.
[[nodiscard]] double arc_tangent(double y, double x);

/// Returns the linear light of an sRGB-encoded value, 0..1 to 0..1.
[[nodiscard]] double srgb_to_linear(double encoded);
/// Returns the sRGB encoding of linear light, 0..1 to 0..1.
[[nodiscard]] double linear_to_srgb(double linear);

/// Returns 0 below `from`, 1 above `to` and a cubic with zero end slopes between.
///
/// pre  from < to
[[nodiscard]] constexpr double smooth_step(double from, double to, double x) {
    const double t = x <= from ? 0.0 : x >= to ? 1.0 : (x - from) / (to - from);
    return t * t * (3.0 - 2.0 * t);
}

[[nodiscard]] constexpr double radians(double degrees) { return degrees * (pi / 180.0); }

}  // namespace sporeprint
