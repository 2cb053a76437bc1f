#include "core/trace/marks.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"
#include "core/problems.h"

namespace sporeprint::trace {

namespace {

/// Windows over which the turn of an outline is measured, of the height: at corners, and where there is
/// none.
constexpr double window = 0.02, wide_window = 0.06;

/// A margin is at least so far out, of the greatest distance, and not in the lowest part of the axis.
constexpr double of_greatest = 0.94, not_below = 0.4;

/// A corner is a junction if it is no farther from the axis than these shares of the height and of the
/// distance of the narrowest place below the cap. It is the deepest within a share of the height.
constexpr double near_height = 0.025, near_self = 1.6, snap = 0.03;

/// How far below the margin the narrowest place is looked for, of the height.
constexpr double below_margin = 0.35;

/// How far below that place a corner may be, of the height.
constexpr double below_narrowest = 0.03;

/// A junction with a corner turns by so much at least, and is at most so far from the axis as the margin.
constexpr double corner_deg = 25.0, most_of_margin = 0.8;

/// A stem is at least so long, of the height.
constexpr double least_stem = 0.01;

/// Returns the points of a contour from one of them to another, forwards or backwards.
std::vector<glm::dvec2> walked(const Contour& contour, std::size_t from, std::size_t to,
                               bool forwards) {
    std::vector<glm::dvec2> points{contour[from]};
    const std::size_t count = contour.size();
    for (std::size_t i = from; i != to;) {
        i = forwards ? (i + 1) % count : (i + count - 1) % count;
        points.push_back(contour[i]);
    }
    return points;
}

std::size_t nearest_to(const Contour& contour, const glm::dvec2& point) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < contour.size(); ++i)
        if (glm::dot(contour[i] - point, contour[i] - point) <
            glm::dot(contour[best] - point, contour[best] - point))
            best = i;
    return best;
}

/// Measures turns along one side.
class Turns {
  public:
    /// side  -1 for the left and 1 for the right of the axis
    Turns(const std::vector<glm::dvec2>& points, double side, double reach)
        : points_(points), arcs_(arc_lengths(points)), side_(side), reach_(reach) {}

    /// Returns the turn at a point, degrees: positive where the mushroom is convex.
    [[nodiscard]] double at(std::size_t i) const {
        const std::size_t before = index(arcs_[i] - reach_), after = index(arcs_[i] + reach_);
        if (before == i || after == i) return 0.0;
        const glm::dvec2 in = points_[i] - points_[before], out = points_[after] - points_[i];
        const double turn =
            arc_tangent(in.x * out.y - in.y * out.x, glm::dot(in, out)) * (180.0 / pi);
        // Up on the right side, the outline turns to the left round what is convex; y is down.
        return -side_ * turn;
    }
    [[nodiscard]] double arc(std::size_t i) const { return arcs_[i]; }
    [[nodiscard]] std::size_t index(double arc) const {
        const auto after = std::lower_bound(arcs_.begin(), arcs_.end(), arc);
        return after == arcs_.end() ? arcs_.size() - 1
                                    : static_cast<std::size_t>(after - arcs_.begin());
    }

  private:
    const std::vector<glm::dvec2>& points_;
    std::vector<double> arcs_;
    double side_, reach_;
};

/// Marks one side. Returns true if stem and face meet at a corner.
bool mark(ContourSide& side, double sign, double height) {
    const Turns turns(side.points, sign, 0.5 * window * height);
    const std::size_t count = side.points.size();
    // Bulbs are far from the axis too: a margin is not in the lowest part.
    const double lowest = not_below * side.local.back().y;
    std::size_t margin = 0;
    double farthest = 0.0, sharpest = -1e300;
    for (const glm::dvec2& at : side.local)
        if (at.y > lowest) farthest = std::max(farthest, at.x);
    for (std::size_t i = 0; i < count; ++i) {
        if (side.local[i].y <= lowest || side.local[i].x <= of_greatest * farthest) continue;
        const double turn = turns.at(i);
        if (turn <= sharpest) continue;
        sharpest = turn;
        margin = i;
    }
    // The narrowest place of the stem not far below the cap.
    double narrowest = 1e300;
    std::size_t at_narrowest = 0;
    for (std::size_t i = margin; i-- > 0;) {
        if (side.local[i].y < side.local[margin].y - below_margin * height) continue;
        if (side.local[i].x >= narrowest) continue;
        narrowest = side.local[i].x;
        at_narrowest = i;
    }
    // Down from the margin, the first corner that is not far from the axis, at its deepest.
    const double most = near_height * height + near_self * std::max(narrowest, 0.0);
    const double end = turns.arc(at_narrowest) - below_narrowest * height;
    side.margin = margin;
    side.junction = at_narrowest;
    bool has_corner = false;
    double deepest = 0.0;
    for (std::size_t i = margin; i-- > 0 && turns.arc(i) >= end;) {
        if (side.local[i].x > most) continue;
        const double turn = turns.at(i);
        if (has_corner && turns.arc(side.junction) - turns.arc(i) > snap * height) break;
        if (turn >= std::min(deepest, -corner_deg)) continue;
        has_corner = true;
        deepest = turn;
        side.junction = i;
    }
    if (has_corner) return side.local[side.junction].x < most_of_margin * side.local[margin].x;
    const Turns wide(side.points, sign, 0.5 * wide_window * height);
    for (std::size_t i = margin; i-- > 0 && turns.arc(i) >= end;) {
        const double turn = wide.at(i);
        if (side.local[i].x > most_of_margin * side.local[margin].x || turn >= deepest) continue;
        deepest = turn;
        side.junction = i;
    }
    return false;
}

