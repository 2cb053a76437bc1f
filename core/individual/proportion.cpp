#include "core/individual/proportion.h"

#include <algorithm>

#include "core/silhouette/proof.h"

namespace sporeprint {

namespace {

struct Reach {
    double at, slope;
};

/// Returns how far a point at `x` stem radii from the axis moves outwards when the stem's surface
/// moves by one: with the stem up to 1, fading to 0 at 4, with a continuous slope that is never
/// below -0.8.
Reach reach_of_stem(double x) {
    if (x <= 1.0) return {x, 1.0};
    if (x >= 4.0) return {0.0, 0.0};
    const double t = (x - 1.0) / 3.0;
    return {1.0 + t * (3.0 + t * (5.0 * t - 9.0)), 1.0 + t * (5.0 * t - 6.0)};
}

}  // namespace

OutlineNodes proportioned(OutlineNodes nodes, const Proportions& proportions, double open) {
    const glm::dvec2 junction = nodes.stem.back().position, margin = nodes.cap.front().position;
    double stem = junction.x;
    for (const OutlineNode& node : nodes.stem)
        if (node.position.y >= margin.y) stem = std::max(stem, node.position.x);
    const double lift = (proportions.longer - 1.0) * junction.y, widening = proportions.wider - 1.0;
    const auto outwards = [&](OutlineNode& node, bool on_stem) {
        const double r = node.position.x;
        const Reach near = stem > 0.0 ? reach_of_stem(r / stem) : Reach{0.0, 0.0};
        const double fall = on_stem ? 0.0 : open;
        node.position.x += widening * ((1.0 - fall) * r + fall * stem * near.at);
        node.velocity.x *= 1.0 + widening * ((1.0 - fall) + fall * near.slope);
    };
    // Where sub-curves meet, both sides are stretched by the mean of their factors, so that a
    // smooth join stays smooth; the two joins of the lower face approach a single one as its weight
    // vanishes.
    const double without = 0.5 * (proportions.longer + proportions.higher);
    const double at_junction = open * 0.5 * (proportions.longer + 1.0) + (1.0 - open) * without;
    const double at_margin = open * 0.5 * (1.0 + proportions.higher) + (1.0 - open) * without;
    for (OutlineNode& node : nodes.stem) {
        outwards(node, true);
        node.position.y *= proportions.longer;
        node.velocity.y *= proportions.longer;
    }
    for (OutlineNode& node : nodes.hymenium) {
        outwards(node, false);
        node.position.y += lift;
    }
    for (OutlineNode& node : nodes.cap) {
        outwards(node, false);
        node.position.y = margin.y + lift + (node.position.y - margin.y) * proportions.higher;
        node.velocity.y *= proportions.higher;
    }
    const auto restretch = [](OutlineNode& node, double from, double to) {
        node.velocity.y *= to / from;
    };
    restretch(nodes.stem.back(), proportions.longer, at_junction);
    restretch(nodes.cap.front(), proportions.higher, at_margin);
    if (!nodes.hymenium.empty()) {
        restretch(nodes.hymenium.front(), 1.0, at_junction);
        restretch(nodes.hymenium.back(), 1.0, at_margin);
        nodes.hymenium.front().position = nodes.stem.back().position;
        nodes.cap.front().position = nodes.hymenium.back().position;
    } else {
        nodes.cap.front().position = nodes.stem.back().position;
    }
    return nodes;
}

OutlineNodes scaled(OutlineNodes nodes, double factor) {
    for (const CurveName curve : curve_names)
        for (OutlineNode& node : nodes.of(curve)) {
            node.position *= factor;
            node.velocity *= factor;
        }
    return nodes;
}

std::optional<CurveName> self_intersecting_curve(const Outline& outline, DetailLevel level) {
    const auto intersection = static_intersection(polyline(outline, level));
    if (!intersection) return std::nullopt;
    return curve_of(*intersection, outline.rings(CurveName::stem, level).size(),
                    outline.rings(CurveName::hymenium, level).size());
}

void Extent::include(const SubCurve& curve) {
    if (curve.empty()) return;
    for (int i = 0; i <= 32; ++i) {
        const OutlineSample point = curve.at(i / 32.0);
        low = std::min(low, point.y);
        high = std::max(high, point.y);
        radius = std::max(radius, point.r);
    }
}

double greatest_radius(const SubCurve& curve) {
    Extent extent{0.0, 0.0};
    extent.include(curve);
    return extent.radius;
}

}  // namespace sporeprint
