#include "core/silhouette/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/mesh/detail.h"
#include "core/problems.h"
#include "core/silhouette/proof.h"

namespace sporeprint {

namespace {

constexpr int knots_between_controls = 24;  // few long cubics between control points
constexpr int knots_between_nodes =
    8;  // many short cubics between the nodes of a set; waves depend on their speed

// Turning in radians that attracts as many rings as the length of a whole sub-curve does. It is
// absolute, not a share of the total turning: on a nearly straight stem the rings would follow its
// slightest undulation.
constexpr double turn_per_length = 7.0;
// Upper bound of the ring density of a bend relative to its length, so that a bend that shrinks to
// a point releases its rings smoothly.
constexpr double most_per_length = 9.0;
// Sub-curves with so few rings place them closer to the bends: a chord across a bend would hide
// what an image shows there.
constexpr int few_rings = 5;

std::string number(double value) {
    std::string text = std::to_string(value);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text;
}

/// The path of a control point in problem reports: "/cap/" and its number.
struct Place {
    const char* curve;
    std::size_t index;
};

/// Returns the smallest r at the turning points strictly inside a segment, or infinity if r is
/// monotone.
double least_turning_r(const SplineSegment<glm::dvec2>& s) {
    const double a = s.leaving.x, b = 3.0 * (s.to.x - s.from.x) - 2.0 * s.leaving.x - s.arriving.x;
    const double c =
        3.0 * (2.0 * (s.from.x - s.to.x) + s.leaving.x + s.arriving.x);  // r' = a + 2 b t + c t^2
    const double discriminant = b * b - a * c;
    double least = std::numeric_limits<double>::infinity();
    if (!(discriminant > 0.0)) return least;
    const double q = -(b + (b < 0.0 ? -1.0 : 1.0) * std::sqrt(discriminant));
    for (const double t : {q / c, a / q})
        if (t > 0.0 && t < 1.0) least = std::min(least, s.at(t).position.x);
    return least;
}

}  // namespace

int ring_count(CurveName curve, DetailLevel level) {
    const Detail detail = detail_of(level);
    return curve == CurveName::stem       ? detail.stem_rings
           : curve == CurveName::hymenium ? detail.hymenium_rings
                                          : detail.cap_rings;
}

void Silhouette::check(const std::string& path, std::vector<Problem>& problems) const {
    const auto bad = [&](const std::string& at, std::string message) {
        problems.push_back({path + at, std::move(message)});
    };
    if (stem.size() < 2)
        return bad("/stem", std::to_string(stem.size()) + " control points; at least 2 are needed");
    if (hymenium.size() == 1)
        return bad("/hymenium", "1 control point; none or at least 2 are needed");
    if (cap.size() < 2)
        return bad("/cap", std::to_string(cap.size()) + " control points; at least 2 are needed");
    if (stem.front().r != 0.0)
        bad("/stem/0/r", number(stem.front().r) + " is off the axis; the outline begins at r = 0");
    if (cap.back().r != 0.0)
        bad("/cap/" + std::to_string(cap.size() - 1) + "/r",
            number(cap.back().r) + " is off the axis; the outline ends at r = 0");
    const OutlinePoint& before_cap = hymenium.empty() ? stem.back() : hymenium.back();
    if (!hymenium.empty() && hymenium.front() != stem.back())
        bad("/hymenium/0", "must equal the last point of the stem");
    if (cap.front() != before_cap)
        bad("/cap/0", hymenium.empty() ? "must equal the last point of the stem"
                                       : "must equal the last point of the hymenium");
    const auto distinct = [&](const std::string& curve, const std::vector<OutlinePoint>& points) {
        for (std::size_t i = 1; i < points.size(); ++i) {
            const double along = points[i].r - points[i - 1].r, up = points[i].y - points[i - 1].y;
            if (along * along + up * up < 1e-18)  // a squared nanometre
                bad(curve + std::to_string(i), "coincides with the point before it");
        }
    };
    distinct("/stem/", stem);
    distinct("/hymenium/", hymenium);
    distinct("/cap/", cap);
}

SubCurve::SubCurve(std::vector<SplineSegment<glm::dvec2>> segments)
    : segments_(std::move(segments)) {
    tabulate(knots_between_controls);
}

SubCurve::SubCurve(const std::vector<OutlineNode>& nodes, const glm::dvec2& fallback_tangent)
    : fallback_tangent_(fallback_tangent) {
    if (nodes.empty()) return;
    const double step = 1.0 / static_cast<double>(nodes.size() - 1);
    segments_.reserve(nodes.size() - 1);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
        segments_.push_back({nodes[i].position, nodes[i + 1].position, nodes[i].velocity * step,
                             nodes[i + 1].velocity * step});
    tabulate(knots_between_nodes);
}

void SubCurve::tabulate(int knots_per_segment) {
    if (segments_.empty()) return;
    knots_.reserve(segments_.size() * static_cast<std::size_t>(knots_per_segment) + 1);
    knots_.push_back({});
    glm::dvec2 last = segments_.front().from;
    glm::dvec2 heading(0.0);
    for (std::size_t s = 0; s < segments_.size(); ++s)
        for (int i = 1; i <= knots_per_segment; ++i) {
            const glm::dvec2 point =
                segments_[s].at(static_cast<double>(i) / knots_per_segment).position;
            const glm::dvec2 step = point - last;
            const double length = std::sqrt(glm::dot(step, step));
            Knot knot = knots_.back();
            knot.parameter = static_cast<double>(s) + static_cast<double>(i) / knots_per_segment;
            knot.arc += length;
            if (length > 1e-12) {
                const glm::dvec2 direction = step / length;
                // The chord between unit vectors replaces the angle: it is monotone in it and needs
                // no arc tangent.
                if (heading != glm::dvec2(0.0))
                    knot.turn += std::sqrt(glm::dot(direction - heading, direction - heading));
                heading = direction;
            }
            knots_.push_back(knot);
            last = point;
        }
    length_ = knots_.back().arc;
    const double total = std::max(length_, 1e-12);
    for (std::size_t k = 1; k < knots_.size(); ++k) {
        const Knot& before = knots_[k - 1];
        const double length = (knots_[k].arc - before.arc) / total;
        const double turn = (knots_[k].turn - before.turn) / turn_per_length;
        knots_[k].bends = before.bends + std::min(turn, most_per_length * length);
    }
}

OutlineSample SubCurve::sample(double parameter, double arc) const {
    const double last = static_cast<double>(segments_.size()) - 1.0;
    const double segment = std::clamp(std::floor(parameter), 0.0, last);
    const auto s = segments_[static_cast<std::size_t>(segment)].at(parameter - segment);
    glm::dvec2 tangent = s.derivative;
    double speed = std::sqrt(glm::dot(tangent, tangent));
    if (speed < 1e-12) {
        tangent = segments_[static_cast<std::size_t>(segment)].to -
                  segments_[static_cast<std::size_t>(segment)].from;
        speed = std::sqrt(glm::dot(tangent, tangent));
        if (speed < 1e-12) {
            tangent = fallback_tangent_;
            speed = 1.0;
        }
    }
    const glm::dvec2& bend = s.second_derivative;
    return {s.position.x,
            s.position.y,
            tangent.x / speed,
            tangent.y / speed,
            length_ > 0.0 ? arc / length_ : 0.0,
            (tangent.x * bend.y - tangent.y * bend.x) / (speed * speed * speed)};
}

OutlineSample SubCurve::at(double share) const {
    const double arc = std::clamp(share, 0.0, 1.0) * length_;
    const auto above = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, arc,
                                        [](double a, const Knot& k) { return a < k.arc; });
    const Knot& b = *above;
    const Knot& a = *(above - 1);
    const double t = b.arc > a.arc ? (arc - a.arc) / (b.arc - a.arc) : 0.0;
    return sample(a.parameter + t * (b.parameter - a.parameter), arc);
}