/// The contour of a cap from its left margin over the apex to its right one.
struct CapLine {
    std::vector<glm::dvec2> points;

    explicit CapLine(const std::array<ContourSide, 2>& sides) {
        const auto &left = sides[0], &right = sides[1];
        points.assign(left.points.begin() + static_cast<std::ptrdiff_t>(left.margin),
                      left.points.end());
        // Both sides end at the apex.
        for (std::size_t i = right.points.size() - 1; i-- > right.margin;)
            points.push_back(right.points[i]);
    }

    /// Returns the place where the cap's own axis leaves it, at least one point from both margins.
    [[nodiscard]] std::size_t apex(const CapFrame& frame) const {
        for (std::size_t i = 1; i + 1 < points.size(); ++i)
            if (frame.local(points[i]).x >= 0.0) return i;
        return points.size() - 2;
    }
};

/// Returns the turn of the cap against the axis at which its halves are most alike, degrees.
double turn_of_cap(const Marks& marks, const TracedAxis& axis, double height) {
    constexpr double most = 24.0, step = 1.5, reluctance = 0.02;
    constexpr std::size_t places = 40;
    const CapLine line(marks.sides);
    double best = 0.0, least = 1e300;
    for (double turn = -most; turn <= most + 1e-9; turn += step) {
        const CapFrame frame(axis, marks.stem_top, turn);
        const std::size_t apex = line.apex(frame), last = line.points.size() - 1;
        double sum = 0.0;
        for (std::size_t place = 0; place < places; ++place) {
            // Each half by equal shares of its arc from the margin to the apex.
            const glm::dvec2 a = frame.local(line.points[apex * place / (places - 1)]),
                             b = frame.local(
                                 line.points[last - (last - apex) * place / (places - 1)]);
            const glm::dvec2 apart(a.x + b.x, a.y - b.y);
            sum += glm::dot(apart, apart) / static_cast<double>(places);
        }
        const double bias = 0.1 * height * radians(turn);
        sum += reluctance * bias * bias;
        if (sum >= least) continue;
        least = sum;
        best = turn;
    }
    return best;
}

/// Lets both sides meet where the cap's own axis leaves the cap.
void move_apex(Marks& marks, const TracedAxis& axis) {
    const CapLine line(marks.sides);
    const std::size_t apex = line.apex({axis, marks.stem_top, marks.cap_turn_deg});
    for (std::size_t k = 0; k < 2; ++k) {
        ContourSide& side = marks.sides[k];
        side.points.resize(side.margin + 1);
        side.local.resize(side.margin + 1);
        const auto add = [&](std::size_t i) {
            const glm::dvec2 at = axis.local(line.points[i]);
            side.points.push_back(line.points[i]);
            side.local.emplace_back(k == 0 ? -at.x : at.x, at.y);
        };
        if (k == 0)
            for (std::size_t i = 1; i <= apex; ++i) add(i);
        else
            for (std::size_t i = line.points.size() - 1; i-- > apex;) add(i);
    }
}

}  // namespace

CapFrame::CapFrame(const TracedAxis& axis, double stem_top, double turn_deg)
    : origin(axis.at(stem_top)), right(0.0), up(0.0) {
    const glm::dvec2 along = axis.tangent(stem_top), beside(-along.y, along.x);
    const auto [sine, cosine] = sine_cosine(radians(turn_deg));
    up = cosine * along + sine * beside;
    right = cosine * beside - sine * along;
}

glm::dvec2 CapFrame::local(const glm::dvec2& point) const {
    return {glm::dot(point - origin, right), glm::dot(point - origin, up)};
}

Marks marks_of(const Contour& contour, const TracedAxis& axis, double height) {
    Marks marks;
    const glm::dvec2 low = axis.at(0.02 * axis.length()), down = -axis.tangent(0.0);
    const std::size_t apex = nearest_to(contour, axis.at(axis.length())),
                      foot = nearest_to(contour,
                                        low + first_hit(contour, low, down).value_or(0.0) * down);
    bool corners = true;
    for (std::size_t k = 0; k < 2; ++k) {
        ContourSide& side = marks.sides[k];
        const double sign = k == 0 ? -1.0 : 1.0;
        // The mushroom is on the right hand of the contour, so that its left side goes up.
        side.points = walked(contour, foot, apex, k == 0);
        for (const glm::dvec2& point : side.points) {
            const glm::dvec2 at = axis.local(point);
            side.local.emplace_back(sign * at.x, at.y);
        }
        corners = mark(side, sign, height) && corners;
    }
    const auto &left = marks.sides[0], &right = marks.sides[1];
    const double stem = 0.5 * (left.local[left.junction].x + right.local[right.junction].x),
                 cap = 0.5 * (left.local[left.margin].x + right.local[right.margin].x);
    if (stem >= 0.95 * cap)
        throw InvalidInput("/form", "no cap found: choose club, cup, puffball or bracket");
    marks.has_corner = corners;
    marks.stem_top =
        std::max(0.5 * (left.local[left.junction].y + right.local[right.junction].y), 0.0);
    if (marks.stem_top < least_stem * height)
        throw InvalidInput("/form", "no stem found: choose club, cup, puffball or bracket");
    marks.cap_turn_deg = turn_of_cap(marks, axis, height);
    move_apex(marks, axis);
    return marks;
}

}  // namespace sporeprint::trace
