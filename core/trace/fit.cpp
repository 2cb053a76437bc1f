#include "core/trace/fit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/individual/axis_curve.h"
#include "core/math/elementary.h"
#include "core/math/spline.h"
#include "core/problems.h"
#include "core/silhouette/morph_set.h"
#include "core/silhouette/outline.h"

namespace sporeprint::trace {

namespace {

/// Greatest error of a part, of the height, and most points of it.
constexpr double most_error = 0.004;
constexpr std::size_t most_points = 10;

/// Points of what is not on the photograph.
constexpr std::size_t hidden_points = 6;

/// How much a turn of all of a part counts beside its length where points are placed.
constexpr double turning_weight = 0.7;

/// Depths of the root's tip and of its side below the ground, of the height, and the side's share of the
/// radius there.
constexpr double root_tip = 0.035, root_side = 0.019, root_radius = 0.82;

/// The sharpest bend of an axis, as its curvature times the stem's radius; at 1 the stem would fold.
constexpr double sharpest = 0.8;

using Part = std::vector<glm::dvec2>;

/// Returns how far each point of a part is along it, by length and turning, 0..1.
std::vector<double> measure_of(const Part& part) {
    const std::vector<double> lengths = arc_lengths(part);
    std::vector<double> turns{0.0};
    for (std::size_t i = 1; i < part.size(); ++i) {
        double turn = 0.0;
        if (i + 1 < part.size()) {
            const glm::dvec2 step = part[i] - part[i - 1], next = part[i + 1] - part[i];
            turn = std::abs(arc_tangent(step.x * next.y - step.y * next.x, glm::dot(step, next)));
        }
        turns.push_back(turns.back() + turn);
    }
    std::vector<double> measure(part.size());
    for (std::size_t i = 0; i < part.size(); ++i) {
        const double length = lengths.back() > 0.0 ? lengths[i] / lengths.back() : 0.0,
                     turn = turns.back() > 0.0 ? turns[i] / turns.back() : 0.0;
        measure[i] = (length + turning_weight * turn) / (1.0 + turning_weight);
    }
    return measure;
}

/// Returns some points of a part, evenly spaced by its measure, with both ends.
Part chosen(const Part& part, std::size_t count) {
    const std::vector<double> measure = measure_of(part);
    Part points{part.front()};
    std::size_t i = 0;
    for (std::size_t k = 1; k + 1 < count; ++k) {
        const double target =
            measure.back() * static_cast<double>(k) / (static_cast<double>(count) - 1.0);
        while (i + 2 < part.size() && measure[i + 1] < target) ++i;
        const double step = measure[i + 1] - measure[i];
        points.push_back(part[i] + (part[i + 1] - part[i]) *
                                       (step > 0.0 ? (target - measure[i]) / step : 0.0));
    }
    points.push_back(part.back());
    return points;
}

double distance_to(const Part& line, const glm::dvec2& point) {
    double least = 1e300;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
        least = std::min(least, distance_from_segment(point, line[i], line[i + 1]));
    return least;
}

/// The three parts of an outline as control points.
struct Controls {
    Part stem, face, cap;
    bool has_corner = true;

