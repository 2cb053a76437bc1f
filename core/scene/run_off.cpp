#include "core/scene/run_off.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "core/math/direction.h"
#include "core/math/elementary.h"

namespace sporeprint {

namespace {

/// How a kind of surface deals with rain: the share that runs off a steep one, and how far it runs until all but
/// 1/e of it has sunk in, metres.
struct Sheds {
    double share, length;
};

Sheds sheds_of(Soil soil) {
    switch (soil) {
        case Soil::none:
            return {0.9, 10.0};
        case Soil::wood:
            return {0.6, 1.5};
        case Soil::ground:
            return {0.25, 0.3};
        case Soil::litter:
            return {0.15, 0.15};
        case Soil::grass:
            return {0.2, 0.2};
    }
    return {0.0, 0.0};
}

/// Slope, as a sine, at which that is half as much.
constexpr double half_slope = 0.1;

/// Ways lead down if they fall by more than this share of their length.
constexpr double least_fall = 0.01;

/// Drops begin this far from the surface, metres, and fall at most this far.
constexpr double above = 1e-3, farthest_drop = 1e3;

/// Surfels that catch a drop are at most so many spacings away.
constexpr double catch_spacings = 3.0;

}  // namespace

std::size_t RunOff::bytes() const {
    return sizeof(*this) + (order.size() + first.size()) * sizeof(std::uint32_t) +
           ways.size() * sizeof(Way) + (passing.size() + water.size()) * sizeof(float);
}

RunOff run_off_of(const Surfels& surfels, const SurfelGraph& graph, const TriangleTree& tree,
                  const SurfelSubstrates& substrates, std::span<const float> rain) {
    const auto count = static_cast<std::uint32_t>(surfels.size());
    RunOff out;
    out.first.push_back(0);
    const auto height = [&](std::uint32_t i) { return static_cast<double>(surfels[i].at.y); };
    std::vector<double> running(count), lying(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        double sum = 0.0, fallen = 0.0;
        const std::size_t begin = out.ways.size();
        for (const SurfelGraph::Way& way : graph.ways(i)) {
            const double fall = (height(i) - height(way.to)) / static_cast<double>(way.length);
            if (fall <= least_fall) continue;
            sum += fall;
            fallen += height(i) - height(way.to);
            out.ways.push_back({way.to, static_cast<float>(fall)});
        }
        const double up = static_cast<double>(surfels[i].normal.y);
        const double slope = std::sqrt(std::max(0.0, 1.0 - up * up));
        const double steep = slope / (slope + half_slope);
        const Sheds sheds = sheds_of(substrates.soils[i]);
        // Weighted by the slopes, the mean length of the ways is that of all falls over all slopes.
        const double step = sum > 0.0 ? fallen / sum : surfels.spacing();
        // Water does not hang below an overhang, and sinks in at once where it is level.
        double passing = up < 0.0      ? 1.0
                         : steep > 0.0 ? exponential(-step / (sheds.length * steep))
                                       : 0.0;
        const double rained = static_cast<double>(rain[i]) * static_cast<double>(surfels[i].area);
        running[i] = rained * sheds.share * steep;
        lying[i] = rained - running[i];
        for (std::size_t k = begin; k < out.ways.size(); ++k)
            out.ways[k].share = static_cast<float>(static_cast<double>(out.ways[k].share) / sum);
        if (begin == out.ways.size() && passing > 0.0) {
            // Beyond the edge that the water has run to, if there is one.
            const glm::dvec3 normal(surfels[i].normal);
            const glm::dvec3 aside = unit_or({normal.x, 0.0, normal.z}, glm::dvec3(0.0));
            const glm::dvec3 drop = glm::dvec3(surfels[i].at) + above * normal +
                                    (up < 0.0 ? 0.0 : surfels.spacing()) * aside;
            const glm::dvec3 down(0.0, -1.0, 0.0);
            // On the lowest place of a hollow a drop meets the surface at once, and the water stays.
            const std::optional<RayHit> hit = tree.first_hit(drop, down, 0.0, farthest_drop);
            if (hit) {
                const glm::dvec3 place = drop + hit->distance * down;
                std::optional<std::uint32_t> best;
                double least = catch_spacings * surfels.spacing();
                least *= least;
                surfels.each_near(
                    place, catch_spacings * surfels.spacing(), [&](std::uint32_t other) {
                        if (surfels[other].normal.y <= 0.0F) return;
                        const glm::dvec3 way = glm::dvec3(surfels[other].at) - place;
                        const double square = glm::dot(way, way);
                        if (square > least || (square == least && best && *best < other)) return;
                        best = other;
                        least = square;
                    });
                const bool is_lower = best && *best != i && height(*best) < height(i);
                if (is_lower)
                    out.ways.push_back({*best, 1.0F});
                else
                    passing = 0.0;
            }
        }
        out.passing.push_back(static_cast<float>(passing));
        out.first.push_back(static_cast<std::uint32_t>(out.ways.size()));
    }
    for (std::uint32_t i = 0; i < count; ++i) out.order.push_back(i);
    std::ranges::sort(out.order, [&](std::uint32_t a, std::uint32_t b) {
        return height(a) != height(b) ? height(a) > height(b) : a < b;
    });
    static_cast<void>(wash_down(out, 1.0, running));
    out.water.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto area = static_cast<double>(surfels[i].area);
        out.water.push_back(static_cast<float>(area > 0.0 ? (lying[i] + running[i]) / area : 0.0));
    }
    return out;
}

double wash_down(const RunOff& run_off, double strength, std::vector<double>& amounts) {
    double gone = 0.0;
    std::vector<double> carried(amounts.size());
    for (std::size_t i = 0; i < amounts.size(); ++i) {
        carried[i] = strength * amounts[i];
        amounts[i] -= carried[i];
    }
    for (const std::uint32_t i : run_off.order) {
        const double passed = static_cast<double>(run_off.passing[i]) * carried[i];
        amounts[i] += carried[i] - passed;
        if (passed <= 0.0) continue;
        const std::uint32_t first = run_off.first[i], end = run_off.first[i + std::size_t{1}];
        if (first == end) gone += passed;
        double left = passed;
        for (std::uint32_t k = first; k < end; ++k) {
            // The last one has what rounding leaves.
            const double there =
                k + 1 == end ? left : passed * static_cast<double>(run_off.ways[k].share);
            carried[run_off.ways[k].to] += there;
            left -= there;
        }
    }
    return gone;
}

}  // namespace sporeprint
