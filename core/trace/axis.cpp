#include "core/trace/axis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/math/elementary.h"

namespace sporeprint::trace {

namespace {

constexpr std::size_t stations = 64;

/// Stations that are wider than this many times the width of the narrow third are in the cap.
constexpr double most_width = 1.95, narrow_share = 0.35;

/// Middles are so far above the foot, of the width of the stem.
constexpr double below_middles = 0.35;

/// Weight of the drawn line beside a middle, which keeps the curve from running away where few count.
constexpr double pull = 0.12;

constexpr int rounds = 4;

/// Distance from the curve at which a middle counts half, in lengths of the line.
constexpr double half_weight = 0.012;

/// Returns the turn of a vector by a right angle, to the right of one that points up on the photograph.
glm::dvec2 to_right(const glm::dvec2& up) { return {-up.y, up.x}; }

/// A polynomial of a degree up to 3.
struct Polynomial {
    std::array<double, 4> factors{};

    [[nodiscard]] double at(double s) const {
        return factors[0] + s * (factors[1] + s * (factors[2] + s * factors[3]));
    }
    [[nodiscard]] double slope(double s) const {
        return factors[1] + s * (2.0 * factors[2] + 3.0 * s * factors[3]);
    }
};

/// An observed distance from the chord.
struct Middle {
    double s = 0.0, away = 0.0, weight = 1.0;
};

/// Returns the polynomial with the least weighted squares.
///
/// degree  1..3
Polynomial fitted(const std::vector<Middle>& middles, std::size_t degree) {
    const std::size_t n = degree + 1;
    std::array<std::array<double, 5>, 4> rows{};
    for (const Middle& one : middles) {
        std::array<double, 4> powers{1.0, one.s, one.s * one.s, one.s * one.s * one.s};
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t k = 0; k < n; ++k) rows[i][k] += one.weight * powers[i] * powers[k];
            rows[i][4] += one.weight * powers[i] * one.away;
        }
    }
    // Gauss elimination with the greatest pivot of each column.
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t best = i;
        for (std::size_t k = i + 1; k < n; ++k)
            if (std::abs(rows[k][i]) > std::abs(rows[best][i])) best = k;
        std::swap(rows[i], rows[best]);
        if (std::abs(rows[i][i]) < 1e-12) continue;
        for (std::size_t k = 0; k < n; ++k) {
            if (k == i) continue;
            const double factor = rows[k][i] / rows[i][i];
            for (std::size_t j = i; j < 5; ++j) rows[k][j] -= factor * rows[i][j];
        }
    }
    Polynomial found;
    for (std::size_t i = 0; i < n; ++i)
        if (std::abs(rows[i][i]) >= 1e-12) found.factors[i] = rows[i][4] / rows[i][i];
    return found;
}

/// The frame in which the axis is a function: along the chord of the drawn line and to its right.
struct Chord {
    glm::dvec2 from, along, right;
    double length;

    Chord(const glm::dvec2& foot, const glm::dvec2& top)
        : from(foot), along(0.0, -1.0), right(1.0, 0.0), length(glm::length(top - foot)) {
        if (length <= 0.0) return;
        along = (top - foot) / length;
        right = to_right(along);
    }
    [[nodiscard]] glm::dvec2 point(double s, double away) const {
        return from + along * (s * length) + right * (away * length);
    }
    /// Returns a point's share of the chord and its distance to the right, in lengths of the chord.
    [[nodiscard]] glm::dvec2 local(const glm::dvec2& point) const {
        const glm::dvec2 off = point - from;
        return glm::dvec2(glm::dot(off, along), glm::dot(off, right)) / std::max(length, 1e-9);
    }
};

/// Returns how far a drawn line is to the right of its chord at a share of it.
double drawn_at(const std::vector<glm::dvec2>& line, double s) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const glm::dvec2 &a = line[i], &b = line[i + 1];
        if ((s < a.x) == (s < b.x)) continue;
        return a.y + (b.y - a.y) * (s - a.x) / (b.x - a.x);
    }
    return s <= 0.5 ? line.front().y : line.back().y;
}

