#include "core/world/dispersal.h"

#include <algorithm>
#include <cmath>

#include "core/math/elementary.h"

namespace sporeprint {

namespace {

/// Wind at the cap at which half of the spores do not fall beside it, m/s.
constexpr double lifting_wind = 0.2;

/// Deviation of the vertical wind as a share of the wind.
constexpr double turbulence = 0.25;

constexpr double von_karman = 0.4;

/// Returns e^(x^2) erfc(x) for x >= 0, relative error below 1.2e-7 [Press1992].
double scaled_error_complement(double x) {
    const double t = 1.0 / (1.0 + 0.5 * x);
    const double polynomial =
        -1.26551223 +
        t * (1.00002368 +
             t * (0.37409196 +
                  t * (0.09678418 +
                       t * (-0.18628806 +
                            t * (0.27886807 +
                                 t * (-1.13520398 +
                                      t * (1.48851587 + t * (-0.82215223 + t * 0.17087277))))))));
    return t * exponential(polynomial);
}

/// Returns the share of a standard normal distribution below z.
double normal_share_below(double z) {
    const double x = std::abs(z) / std::sqrt(2.0);
    const double tail = 0.5 * exponential(-x * x) * scaled_error_complement(x);
    return z < 0.0 ? tail : 1.0 - tail;
}

}  // namespace

double WaldLaw::density(double r) const {
    if (mean <= 0.0) return 0.0;
    const double deviation = (r - mean) / mean;
    return std::sqrt(shape / (2.0 * pi * r)) / r *
           exponential(-shape * deviation * deviation / (2.0 * r));
}

double WaldLaw::within(double r) const {
    if (mean <= 0.0) return 1.0;
    const double scale = std::sqrt(shape / r);
    const double below = scale * (r / mean - 1.0), above = scale * (r / mean + 1.0);
    // The second term is e^(2 shape / mean) times the share below -above. Its factors overflow and underflow; but the
    // square of `above` is that of `below` plus 4 shape / mean.
    const double second =
        0.5 * exponential(-0.5 * below * below) * scaled_error_complement(above / std::sqrt(2.0));
    return std::min(1.0, normal_share_below(below) + second);
}

double WaldLaw::sample(Random& random) const {
    const double radius = random.uniform();
    const double angle = random.uniform();
    const double choice = random.uniform();
    if (mean <= 0.0) return 0.0;
    const double normal = cosine(2.0 * pi * angle);
    const double square = -2.0 * logarithm(1.0 - radius) * normal * normal;
    const double part = mean * square / shape;
    // The lesser root of the quadratic equation, as a quotient: the difference would lose its digits.
    const double x = mean / (1.0 + 0.5 * part + std::sqrt(part * (1.0 + 0.25 * part)));
    return choice * (mean + x) <= mean ? x : mean * mean / x;
}

WaldLaw wald_law(const SporeRelease& release) {
    const double variance = von_karman * release.cover * 2.0 * turbulence;
    return {release.wind * release.height / release.settling,
            release.height * release.height / variance};
}

double DispersalKernel::within(double r) const {
    const double scaled = r / near_scale;
    return beside * (1.0 - (1.0 + scaled) * exponential(-scaled)) + carried * wald.within(r);
}

double DispersalKernel::density(const WindRose& rose, double east, double north) const {
    const double r = std::max(1e-3, std::sqrt(east * east + north * north));
    const double near =
        beside * exponential(-r / near_scale) / (2.0 * pi * near_scale * near_scale);
    // The direction that the wind comes from, clockwise from north, in sectors.
    const double from = arc_tangent(-east, -north) * (wind_sectors / (2.0 * pi));
    const double sector = from < 0.0 ? from + wind_sectors : from;
    const auto below = std::min(static_cast<std::size_t>(sector), wind_sectors - 1);
    const double t = sector - static_cast<double>(below);
    const double share = rose[below].share * (1.0 - t) + rose[(below + 1) % wind_sectors].share * t;
    const double per_radian = share * (wind_sectors / (2.0 * pi));
    return near + carried * wald.density(r) * per_radian / r;
}

DispersalKernel dispersal_kernel(const SporeRelease& release) {
    DispersalKernel out;
    const double ratio = release.wind / lifting_wind;
    out.beside = 1.0 / (1.0 + ratio * ratio * ratio);
    out.carried = (1.0 - out.beside) * carried_share;
    out.gone = (1.0 - out.beside) * (1.0 - carried_share);
    out.wald = wald_law(release);
    return out;
}

std::optional<Landing> sample(const DispersalKernel& kernel, const WindRose& rose, Random& random) {
    const double fate = random.uniform();
    const double direction = random.uniform();
    const double first = random.uniform();
    const double second = random.uniform();
    const double carried = kernel.wald.sample(random);
    if (fate < kernel.beside) {
        const double r = -near_scale * logarithm((1.0 - first) * (1.0 - second));
        const auto [sine_angle, cosine_angle] = sine_cosine(2.0 * pi * direction);
        return Landing{r * sine_angle, r * cosine_angle};
    }
    if (fate >= kernel.beside + kernel.carried) return std::nullopt;
    std::size_t sector = 0;
    double left = direction;
    while (sector + 1 < wind_sectors && left >= rose[sector].share) left -= rose[sector++].share;
    // Sum of two uniform draws: the density is linear between the middles of two sectors.
    const double from =
        (static_cast<double>(sector) + first + second - 1.0) * (2.0 * pi / wind_sectors);
    const auto [sine_from, cosine_from] = sine_cosine(from);
    return Landing{-carried * sine_from, -carried * cosine_from};
}

}  // namespace sporeprint