std::vector<OutlineSample> SubCurve::placed(std::span<const double> u) const {
    std::vector<OutlineSample> samples;
    if (empty()) return samples;
    samples.reserve(u.size());
    const auto segments = static_cast<double>(segments_.size());
    std::size_t k = 1;
    for (const double place : u) {
        const double parameter = place * segments;
        while (k + 1 < knots_.size() && knots_[k].parameter < parameter) ++k;
        const Knot &a = knots_[k - 1], &b = knots_[k];
        const double t =
            std::clamp((parameter - a.parameter) / (b.parameter - a.parameter), 0.0, 1.0);
        samples.push_back(sample(parameter, a.arc + t * (b.arc - a.arc)));
    }
    snap_ends(samples);
    return samples;
}

// The ends are copied from the nodes, so that neighbouring sub-curves weld bit for bit.
void SubCurve::snap_ends(std::vector<OutlineSample>& samples) const {
    const auto snap = [](OutlineSample& sample, const glm::dvec2& position, double share) {
        sample.r = position.x;
        sample.y = position.y;
        sample.share = share;
    };
    snap(samples.front(), segments_.front().from, 0.0);
    snap(samples.back(), segments_.back().to, 1.0);
}

std::vector<double> SubCurve::segment_shares() const {
    std::vector<double> shares;
    if (empty()) return shares;
    const std::size_t step = (knots_.size() - 1) / segments_.size();
    for (std::size_t k = 0; k < knots_.size(); k += step)
        shares.push_back(length_ > 0.0 ? knots_[k].arc / length_ : 0.0);
    shares.back() = 1.0;
    return shares;
}

