#include "core/geometry/free_form.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace sporeprint {

namespace {

constexpr int highest_degree = 7;

// Lattice of a dent: the one control point that moves is the middle of five along each axis.
constexpr int dent_degree = 4, dent_middle = 2;
constexpr std::array<int, 3> dent_degrees{dent_degree, dent_degree, dent_degree};
constexpr std::array<int, 3> dent_index{dent_middle, dent_middle, dent_middle};

struct Weight {
    double value, derivative;
};

constexpr double binomial(int n, int k) {
    double c = 1.0;
    for (int i = 1; i <= k; ++i) c = c * (n - k + i) / i;
    return c;
}

double power_of(double x, int exponent) {
    double p = 1.0;
    for (; exponent > 0; --exponent) p *= x;
    return p;
}

/// Returns the Bernstein polynomial B_i^n and its derivative at s.
Weight bernstein(int n, int i, double s) {
    const double rest = 1.0 - s;
    // The value is C(n,i) s^i (1-s)^(n-i); its derivative shares all but one factor of each power.
    const double low = i > 0 ? power_of(s, i - 1) : 0.0,
                 high = i < n ? power_of(rest, n - i - 1) : 0.0;
    const double left = i > 0 ? low * s : 1.0, right = i < n ? high * rest : 1.0;
    const double c = binomial(n, i);
    return {c * left * right, c * (i * low * right - (n - i) * left * high)};
}

struct DentWeights {
    glm::dvec3 value, derivative;
};

/// Returns bernstein() of a dent's control point along the three axes, without loops;
/// bit-identical.
DentWeights dent_weights(const glm::dvec3& s) {
    constexpr double c = binomial(dent_degree, dent_middle);
    const glm::dvec3 rest = 1.0 - s, left = s * s, right = rest * rest;
    return {c * left * right, c * (2.0 * s * right - 2.0 * left * rest)};
}

/// Returns the largest value of B_i^n on 0..1, attained at s = i / n.
double peak(int n, int i) { return bernstein(n, i, static_cast<double>(i) / n).value; }

/// Returns a bound of the largest |derivative| of B_i^n: the maximum over a fine grid plus the
/// error bound of the grid.
double steepest(int n, int i) {
    constexpr int steps = 512;
    double most = 0.0;
    for (int k = 0; k <= steps; ++k)
        most = std::max(most, std::abs(bernstein(n, i, static_cast<double>(k) / steps).derivative));
    // The second derivative of a Bernstein polynomial is below 4 n^2 on 0..1.
    return most + 4.0 * n * n / steps;
}

}  // namespace

FreeForm::FreeForm(const glm::dvec3& corner, const glm::dvec3& size, std::array<int, 3> degree,
                   std::vector<Displaced> displaced)
    : corner_(corner), size_(size), degree_(degree), displaced_(std::move(displaced)) {
    for (int axis = 0; axis < 3; ++axis) {
        if (degree_[static_cast<std::size_t>(axis)] < 1 ||
            degree_[static_cast<std::size_t>(axis)] > highest_degree)
            throw std::invalid_argument("degree is outside 1..7");
        if (!(size_[axis] > 0.0)) throw std::invalid_argument("the box is empty");
        for (const Displaced& d : displaced_)
            if (d.index[static_cast<std::size_t>(axis)] < 0 ||
                d.index[static_cast<std::size_t>(axis)] > degree_[static_cast<std::size_t>(axis)])
                throw std::invalid_argument("a control point lies outside the lattice");
    }
    std::erase_if(displaced_, [](const Displaced& d) { return d.by == glm::dvec3(0.0); });
    is_dent_ =
        degree_ == dent_degrees && displaced_.size() == 1 && displaced_.front().index == dent_index;
}