    [[nodiscard]] Silhouette silhouette(double scale) const {
        const auto list = [&](const Part& part) {
            std::vector<OutlinePoint> points;
            for (const glm::dvec2& at : part) points.push_back({at.x * scale, at.y * scale});
            return points;
        };
        Silhouette made{list(stem), list(face), list(cap), Join::corner, Join::corner};
        if (!has_corner) made.junction = Join::smooth;
        made.stem.front().r = made.cap.back().r = 0.0;
        return made;
    }
};

/// Returns the greatest distance of the points of a part from a curve.
double error_of(const Part& part, const SubCurve& curve, double scale) {
    Part line;
    constexpr int steps = 160;
    for (int k = 0; k <= steps; ++k) {
        const OutlineSample at = curve.at(static_cast<double>(k) / steps);
        line.emplace_back(at.r / scale, at.y / scale);
    }
    double greatest = 0.0;
    for (const glm::dvec2& point : part) greatest = std::max(greatest, distance_to(line, point));
    return greatest;
}

/// Returns the stem with a root below the ground.
Part with_root(const Part& stem, double height) {
    Part points{{0.0, -root_tip * height}, {root_radius * stem.front().x, -root_side * height}};
    points.insert(points.end(), stem.begin(), stem.end());
    return points;
}

/// Returns the axis from the tip of the root to the top of the stem, with the direction of the cap there.
///
/// root    depth of that tip below the foot, pixels
/// radius  of the stem at its top: the axis bends towards the cap no more sharply than it allows
std::vector<AxisPoint> axis_points(const TracedAxis& axis, const Marks& marks, double root,
                                   double radius) {
    constexpr int lower = 9, upper = 6;  // steps below the last part and in it
    constexpr double least_reach = 0.2, most_reach = 0.6, spare = 1.5;
    const double length = marks.stem_top + root;
    const glm::dvec2 from = axis.at(-root);
    // The last part moves aside by turn (u^3 - u^2): its end stays, and turns.
    const double tangent = sine(radians(marks.cap_turn_deg)) / cosine(radians(marks.cap_turn_deg));
    const double wanted = std::max(least_reach * length, 4.0 * spare * radius * std::abs(tangent));
    const double reach = std::min(wanted, most_reach * length), turn = tangent * reach / wanted;
    std::vector<AxisPoint> points;
    for (int k = 0; k <= lower + upper; ++k) {
        const double arc = k < lower ? -root + (length - reach) * k / lower
                                     : marks.stem_top - reach * (lower + upper - k) / upper;
        const double u = std::max(1.0 - (marks.stem_top - arc) / reach, 0.0);
        const glm::dvec2 at = axis.beside(turn * reach * u * u * (u - 1.0), arc);
        points.push_back({(at.x - from.x) / length, (from.y - at.y) / length, 0.0});
    }
    return points;
}

/// Returns the greatest curvature of an axis of unit length: of its spline, and of what grows from it, which turns
/// where the spline goes back the way it came.
double curvature_of(const std::vector<AxisPoint>& axis) {
    std::vector<glm::dvec3> points;
    points.reserve(axis.size());
    for (const AxisPoint& at : axis) points.emplace_back(at.x, at.y, at.z);
    double greatest = AxisCurve(axis).greatest_turn();
    for (const SplineSegment<glm::dvec3>& segment : open_spline(points))
        for (int k = 0; k <= 4; ++k) {
            const SplineSample<glm::dvec3> at = segment.at(0.25 * k);
            const double speed = glm::length(at.derivative);
            if (speed > 1e-9)
                greatest = std::max(greatest,
                                    glm::length(glm::cross(at.derivative, at.second_derivative)) /
                                        (speed * speed * speed));
        }
    return greatest;
}

/// Returns an axis whose deviation from the line between its ends is a share of what it was.
std::vector<AxisPoint> straighter(const std::vector<AxisPoint>& axis, double share) {
    std::vector<AxisPoint> points = axis;
    const AxisPoint &from = axis.front(), &to = axis.back();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(points.size() - 1);
        points[i].x = share * points[i].x + (1.0 - share) * (from.x + t * (to.x - from.x));
        points[i].y = share * points[i].y + (1.0 - share) * (from.y + t * (to.y - from.y));
    }
    return points;
}

/// Where an outline has its parts, in one unit: distances from the axis and heights.
struct Landmarks {
    glm::dvec2 junction, margin, apex;
};

Landmarks landmarks_of(const Part& stem, const Part& face, const Part& cap) {
    const auto wider = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x; };
    const auto higher = [](const glm::dvec2& a, const glm::dvec2& b) { return a.y < b.y; };
    return {stem.back(),
            face.empty() ? *std::max_element(cap.begin(), cap.end(), wider) : face.back(),
            *std::max_element(cap.begin(), cap.end(), higher)};
}

