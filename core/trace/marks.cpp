#include "core/trace/marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/math/elementary.h"
#include "core/problems.h"

namespace sporeprint::trace {

namespace {

/// Windows over which the turn of an outline is measured, of the height: at corners, and where there is
/// none.
constexpr double window = 0.02, wide_window = 0.06;

/// How far turns of edges reach, of the widest radius: so far that no wart is taken for one.
constexpr double edge_reach = 0.25, near_edge_reach = 0.08;

/// A margin is at least so far out, of the greatest distance, and not in the lowest part of the axis.
constexpr double of_greatest = 0.94, not_below = 0.4;

/// A corner is a junction if it is no farther from the axis than these shares of the height and of the
/// distance of the narrowest place below the cap. It is the deepest within a share of the height.
constexpr double near_height = 0.025, near_self = 1.6, snap = 0.03;

/// A margin whose outline turns by less is rolled in. It is where the lower face begins to climb by more than this
/// slope, at least so far out, of the greatest distance.
constexpr double sharp_margin = 50.0, climb = 1.0, of_rolled = 0.7;

/// How far below the margin the narrowest place is looked for, of the height.
constexpr double below_margin = 0.35;

/// How far below that place a corner may be, of the height.
constexpr double below_narrowest = 0.03;

/// A junction with a corner turns by so much at least, and is at most so far from the axis as the margin.
constexpr double corner_deg = 25.0, most_of_margin = 0.8;

/// A stem is at least so long, of the height; and of forms whose stem may be no more than a foot.
constexpr double least_stem = 0.01, least_foot = 0.05;

/// A stem has begun to widen where it is wider than its narrowest place by these factors, under a funnel or a
/// puffball, and under a cup, and by this share of the height.
constexpr double widened = 1.15, widened_cup = 1.5, slack = 0.01;

/// The part of a club that is its stem, of the height; more where the rest bends, for a head is rigid: so much
/// that the halves of the head are nearly alike, of the height.
constexpr std::array<double, 4> club_stems = {0.31, 0.45, 0.6, 0.75};
constexpr double club_halves = 0.008;

/// What tells forms apart. A top is flat if its edges turn by so much at least, or if it rises above the line
/// between them by so little, of their distance; it may rise by more where the edges are sharp.
constexpr double least_edge = 50.0, flat_dome = 0.17, most_dome = 0.33;

/// A club is narrower than this, of the height; a funnel's outer face is steeper than this.
constexpr double widest_club = 0.22, least_slope = 0.5;

/// A cup's outer face begins below this, of the height, and is steeper than this; it bulges in the mean by so
/// much, of its length, or the cup or its foot is so wide, of the height and of the widest radius. With
/// an angle it begins below this height.
constexpr double highest_cup = 0.5, cup_slope = 0.35, least_bulge = 0.03, wide_cup = 0.75,
                 wide_foot = 0.55, highest_corner = 0.3;

/// The edge of a funnel or cup is at least so far out, of the greatest distance.
constexpr double rim_of_greatest = 0.75;

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
    [[nodiscard]] double reach() const { return reach_; }
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

/// Returns the point at a distance along a line from one of its points, forwards or backwards.
glm::dvec2 along(const std::vector<glm::dvec2>& points, std::size_t from, double distance,
                 bool forwards) {
    std::size_t i = from;
    while (forwards ? i + 1 < points.size() : i > 0) {
        const std::size_t next = forwards ? i + 1 : i - 1;
        const double step = glm::length(points[next] - points[i]);
        if (step >= distance && step > 0.0)
            return points[i] + (distance / step) * (points[next] - points[i]);
        distance -= step;
        i = next;
    }
    return points[i];
}

/// Returns the turn at a point of a line whose points are far apart, degrees: as of Turns.
double turn_between(const std::vector<glm::dvec2>& points, double side, std::size_t i,
                    double reach) {
    const glm::dvec2 in = points[i] - along(points, i, reach, false),
                     out = along(points, i, reach, true) - points[i];
    return -side * arc_tangent(in.x * out.y - in.y * out.x, glm::dot(in, out)) * (180.0 / pi);
}

/// Returns where a margin that is rolled in has its lowest place: out from the junction, the first one from which the
/// outline climbs; the margin as it was if there is none.
///
/// least  distance from the axis
std::size_t rolled_margin(const ContourSide& side, const Turns& turns, double least) {
    for (std::size_t i = side.junction + 1; i < side.margin; ++i) {
        if (side.local[i].x < least) continue;
        const glm::dvec2 run = side.local[turns.index(turns.arc(i) + turns.reach())] -
                               side.local[turns.index(turns.arc(i) - turns.reach())];
        if (run.y > climb * run.x) return i;
    }
    return side.margin;
}

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
    if (has_corner) {
        if (sharpest < sharp_margin) side.margin = rolled_margin(side, turns, of_rolled * farthest);
        return side.local[side.junction].x < most_of_margin * side.local[margin].x;
    }
    const Turns wide(side.points, sign, 0.5 * wide_window * height);
    for (std::size_t i = margin; i-- > 0 && turns.arc(i) >= end;) {
        const double turn = wide.at(i);
        if (side.local[i].x > most_of_margin * side.local[margin].x || turn >= deepest) continue;
        deepest = turn;
        side.junction = i;
    }
    return false;
}

/// Returns the farthest place of a side from the axis, not in the lowest part.
std::size_t widest_of(const ContourSide& side) {
    const double lowest = not_below * side.local.back().y;
    std::size_t widest = side.local.size() - 1;
    for (std::size_t i = 0; i < side.local.size(); ++i)
        if (side.local[i].y > lowest && side.local[i].x > side.local[widest].x) widest = i;
    return widest;
}

/// Returns the edge of a mushroom that is open above: the sharpest convex place of its upper, outer part, found
/// from afar and then from near.
std::size_t rim_of(const ContourSide& side, double sign) {
    const double lowest = not_below * side.local.back().y;
    const double farthest = side.local[widest_of(side)].x;
    const Turns afar(side.points, sign, edge_reach * farthest),
        near(side.points, sign, near_edge_reach * farthest);
    const auto sharpest = [&](const Turns& turns, double from, double to) {
        double most = -1e300;
        std::size_t found = side.local.size() - 1;
        for (std::size_t i = turns.index(from); i < side.local.size() && turns.arc(i) <= to; ++i) {
            if (side.local[i].y <= lowest || side.local[i].x <= rim_of_greatest * farthest)
                continue;
            const double turn = turns.at(i);
            if (turn <= most) continue;
            most = turn;
            found = i;
        }
        return found;
    };
    const double arc = afar.arc(sharpest(afar, 0.0, 1e300)), reach = 0.5 * edge_reach * farthest;
    return sharpest(near, arc - reach, arc + reach);
}

/// Returns the last place below another where a side is no wider than its narrowest place by a factor.
std::size_t widening_of(const ContourSide& side, std::size_t below, double factor, double height) {
    double narrowest = 1e300;
    for (std::size_t i = 0; i < below; ++i)
        if (side.local[i].y >= 2.0 * least_foot * height)
            narrowest = std::min(narrowest, side.local[i].x);
    std::size_t i = below;
    while (i > 0 && side.local[i].x > factor * narrowest + slack * height &&
           side.local[i].y > least_foot * height)
        --i;
    return i;
}

/// Marks one side of a mushroom that has a margin without an angle below it, or a head.
void mark_smooth(ContourSide& side, double sign, Form form, double height) {
    if (form == Form::funnel) {
        side.margin = rim_of(side, sign);
        side.junction = widening_of(side, side.margin, widened, height);
    } else if (form == Form::cup) {
        side.margin = rim_of(side, sign);
        side.junction = widening_of(side, side.margin, widened_cup, height);
    } else if (form == Form::puffball) {
        side.margin = side.junction = widening_of(side, widest_of(side), widened, height);
    }
}

/// Marks one side of a club whose stem is a share of its height.
void mark_club(ContourSide& side, double share) {
    const double top = share * side.local.back().y;
    side.junction = 0;
    while (side.junction + 2 < side.local.size() && side.local[side.junction].y < top)
        ++side.junction;
    side.margin = side.junction;
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
        return points.size() - std::min<std::size_t>(points.size(), 2);
    }
};