/// Returns the middles between both sides of a stem on rays square to a curve, without those in the cap.
///
/// stem_end  share of the chord where the stem ends, or 1
std::vector<Middle> stem_middles(const Contour& contour, const Chord& chord,
                                 const Polynomial& curve, double stem_end) {
    std::vector<Middle> found;
    std::vector<double> widths;
    for (std::size_t k = 0; k < stations; ++k) {
        const double s = 0.02 + 0.96 * static_cast<double>(k) / (stations - 1.0);
        const glm::dvec2 at = chord.point(s, curve.at(s));
        const double slope = curve.slope(s);
        const glm::dvec2 right =
            to_right((chord.along + slope * chord.right) / std::sqrt(1.0 + slope * slope));
        const auto on_right = first_hit(contour, at, right),
                   on_left = first_hit(contour, at, -right);
        if (!on_right || !on_left) continue;
        const glm::dvec2 middle = chord.local(at + 0.5 * (*on_right - *on_left) * right);
        found.push_back({middle.x, middle.y, 1.0});
        widths.push_back(*on_right + *on_left);
    }
    if (found.empty()) return found;
    std::vector<double> sorted = widths;
    std::sort(sorted.begin(), sorted.end());
    const double narrow =
        sorted[static_cast<std::size_t>(narrow_share * static_cast<double>(sorted.size() - 1))];
    // Rays near the end of a stem may leave it through its foot.
    const double widest = most_width * narrow,
                 lowest = std::min(below_middles * narrow / std::max(chord.length, 1e-9), 0.1);
    std::vector<Middle> usable;
    for (std::size_t i = 0; i < found.size(); ++i)
        if (widths[i] <= widest && found[i].s <= stem_end && found[i].s >= lowest)
            usable.push_back(found[i]);
    std::sort(usable.begin(), usable.end(),
              [](const Middle& a, const Middle& b) { return a.s < b.s; });
    return usable;
}

/// Lets middles count less the farther they are from a curve.
void weigh(std::vector<Middle>& middles, const Polynomial& curve) {
    for (Middle& one : middles) {
        const double off = (one.away - curve.at(one.s)) / half_weight;
        one.weight = 1.0 / (1.0 + off * off);
    }
}

/// Returns the smooth part of what a curve leaves of its middles: stems wave more often than a cubic.
double wave_at(const std::vector<Middle>& middles, const Polynomial& curve, double s) {
    constexpr double reach = 0.045;  // of the chord
    double sum = 0.0, weights = 0.05;
    for (const Middle& one : middles) {
        const double away = (one.s - s) / reach;
        const double weight = one.weight * exponential(-0.5 * away * away);
        sum += weight * (one.away - curve.at(one.s));
        weights += weight;
    }
    return sum / weights;
}

/// Returns the middle of the lowest part of a contour along a direction.
///
/// part  share of the length
glm::dvec2 foot_of(const Contour& contour, const glm::dvec2& up, double length, double part) {
    double lowest = 1e300;
    for (const glm::dvec2& point : contour) lowest = std::min(lowest, glm::dot(point, up));
    const glm::dvec2 right = to_right(up);
    double least = 1e300, most = -1e300;
    for (const glm::dvec2& point : contour) {
        if (glm::dot(point, up) > lowest + part * length) continue;
        least = std::min(least, glm::dot(point, right));
        most = std::max(most, glm::dot(point, right));
    }
    return lowest * up + 0.5 * (least + most) * right;
}

}  // namespace

TracedAxis::TracedAxis(std::vector<glm::dvec2> points)
    : points_(std::move(points)), arcs_(arc_lengths(points_)) {}

std::size_t TracedAxis::segment(double arc) const {
    const auto after = std::upper_bound(arcs_.begin() + 1, arcs_.end() - 1, arc);
    return static_cast<std::size_t>(after - arcs_.begin()) - 1;
}

glm::dvec2 TracedAxis::at(double arc) const {
    const std::size_t i = segment(arc);
    const double step = arcs_[i + 1] - arcs_[i];
    return points_[i] + (points_[i + 1] - points_[i]) * ((arc - arcs_[i]) / std::max(step, 1e-12));
}

glm::dvec2 TracedAxis::tangent(double arc) const {
    const std::size_t i = segment(arc);
    return (points_[i + 1] - points_[i]) / std::max(arcs_[i + 1] - arcs_[i], 1e-12);
}

glm::dvec2 TracedAxis::beside(double right, double arc) const {
    return at(arc) + right * to_right(tangent(arc));
}