Part points_of(const SubCurve& curve) {
    Part line;
    if (curve.empty()) return line;
    constexpr int steps = 160;
    line.reserve(steps + 1);
    for (int k = 0; k <= steps; ++k) {
        const OutlineSample at = curve.at(static_cast<double>(k) / steps);
        line.emplace_back(at.r, at.y);
    }
    return line;
}

/// A rising map of numbers from 0 on, through nodes.
class RisingMap {
  public:
    /// nodes  pairs of numbers; those that are not in the same order in both, or near another, do not count, but
    ///        the last one, which is greater than 0
    /// least  distance of those that count, of the last one
    explicit RisingMap(std::vector<glm::dvec2> nodes, double least = 0.03) : nodes_{{0.0, 0.0}} {
        const glm::dvec2 last = nodes.back(), gap = least * last;
        nodes.pop_back();
        std::sort(nodes.begin(), nodes.end(),
                  [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x; });
        for (const glm::dvec2& node : nodes) {
            const glm::dvec2 below = node - nodes_.back() - gap, above = last - node - gap;
            if (std::min({below.x, below.y, above.x, above.y}) > 0.0) nodes_.push_back(node);
        }
        nodes_.push_back(last);
    }

    /// Beyond both ends it goes straight on.
    [[nodiscard]] double at(double from) const {
        std::size_t i = 0;
        while (i + 2 < nodes_.size() && nodes_[i + 1].x <= from) ++i;
        const glm::dvec2 &a = nodes_[i], &b = nodes_[i + 1];
        return a.y + (b.y - a.y) * (from - a.x) / (b.x - a.x);
    }

  private:
    std::vector<glm::dvec2> nodes_;
};

/// A map of one outline to another: distances from the axis, and heights, to those that rise with them.
class Stretch {
  public:
    Stretch(const Landmarks& from, const Landmarks& to)
        : size_(to.apex.y / from.apex.y),
          out_({{from.junction.x, to.junction.x}, {from.margin.x, to.margin.x}}),
          up_({{from.junction.y, to.junction.y},
               {from.margin.y, to.margin.y},
               {from.apex.y, to.apex.y}}) {}

    /// Returns a silhouette that is moved by a share of the map, 0..1; at 0 it is another size of the same one.
    [[nodiscard]] Silhouette of(const Silhouette& other, double share) const {
        Silhouette made = other;
        for (auto* part : {&made.stem, &made.hymenium, &made.cap})
            for (OutlinePoint& point : *part) {
                const double r = size_ * point.r, y = size_ * point.y;
                // The root is under the ground.
                const double up = point.y > 0.0 ? up_.at(point.y) : y;
                point = {r + share * (out_.at(point.r) - r), y + share * (up - y)};
            }
        return made;
    }

  private:
    double size_;
    RisingMap out_, up_;
};

}  // namespace

FittedShape stretched_shape(const Silhouette& other, const Profile& profile, const TracedAxis& axis,
                            const Marks& marks, double height, double height_m, double share) {
    const double scale = height_m / height;
    const auto in_metres = [scale](Part part) {
        for (glm::dvec2& at : part) at *= scale;
        return part;
    };
    const Outline from = Outline::unproven(other, "/template");
    const Stretch stretch(
        landmarks_of(points_of(from.stem), points_of(from.hymenium), points_of(from.cap)),
        landmarks_of(in_metres(profile.stem), in_metres(profile.face), in_metres(profile.cap)));
    FittedShape found;
    for (;; share = share > 0.2 ? 0.5 * share : 0.0) {
        found.silhouette = stretch.of(other, share);
        try {
            const Outline outline(found.silhouette, "/silhouette");
            // The rings of all levels of detail stay apart too.
            static_cast<void>(MorphSet({{found.silhouette, height_m, 0, 0.6}}));
            const Part seen(profile.cap.begin(),
                            profile.cap.begin() + static_cast<std::ptrdiff_t>(profile.seen));
            found.error = std::max(error_of(profile.stem, outline.stem, scale),
                                   error_of(seen, outline.cap, scale));
            if (!profile.face.empty())
                found.error =
                    std::max(found.error, error_of(profile.face, outline.hymenium, scale));
            found.error /= height;
            break;
        } catch (const Impossible&) {
            if (share == 0.0) throw;
        }
    }
    found.axis = axis_points(axis, marks, std::max(-found.silhouette.stem.front().y, 0.0) / scale,
                             found.silhouette.stem.back().r / scale);
    return found;
}