/// A turn of a cap or head against the axis, degrees, and the mean square of the distances between its halves,
/// square pixels.
struct CapTurn {
    double deg = 0.0, apart = 1e300;
};

/// Returns the turn at which both halves are most alike.
CapTurn turn_of_cap(const Marks& marks, const TracedAxis& axis, double height) {
    constexpr double most = 24.0, step = 1.5, reluctance = 0.02;
    constexpr std::size_t places = 40;
    const CapLine line(marks.sides);
    CapTurn best;
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
        if (sum < best.apart) best = {turn, sum};
    }
    return best;
}

glm::dvec2 middle_of(const CapLine& line) {
    glm::dvec2 middle(0.0);
    for (const glm::dvec2& point : line.points)
        middle += point / static_cast<double>(line.points.size());
    return middle;
}

/// Lets the frame of a cup stand square to its edge, which waves: to the line from which its places are least
/// away.
void square_to_rim(Marks& marks, const TracedAxis& axis) {
    constexpr double most = 24.0;
    const CapLine cap(marks.sides);
    const std::vector<glm::dvec2>& line = cap.points;
    const glm::dvec2 middle = middle_of(cap);
    double across = 0.0, both = 0.0, along = 0.0;
    const CapFrame straight(axis, marks.stem_top, 0.0);
    for (const glm::dvec2& point : line) {
        const glm::dvec2 at = straight.local(point) - straight.local(middle);
        across += at.x * at.x;
        both += at.x * at.y;
        along += at.y * at.y;
    }
    // The edge rises to the right by half of this angle; the frame turns to the left by as much.
    const double rise = 0.5 * arc_tangent(2.0 * both, across - along) * (180.0 / pi);
    marks.cap_turn_deg = std::clamp(-rise, -most, most);
    marks.rim = CapFrame(axis, marks.stem_top, marks.cap_turn_deg).local(middle).y;
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

/// Returns true if the margin is farther out than the stem.
bool has_cap(const Marks& marks) {
    const auto &left = marks.sides[0], &right = marks.sides[1];
    const double stem = 0.5 * (left.local[left.junction].x + right.local[right.junction].x),
                 cap = 0.5 * (left.local[left.margin].x + right.local[right.margin].x);
    return stem < 0.95 * cap;
}

/// A side of fewer points has no parts.
constexpr std::size_t least_points = 8;

/// Returns the sides of a mushroom, marked as those of a capped one.
Marks marked(const Contour& contour, const TracedAxis& axis, double height) {
    Marks marks;
    const glm::dvec2 low = axis.at(0.02 * axis.length()), down = -axis.tangent(0.0);
    const std::size_t apex = nearest_to(contour, axis.at(axis.length())),
                      foot = nearest_to(contour,
                                        low + first_hit(contour, low, down).value_or(0.0) * down);
    for (std::size_t k = 0; k < 2; ++k) {
        ContourSide& side = marks.sides[k];
        const double sign = k == 0 ? -1.0 : 1.0;
        // The mushroom is on the right hand of the contour, so that its left side goes up.
        side.points = walked(contour, foot, apex, k == 0);
        if (side.points.size() < least_points)
            throw InvalidInput("/gesture/axis",
                               "does not lead from the foot of what is on it to its top");
        for (const glm::dvec2& point : side.points) {
            const glm::dvec2 at = axis.local(point);
            side.local.emplace_back(sign * at.x, at.y);
        }
        marks.has_corner = mark(side, sign, height) && marks.has_corner;
    }
    return marks;
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

Form likely_form(const Contour& contour, const TracedAxis& axis, double height) {
    const Marks marks = marked(contour, axis, height);
    double edge = 1e300, widest = 0.0, foot = 0.0, rise = 0.0, run = 0.0, dome = 0.0, bulge = 0.0,
           low = 0.0, corner = 0.0;
    std::array<glm::dvec2, 2> rims{};
    for (std::size_t k = 0; k < 2; ++k) {
        const ContourSide& side = marks.sides[k];
        const double sign = k == 0 ? -1.0 : 1.0, radius = side.local[widest_of(side)].x;
        const std::size_t rim = rim_of(side, sign),
                          face_from = widening_of(side, rim, widened, height),
                          foot_top = widening_of(side, rim, widened_cup, height);
        edge = std::min(edge, Turns(side.points, sign, edge_reach * radius).at(rim));
        rims[k] = side.points[rim];
        widest += 0.5 * radius;
        rise += side.local[rim].y - side.local[face_from].y;
        run += side.local[rim].x - side.local[face_from].x;
        foot += 0.5 * side.local[foot_top].x;
        low += 0.5 * side.local[foot_top].y;
        corner += 0.5 * side.local[side.junction].y;
        const glm::dvec2 from = side.local[face_from], face = side.local[rim] - from;
        const double square = std::max(glm::dot(face, face), 1e-9);
        for (std::size_t i = face_from; i < rim; ++i) {
            const glm::dvec2 off = side.local[i] - from;
            bulge += 0.5 * (face.y * off.x - face.x * off.y) / square /
                     static_cast<double>(rim - face_from);
        }
    }
    const glm::dvec2 chord = rims[1] - rims[0];
    const double width = std::max(glm::length(chord), 1e-9);
    for (const glm::dvec2& point : contour) {
        const glm::dvec2 off = point - rims[0];
        dome = std::max(dome, (chord.y * off.x - chord.x * off.y) / (width * width));
    }
    const bool is_flat = dome <= flat_dome || (edge >= least_edge && dome <= most_dome),
               has_corner =
                   marks.has_corner && has_cap(marks) && corner > 2.0 * least_stem * height;
    if (is_flat && low < highest_cup * height && rise > cup_slope * run &&
        !(has_corner && low > highest_corner * height) &&
        (bulge > least_bulge || foot > wide_foot * widest || widest > wide_cup * height))
        return Form::cup;
    if (has_corner) return Form::capped;
    if (is_flat && rise >= least_slope * run) return Form::funnel;
    if (edge >= least_edge && has_cap(marks)) return Form::capped;
    return widest < widest_club * height ? Form::club : Form::puffball;
}

Marks marks_of(const Contour& contour, const TracedAxis& axis, double height, Form form) {
    Marks marks = marked(contour, axis, height);
    marks.form = form;
    auto &left = marks.sides[0], &right = marks.sides[1];
    if (form == Form::morel) {
        left.margin = left.junction;
        right.margin = right.junction;
    } else if (form == Form::club) {
        marks.has_corner = false;
        for (const double share : club_stems) {
            mark_club(left, share);
            mark_club(right, share);
            marks.stem_top = 0.5 * (left.local[left.junction].y + right.local[right.junction].y);
            const double most = club_halves * height;
            if (turn_of_cap(marks, axis, height).apart < most * most) break;
        }
    } else if (form != Form::capped) {
        marks.has_corner = false;
        mark_smooth(left, -1.0, form, height);
        mark_smooth(right, 1.0, form, height);
    }
    if (form == Form::capped && !has_cap(marks))
        throw InvalidInput("/form",
                           "no cap found: choose funnel, morel, club, puffball, cup or auto");
    marks.stem_top =
        std::max(0.5 * (left.local[left.junction].y + right.local[right.junction].y), 0.0);
    if (marks.stem_top < least_stem * height) {
        if (form == Form::puffball || form == Form::cup)
            throw InvalidInput("/gesture/axis",
                               "no foot found on this line; draw it from the foot to the top");
        throw InvalidInput("/form", "no stem found: choose puffball, cup or auto");
    }
    if (form == Form::cup)
        square_to_rim(marks, axis);
    else
        marks.cap_turn_deg = turn_of_cap(marks, axis, height).deg;
    move_apex(marks, axis);
    return marks;
}

Marks marks_at(std::array<ContourSide, 2> sides, const TracedAxis& axis, double height, Form form,
               std::optional<double> cap_turn_deg) {
    Marks marks;
    marks.form = form;
    marks.sides = std::move(sides);
    marks.has_corner = form == Form::capped || form == Form::morel;
    for (std::size_t k = 0; k < 2; ++k) {
        ContourSide& side = marks.sides[k];
        const double sign = k == 0 ? -1.0 : 1.0;
        side.local.clear();
        side.local.reserve(side.points.size());
        for (const glm::dvec2& point : side.points) {
            const glm::dvec2 at = axis.local(point);
            side.local.emplace_back(sign * at.x, at.y);
        }
        double widest = 0.0;
        for (std::size_t i = side.junction; i < side.local.size(); ++i)
            widest = std::max(widest, side.local[i].x);
        marks.has_corner =
            marks.has_corner && side.local[side.junction].x < most_of_margin * widest &&
            turn_between(side.points, sign, side.junction, 0.5 * window * height) < -corner_deg;
    }
    const auto &left = marks.sides[0], &right = marks.sides[1];
    marks.stem_top =
        std::max(0.5 * (left.local[left.junction].y + right.local[right.junction].y), 0.0);
    if (form == Form::cup) {
        // All of it stands as its edge does.
        marks.rim = CapFrame(axis, marks.stem_top, 0.0).local(middle_of(CapLine(marks.sides))).y;
        marks.cap_turn_deg = cap_turn_deg.value_or(0.0);
    } else {
        marks.cap_turn_deg = cap_turn_deg ? *cap_turn_deg : turn_of_cap(marks, axis, height).deg;
    }
    return marks;
}

}  // namespace sporeprint::trace
