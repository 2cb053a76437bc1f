#include "core/trace/profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"

namespace sporeprint::trace {

namespace {

constexpr std::size_t stem_points = 96, face_points = 64, cap_points = 96;

/// Least distance from the axis between its ends, of the height.
constexpr double thinnest = 1e-3;

/// Height of the lowest ray above the foot, and of the one that tells whether the foot is round, of the height;
/// the share of the upper one's radius that the lower has at most if it is.
constexpr double lowest_ray = 0.012, above_foot = 0.045, round_share = 0.8;

/// A ring is a bulge in this upper share of the stem that is narrower than a share of the height, and
/// stands out by at least these shares of the height and of the stem's radius.
constexpr double upper_stem = 0.65, widest_ring = 0.2, least_of_height = 0.02,
                 least_of_radius = 0.25;

/// Returns the points of a part of a side at equal shares of its arc.
std::vector<glm::dvec2> evenly(const std::vector<glm::dvec2>& points, std::size_t from,
                               std::size_t to, std::size_t count) {
    const std::vector<double> arcs =
        arc_lengths({points.begin() + static_cast<std::ptrdiff_t>(from),
                     points.begin() + static_cast<std::ptrdiff_t>(to) + 1});
    std::vector<glm::dvec2> found;
    std::size_t edge = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const double target =
            arcs.back() * static_cast<double>(k) / (static_cast<double>(count) - 1.0);
        while (edge + 2 < arcs.size() && arcs[edge + 1] < target) ++edge;
        if (arcs.size() < 2) {
            found.push_back(points[from]);
            continue;
        }
        const double step = arcs[edge + 1] - arcs[edge];
        const double t = step > 0.0 ? std::clamp((target - arcs[edge]) / step, 0.0, 1.0) : 0.0;
        const glm::dvec2 &a = points[from + edge], &b = points[from + edge + 1];
        found.push_back(a + t * (b - a));
    }
    return found;
}

/// Returns the least or the greatest value within a distance of each index.
template <class Better>
std::vector<double> extreme(const std::vector<double>& values, std::size_t reach,
                            const Better& better) {
    std::vector<double> found = values;
    for (std::size_t i = 0; i < values.size(); ++i)
        for (std::size_t k = i - std::min(i, reach); k <= std::min(i + reach, values.size() - 1);
             ++k)
            if (better(values[k], found[i])) found[i] = values[k];
    return found;
}

/// Returns the ring on a stem of evenly spaced radii and cuts it out of them.
std::optional<TracedRing> without_ring(std::vector<double>& radii, double step, double height) {
    const auto reach = static_cast<std::size_t>(0.5 * widest_ring * height / step);
    if (reach == 0 || radii.size() <= 2 * reach) return std::nullopt;
    const auto less = [](double a, double b) { return a < b; };
    const auto more = [](double a, double b) { return a > b; };
    const std::vector<double> open = extreme(extreme(radii, reach, less), reach, more);
    std::vector<double> sorted = radii;
    std::sort(sorted.begin(), sorted.end());
    const double least =
        std::max(least_of_height * height, least_of_radius * sorted[sorted.size() / 2]);
    const auto first =
        static_cast<std::size_t>((1.0 - upper_stem) * static_cast<double>(radii.size()));
    std::size_t top = 0;
    for (std::size_t i = std::max<std::size_t>(first, 1); i + 1 < radii.size(); ++i)
        if (radii[i] - open[i] > least && (top == 0 || radii[i] - open[i] > radii[top] - open[top]))
            top = i;
    // The stem goes on above it: what rises up to the end is the lower face.
    if (top == 0 || radii.back() - open.back() > 0.5 * (radii[top] - open[top]))
        return std::nullopt;
    const TracedRing ring{static_cast<double>(top) * step, radii[top] - open[top]};
    std::size_t from = top, to = top;
    while (from > 0 && radii[from] - open[from] > 0.1 * ring.width) --from;
    while (to + 1 < radii.size() && radii[to] - open[to] > 0.1 * ring.width) ++to;
    for (std::size_t i = from; i <= to; ++i) {
        const double t = static_cast<double>(i - from) /
                         static_cast<double>(std::max<std::size_t>(to - from, 1));
        radii[i] = radii[from] + t * (radii[to] - radii[from]);
    }
    return ring;
}

/// Returns the first place of a cap that is nearly as high as any: the edge that hides what is behind it.
std::size_t edge_of(const std::vector<glm::dvec2>& side, std::size_t margin, double height) {
    constexpr double flat = 0.012;  // of the height
    double highest = -1e300;
    for (std::size_t i = margin; i < side.size(); ++i) highest = std::max(highest, side[i].y);
    while (side[margin].y < highest - flat * height) ++margin;
    return margin;
}

/// Returns the inner wall of a funnel or cup from its edge down to the axis: half an ellipse whose width is
/// everywhere that of the outer face at the same height, less a wall that becomes thicker downwards.
///
/// face    outer face from the stem up to the margin
/// edge    where the wall begins, as high as the face or higher
/// bottom  height of its end, between those of the ends of the face
std::vector<glm::dvec2> inner_wall(const std::vector<glm::dvec2>& face, const glm::dvec2& edge,
                                   double bottom) {
    constexpr int steps = 64;
    constexpr double thickness = 0.15;  // of the radius, at the bottom
    // The face as far as it climbs: where it first reaches each height.
    std::vector<glm::dvec2> climb{face.front()};
    for (const glm::dvec2& at : face)
        if (at.y > climb.back().y && at.y < edge.y) climb.push_back(at);
    climb.push_back(edge);
    std::vector<glm::dvec2> wall;
    wall.reserve(steps + 1);
    std::size_t i = climb.size() - 2;
    for (int k = 0; k <= steps; ++k) {
        const auto [sine, cosine] = sine_cosine(0.5 * pi * k / steps);
        const double y = bottom + (edge.y - bottom) * (1.0 - sine);
        while (i > 0 && climb[i].y > y) --i;
        const double step = climb[i + 1].y - climb[i].y;
        const double t = step > 0.0 ? std::clamp((y - climb[i].y) / step, 0.0, 1.0) : 1.0;
        const double outer = climb[i].x + t * (climb[i + 1].x - climb[i].x);
        wall.emplace_back(std::min(outer, edge.x) * cosine * (1.0 - thickness * sine), y);
    }
    return wall;
}

}  // namespace