FittedShape fitted_shape(const Profile& profile, const TracedAxis& axis, const Marks& marks,
                         double height, double height_m) {
    const double scale = height_m / height;
    Controls controls;
    controls.has_corner = profile.has_corner;
    const auto end = profile.cap.begin() + static_cast<std::ptrdiff_t>(profile.seen);
    const Part seen(profile.cap.begin(), end);
    Part hidden;
    if (end != profile.cap.end()) {
        hidden = chosen(Part(end - 1, profile.cap.end()), hidden_points);
        hidden.erase(hidden.begin());
    }
    std::size_t stem = 5, face = 4, cap = seen.size() > 1 && !hidden.empty() ? 3 : 5;
    FittedShape found;
    while (true) {
        controls.stem = chosen(profile.stem, stem);
        if (!profile.has_foot) controls.stem = with_root(controls.stem, height);
        if (!profile.face.empty()) controls.face = chosen(profile.face, face);
        controls.cap = seen.size() > 1 ? chosen(seen, cap) : seen;
        controls.cap.insert(controls.cap.end(), hidden.begin(), hidden.end());
        found.silhouette = controls.silhouette(scale);
        Outline outline;
        try {
            outline = Outline::unproven(found.silhouette, "/silhouette");
        } catch (const Impossible&) {
            // A spline through few points may swing through the axis where one through more does not.
            if (std::min({stem, face, cap}) >= most_points) throw;
            for (std::size_t* count : {&stem, &face, &cap})
                *count = std::min(*count + 1, most_points);
            continue;
        }
        const double of_stem = error_of(profile.stem, outline.stem, scale),
                     of_face = profile.face.empty()
                                   ? 0.0
                                   : error_of(profile.face, outline.hymenium, scale),
                     of_cap = error_of(seen, outline.cap, scale);
        found.error = std::max({of_stem, of_face, of_cap}) / height;
        bool grown = false;
        const auto grow = [&](std::size_t& count, double error) {
            if (error <= most_error * height || count >= most_points) return;
            ++count;
            grown = true;
        };
        grow(stem, of_stem);
        grow(face, of_face);
        grow(cap, of_cap);
        if (!grown) break;
    }
    static_cast<void>(Outline(found.silhouette, "/silhouette"));
    found.axis =
        axis_points(axis, marks, profile.has_foot ? 0.0 : root_tip * height, profile.stem.back().x);
    return found;
}

std::vector<AxisPoint> unfolded(const std::vector<AxisPoint>& axis, const Silhouette& silhouette) {
    double radius = 0.0, low = 0.0, high = 0.0;
    for (const OutlinePoint& point : silhouette.stem) {
        radius = std::max(radius, point.r);
        low = std::min(low, point.y);
        high = std::max(high, point.y);
    }
    const double relative = radius / std::max(high - low, 1e-9);
    std::vector<AxisPoint> found = axis;
    for (double share = 1.0; share > 0.01 && curvature_of(found) * relative > sharpest;) {
        share *= 0.75;
        found = straighter(axis, share);
    }
    return found;
}

}  // namespace sporeprint::trace