double SubCurve::turning(double share) const {
    const double arc = std::clamp(share, 0.0, 1.0) * length_;
    const auto above = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, arc,
                                        [](double x, const Knot& k) { return x < k.arc; });
    const Knot &a = *(above - 1), &b = *above;
    const double t = b.arc > a.arc ? (arc - a.arc) / (b.arc - a.arc) : 0.0;
    return a.turn + t * (b.turn - a.turn);
}

std::vector<OutlineSample> SubCurve::sampled(int count) const {
    std::vector<OutlineSample> samples;
    if (empty()) return samples;
    samples.reserve(static_cast<std::size_t>(count));
    const double bent = count <= few_rings ? 2.0 : 1.0, length = std::max(length_, 1e-12);
    const auto rings = [&](const Knot& knot) { return knot.arc / length + bent * knot.bends; };
    const double total = rings(knots_.back());
    std::size_t k = 1;
    for (int i = 0; i < count; ++i) {
        const double target = total * i / (count - 1);
        while (k + 1 < knots_.size() && rings(knots_[k]) < target) ++k;
        const double from = rings(knots_[k - 1]), to = rings(knots_[k]);
        const double t = to > from ? std::clamp((target - from) / (to - from), 0.0, 1.0) : 0.0;
        const Knot &a = knots_[k - 1], &b = knots_[k];
        samples.push_back(
            sample(a.parameter + t * (b.parameter - a.parameter), a.arc + t * (b.arc - a.arc)));
    }
    snap_ends(samples);
    return samples;
}

double buried_share(const SubCurve& stem) {
    constexpr int steps = 64;
    double below = stem.at(0.0).y;
    if (below >= 0.0) return 0.0;
    for (int i = 1; i <= steps; ++i) {
        const double y = stem.at(static_cast<double>(i) / steps).y;
        if (y >= 0.0) return (i - 1 + below / (below - y)) / steps;
        below = y;
    }
    return 1.0;
}

Outline::Outline(const OutlineNodes& nodes) : stem(nodes.stem, {0.0, 1.0}) {
    const OutlineSample end = stem.at(1.0);
    const glm::dvec2 onwards(end.tangent_r, end.tangent_y);
    hymenium = SubCurve(nodes.hymenium, onwards);
    cap = SubCurve(nodes.cap, onwards);
}

std::vector<OutlineSample> Outline::rings(CurveName curve, DetailLevel level) const {
    return of(curve).sampled(ring_count(curve, level));
}