glm::dvec2 TracedAxis::local(const glm::dvec2& point) const {
    double nearest = 1e300;
    glm::dvec2 found(0.0);
    for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
        const double step = arcs_[i + 1] - arcs_[i];
        if (step <= 0.0) continue;
        const glm::dvec2 along = (points_[i + 1] - points_[i]) / step, off = point - points_[i];
        double arc = glm::dot(off, along);
        // The ends go straight on.
        if (i > 0) arc = std::max(arc, 0.0);
        if (i + 2 < points_.size()) arc = std::min(arc, step);
        const glm::dvec2 away = off - arc * along;
        const double square = glm::dot(away, away);
        if (square >= nearest) continue;
        nearest = square;
        const double side = glm::dot(away, to_right(along));
        found = {side >= 0.0 ? std::sqrt(square) : -std::sqrt(square), arcs_[i] + arc};
    }
    return found;
}

TracedAxis axis_of(const Contour& contour, const Stroke& drawn,
                   const std::optional<glm::dvec2>& top) {
    const glm::dvec2 drawn_up = Chord(drawn.front(), drawn.back()).along;
    const double reach = glm::length(drawn.back() - drawn.front());
    const glm::dvec2 foot = foot_of(contour, drawn_up, reach, 0.025);
    const Chord chord(foot, drawn.back());
    std::vector<glm::dvec2> line;
    for (const glm::dvec2& point : drawn) line.push_back(chord.local(point));

    Polynomial curve;
    {
        std::vector<Middle> hand;
        for (std::size_t k = 0; k < stations; ++k) {
            const double s = static_cast<double>(k) / (stations - 1.0);
            hand.push_back({s, drawn_at(line, s), 1.0});
        }
        curve = fitted(hand, std::min<std::size_t>(3, std::max<std::size_t>(line.size() - 1, 1)));
    }
    const double stem_end = top ? chord.local(*top).x : 1.0;
    double last_usable = 1.0;
    std::vector<Middle> middles;
    for (int round = 0; round < rounds; ++round) {
        middles = stem_middles(contour, chord, curve, stem_end);
        if (middles.empty()) break;
        last_usable = middles.back().s;
        const std::size_t usable = middles.size();
        // In the first round the curve is the drawn line, which is not to be trusted so far.
        if (round > 0) weigh(middles, curve);
        std::vector<Middle> all = middles;
        for (std::size_t k = 0; k < stations; ++k) {
            const double s = static_cast<double>(k) / (stations - 1.0);
            all.push_back({s, drawn_at(line, s), pull * (s > last_usable ? 0.3 : 1.0)});
        }
        curve = fitted(all, usable > 22 ? 3 : usable > 14 ? 2 : 1);
    }
    std::vector<glm::dvec2> points;
    constexpr int steps = 48;
    for (int k = 0; k <= steps; ++k) {
        const double s = last_usable * k / steps;
        points.push_back(chord.point(s, curve.at(s) + wave_at(middles, curve, s)));
    }
    // Straight on through the cap, until the axis leaves it.
    const TracedAxis stem(points);
    const glm::dvec2 up = stem.tangent(stem.length());
    if (const auto cap = first_hit(contour, points.back(), up); cap && *cap > 1e-6)
        points.push_back(points.back() + *cap * up);
    return TracedAxis(std::move(points));
}

TracedAxis straight_axis(const Contour& contour, const Stroke& drawn) {
    glm::dvec2 sum(0.0);
    double area = 0.0;
    const glm::dvec2 origin = contour.front();
    for (std::size_t i = 0; i < contour.size(); ++i) {
        const glm::dvec2 a = contour[i] - origin, b = contour[(i + 1) % contour.size()] - origin;
        const double twice = a.x * b.y - a.y * b.x;
        area += twice;
        sum += twice / 3.0 * (a + b);
    }
    const glm::dvec2 middle = origin + sum / (std::abs(area) < 1e-9 ? 1e-9 : area);
    const Chord rough(drawn.front(), middle);
    const glm::dvec2 foot = foot_of(contour, rough.along, rough.length, 0.15);
    const Chord chord(foot, middle);
    const double beyond = first_hit(contour, middle, chord.along).value_or(0.0);
    return TracedAxis({foot, middle, middle + std::max(beyond, 1e-6) * chord.along});
}

}  // namespace sporeprint::trace