Profile profile_of(const Contour& contour, const TracedAxis& axis, const Marks& marks,
                   double height, double hollow) {
    Profile profile;
    profile.has_corner = marks.has_corner;
    double apart = 0.0, compared = 0.0;

    // The stem, by rays square to the axis.
    std::vector<double> radii(stem_points);
    const double step = marks.stem_top / (static_cast<double>(stem_points) - 1.0);
    for (std::size_t k = 0; k < stem_points; ++k) {
        const double arc = std::max(static_cast<double>(k) * step, lowest_ray * height);
        const glm::dvec2 at = axis.at(arc), right = axis.beside(1.0, arc) - at;
        const auto to_right = first_hit(contour, at, right),
                   to_left = first_hit(contour, at, -right);
        if (!to_right || !to_left) continue;
        radii[k] = std::max(0.5 * (*to_right + *to_left), thinnest * height);
        apart += 0.5 * std::abs(*to_right - *to_left);
        compared += 1.0;
    }
    // Where a ray missed the mushroom, as under a foot that is cut askew, its neighbours count.
    for (std::size_t k = stem_points - 1; k-- > 0;)
        if (radii[k] <= 0.0) radii[k] = radii[k + 1];
    for (std::size_t k = 1; k < stem_points; ++k)
        if (radii[k] <= 0.0) radii[k] = std::max(radii[k - 1], thinnest * height);

    // The rays of the last stations may pass the corner on one side.
    const auto &left = marks.sides[0], &right = marks.sides[1];
    const double at_junction = 0.5 * (left.local[left.junction].x + right.local[right.junction].x);
    const auto spoilt = static_cast<std::size_t>(0.03 * height / std::max(step, 1e-9));
    const std::size_t sound = stem_points - 1 - std::min(spoilt, stem_points / 4);
    for (std::size_t k = sound + 1; k < stem_points; ++k) {
        const double t =
            static_cast<double>(k - sound) / static_cast<double>(stem_points - 1 - sound);
        radii[k] = std::min(
            radii[k], radii[sound] + t * (std::max(at_junction, radii[sound]) - radii[sound]));
    }
    profile.ring = without_ring(radii, step, height);
    const auto above = std::min(
        static_cast<std::size_t>(above_foot * height / std::max(step, 1e-9)), stem_points - 1);
    profile.has_foot = radii[0] < round_share * radii[above];
    if (profile.has_foot) {
        // The lowest rays are unsure: a quarter of an ellipse leads to the first sound one.
        constexpr int steps = 8;
        for (int k = 0; k < steps; ++k) {
            const auto [sine, cosine] = sine_cosine(0.5 * pi * k / steps);
            profile.stem.emplace_back(radii[above] * sine,
                                      static_cast<double>(above) * step * (1.0 - cosine));
        }
    }
    for (std::size_t k = profile.has_foot ? above : 0; k < stem_points; ++k)
        profile.stem.emplace_back(radii[k], static_cast<double>(k) * step);

    // Lower face and cap, turned back about the top of the stem.
    const CapFrame frame(axis, marks.stem_top, marks.cap_turn_deg);
    std::array<std::vector<glm::dvec2>, 2> faces, caps;
    for (std::size_t k = 0; k < 2; ++k) {
        const ContourSide& side = marks.sides[k];
        const double sign = k == 0 ? -1.0 : 1.0;
        std::vector<glm::dvec2> local;
        local.reserve(side.points.size());
        for (const glm::dvec2& point : side.points) {
            const glm::dvec2 at = frame.local(point);
            local.emplace_back(sign * at.x, marks.stem_top + at.y);
        }
        if (has_face(marks.form)) faces[k] = evenly(local, side.junction, side.margin, face_points);
        const std::size_t end = marks.form == Form::cup      ? side.margin
                                : marks.form == Form::funnel ? edge_of(local, side.margin, height)
                                                             : side.points.size() - 1;
        caps[k] = evenly(local, side.margin, end, end > side.margin ? cap_points : 1);
    }
    if (caps[0].size() != caps[1].size())  // One side has no more than its edge.
        for (std::vector<glm::dvec2>& cap : caps) cap.resize(cap_points, cap.back());
    const auto mean = [&](const std::array<std::vector<glm::dvec2>, 2>& halves) {
        std::vector<glm::dvec2> found;
        for (std::size_t i = 0; i < halves[0].size(); ++i) {
            found.push_back(0.5 * (halves[0][i] + halves[1][i]));
            apart += 0.5 * glm::length(halves[0][i] - halves[1][i]);
            compared += 1.0;
        }
        return found;
    };
    profile.face = mean(faces);
    profile.cap = mean(caps);
    if (marks.form == Form::cup) {
        // Its edge waves; it is as high as in the mean.
        const double from = profile.face.front().y, rise = profile.face.back().y - from,
                     mean_rise = marks.stem_top + marks.rim - from;
        const double factor = rise > 0.0 ? std::clamp(mean_rise / rise, 0.7, 1.3) : 1.0;
        for (glm::dvec2& point : profile.face) point.y = from + factor * (point.y - from);
        profile.cap.front() = profile.face.back();
    }
    // The stem ends where the face or the head begins, the cap on the axis.
    std::vector<glm::dvec2>& next = profile.face.empty() ? profile.cap : profile.face;
    const glm::dvec2 offset = profile.stem.back() - next.front();
    for (std::size_t i = 0; i < next.size(); ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(next.size() - 1);
        next[i] += (1.0 - t) * offset;
    }
    for (glm::dvec2& point : profile.face) point.x = std::max(point.x, thinnest * height);
    for (glm::dvec2& point : profile.cap) point.x = std::max(point.x, thinnest * height);
    next.front() = profile.stem.back();
    if (!profile.face.empty()) profile.cap.front() = profile.face.back();
    profile.seen = profile.cap.size();
    if (is_hollow(marks.form)) {
        const glm::dvec2 edge = profile.cap.back();
        const double bottom = edge.y - hollow * (edge.y - profile.face.front().y);
        const std::vector<glm::dvec2> wall = inner_wall(profile.face, edge, bottom);
        profile.cap.insert(profile.cap.end(), wall.begin() + 1, wall.end());
    }
    profile.cap.back().x = 0.0;
    profile.asymmetry = apart / compared / height;
    return profile;
}

}  // namespace sporeprint::trace