Outline Outline::unproven(const Silhouette& silhouette, const std::string& path) {
    Outline outline;
    std::vector<glm::dvec2> points;
    std::vector<Place> places;
    std::array<std::size_t, 4> starts{};
    const auto append = [&](const char* curve, const std::vector<OutlinePoint>& controls,
                            std::size_t& end) {
        for (std::size_t i = points.empty() ? 0 : 1; i < controls.size(); ++i) {
            points.emplace_back(controls[i].r, controls[i].y);
            places.push_back({curve, i});
        }
        end = points.size() - 1;
    };
    append("/stem/", silhouette.stem, starts[1]);
    append("/hymenium/", silhouette.hymenium, starts[2]);
    append("/cap/", silhouette.cap, starts[3]);

    const std::size_t n = points.size();
    const bool has_hymenium = starts[2] != starts[1];
    const auto corner = [&](std::size_t i) {
        return (i == starts[1] && silhouette.junction == Join::corner) ||
               (has_hymenium && i == starts[2] && silhouette.margin == Join::corner);
    };
    const auto velocity = [&](std::size_t i, bool leaving) -> glm::dvec2 {
        // At the axis the neighbour is the mirror image: the surface is smooth across its pole.
        if (i == 0)
            return centripetal_velocity(glm::dvec2(-points[1].x, points[1].y), points[0],
                                        points[1]);
        if (i + 1 == n)
            return centripetal_velocity(points[n - 2], points[n - 1],
                                        glm::dvec2(-points[n - 2].x, points[n - 2].y));
        if (!corner(i)) return centripetal_velocity(points[i - 1], points[i], points[i + 1]);
        const glm::dvec2 chord = leaving ? points[i + 1] - points[i] : points[i] - points[i - 1];
        const double step = std::sqrt(std::sqrt(glm::dot(chord, chord)));
        return step < 1e-9 ? glm::dvec2(0.0) : chord / step;
    };
    const auto curve = [&](std::size_t from, std::size_t to) {
        std::vector<SplineSegment<glm::dvec2>> segments;
        for (std::size_t i = from; i < to; ++i) {
            const double step = centripetal_step(points[i], points[i + 1]);
            segments.push_back({points[i], points[i + 1], velocity(i, true) * step,
                                velocity(i + 1, false) * step});
            const double least =
                std::min(least_turning_r(segments.back()), i > 0 ? points[i].x : 1.0);
            if (least <= 0.0)
                throw Impossible({{path + places[i].curve + std::to_string(places[i].index),
                                   "the outline reaches the axis between its ends (r = " +
                                       number(least) + " m)"}});
        }
        return SubCurve(std::move(segments));
    };
    outline.stem = curve(0, starts[1]);
    outline.hymenium = curve(starts[1], starts[2]);
    outline.cap = curve(starts[2], starts[3]);
    return outline;
}

Outline::Outline(const Silhouette& silhouette, const std::string& path)
    : Outline(unproven(silhouette, path)) {
    // The proof uses a polyline finer than any that is swept.
    std::vector<glm::dvec2> polyline;
    std::vector<Place> owners;
    const auto refine = [&](const SubCurve& part, const char* name, std::size_t controls) {
        if (part.empty()) return;
        const int count = static_cast<int>(controls) * 8;
        const auto samples = part.sampled(count);
        for (int i = polyline.empty() ? 0 : 1; i < count; ++i) {
            const auto& s = samples[static_cast<std::size_t>(i)];
            polyline.emplace_back(s.r, s.y);
            owners.push_back(
                {name, std::min(controls - 1, static_cast<std::size_t>(
                                                  s.share * static_cast<double>(controls)))});
        }
    };
    refine(stem, "/stem/", silhouette.stem.size());
    refine(hymenium, "/hymenium/", silhouette.hymenium.size());
    refine(cap, "/cap/", silhouette.cap.size());
    const auto where = [&](std::size_t i) {
        return path + owners[i].curve + std::to_string(owners[i].index);
    };
    if (const auto crossing = first_crossing(polyline))
        throw Impossible({{where((*crossing)[0]),
                           "the outline crosses itself here and near " + where((*crossing)[1])}});
}

}  // namespace sporeprint