void FreeForm::apply(std::span<SurfacePoint> points) const {
    if (!is_dent_) {
        for (SurfacePoint& point : points) apply(point.position, point.meridian, point.azimuth);
        return;
    }
    const glm::dvec3 by = displaced_.front().by, none(0.0);
    for (SurfacePoint& point : points) {
        if (!contains(point.position)) continue;
        const auto [value, derivative] = dent_weights((point.position - corner_) / size_);
        // The general form starts its sums at zero; adding zero is not omitted here, because it
        // affects the sign of a zero.
        const glm::dvec3 by_x = (none + derivative.x * value.y * value.z * by) / size_.x,
                         by_y = (none + value.x * derivative.y * value.z * by) / size_.y,
                         by_z = (none + value.x * value.y * derivative.z * by) / size_.z;
        point.position += none + value.x * value.y * value.z * by;
        for (glm::dvec3* v : {&point.meridian, &point.azimuth})
            *v += v->x * by_x + v->y * by_y + v->z * by_z;
    }
}

void FreeForm::apply(std::span<glm::dvec3> places) const {
    if (!is_dent_) {
        glm::dvec3 none(0.0), other(0.0);
        for (glm::dvec3& place : places) apply(place, none, other);
        return;
    }
    const glm::dvec3 by = displaced_.front().by, none(0.0);
    for (glm::dvec3& place : places) {
        if (!contains(place)) continue;
        const glm::dvec3 value = dent_weights((place - corner_) / size_).value;
        place += none + value.x * value.y * value.z * by;
    }
}

void FreeForm::move(glm::dvec3& p, glm::dvec3& first, glm::dvec3& second) const {
    const glm::dvec3 s = (p - corner_) / size_;
    glm::dvec3 offset(0.0), by_x(0.0), by_y(0.0), by_z(0.0);
    for (const Displaced& d : displaced_) {
        const Weight x = bernstein(degree_[0], d.index[0], s.x),
                     y = bernstein(degree_[1], d.index[1], s.y),
                     z = bernstein(degree_[2], d.index[2], s.z);
        offset += x.value * y.value * z.value * d.by;
        by_x += x.derivative * y.value * z.value * d.by;
        by_y += x.value * y.derivative * z.value * d.by;
        by_z += x.value * y.value * z.derivative * d.by;
    }
    by_x /= size_.x;
    by_y /= size_.y;
    by_z /= size_.z;
    p += offset;
    first += first.x * by_x + first.y * by_y + first.z * by_z;
    second += second.x * by_x + second.y * by_y + second.z * by_z;
}

double FreeForm::stretch_bound() const {
    double squares = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        double along = 0.0;
        for (const Displaced& d : displaced_) {
            double weight = 1.0;
            for (int other = 0; other < 3; ++other) {
                const int n = degree_[static_cast<std::size_t>(other)],
                          i = d.index[static_cast<std::size_t>(other)];
                weight *= other == axis ? steepest(n, i) : peak(n, i);
            }
            along += weight * std::sqrt(glm::dot(d.by, d.by));
        }
        along /= size_[axis];
        squares += along * along;
    }
    // The Frobenius norm of the Jacobian of the displacement bounds its operator norm.
    return std::sqrt(squares);
}

FreeForm dent(const glm::dvec3& centre, const glm::dvec3& size, const glm::dvec3& push) {
    constexpr double share = (6.0 / 16.0) * (6.0 / 16.0) * (6.0 / 16.0);  // B_2^4(1/2) cubed
    // For this lattice the bound of stretch_bound() is |push| * 1.1858 / 0.375 / size per axis; it
    // is limited to 0.7.
    const glm::dvec3 steep = glm::dvec3(1.20 / 0.375) / size;
    const double bound = std::sqrt(glm::dot(push, push)) * std::sqrt(glm::dot(steep, steep));
    const double keep = bound > 0.7 ? 0.7 / bound : 1.0;
    return FreeForm(centre - 0.5 * size, size, dent_degrees, {{dent_index, push * (keep / share)}});
}

}  // namespace sporeprint
