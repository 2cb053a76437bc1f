#include "core/geometry/rest_surface.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/individual/proportion.h"
#include "core/math/direction.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

std::vector<Waves::Species> species_of(const Individual& individual) {
    std::vector<Waves::Species> mix;
    for (const SpeciesShare& part : individual.parts)
        mix.push_back({stream_of(part.id), part.weight});
    return mix;
}

}  // namespace

RestSurface::RestSurface(const Individual& individual, const Detail& detail, const Detail& carrier)
    : outline_(individual.outline),
      relief_(individual, carrier),
      waves_(individual.waves, greatest_radius(individual.outline.cap), detail.columns,
             individual.shape_seed, species_of(individual)),
      azimuth_(individual, detail.columns) {
    if (outline_.cap.empty() || outline_.hymenium.empty()) return;
    const auto at = [](const SubCurve& curve, double share) {
        const OutlineSample sample = curve.at(share);
        return glm::dvec2(sample.r, sample.y);
    };
    margin_ = at(outline_.cap, 0.0);
    waved_ = std::max(std::min(glm::distance(margin_, at(outline_.cap, 1.0)),
                               glm::distance(margin_, at(outline_.hymenium, 0.0))),
                      1e-9);
}

RestSurface::Column RestSurface::column(double angle) const {
    Column column{angle, azimuth_.column(angle), {}};
    if (!waves_.flat()) column.waves = waves_.phases(angle);
    return column;
}

const SubCurve& RestSurface::curve(Part part) const {
    return part == Part::stem       ? outline_.stem
           : part == Part::hymenium ? outline_.hymenium
                                    : outline_.cap;
}

SurfacePoint RestSurface::at(Part part, const OutlineSample& sample, const Column& column) const {
    const auto [s, c] = column.azimuth.from;
    SurfacePoint point{{sample.r * c, sample.y, sample.r * s},
                       {sample.tangent_r * c, sample.tangent_y, sample.tangent_r * s},
                       {-s, 0.0, c}};
    if (!relief_.flat(part)) {
        // Displacement along the normal of the outline. The normal turns with the outline: n' is
        // curvature times tangent.
        const Relief::Height height =
            relief_.at(part, sample.share, column.angle, column.azimuth.from);
        const double length = curve(part).length();
        const double rise = length > 0.0 ? height.by_share / length : 0.0;
        const double stretch = 1.0 + height.value * sample.curvature;
        const double out = sample.tangent_y, up = -sample.tangent_r;
        const double r = sample.r + height.value * out;
        const double along_r = stretch * sample.tangent_r + rise * out;
        point.position = {r * c, sample.y + height.value * up, r * s};
        point.meridian = {along_r * c, stretch * sample.tangent_y + rise * up, along_r * s};
        if (sample.r > 0.0) {
            const double round = r / sample.r, slope = height.by_angle / sample.r;
            point.azimuth = {slope * out * c - round * s, slope * up, slope * out * s + round * c};
        }
    }
    if (part != Part::stem && !waves_.flat()) {
        const glm::dvec2 away = glm::dvec2(sample.r, sample.y) - margin_;
        const double distance = std::sqrt(glm::dot(away, away));
        const auto wave = waves_.at(std::max(1.0 - distance / waved_, 0.0), column.waves);
        point.position.y += wave.height;
        if (distance > 0.0)
            point.meridian.y -= wave.by_share / waved_ *
                                glm::dot(away, glm::dvec2(sample.tangent_r, sample.tangent_y)) /
                                distance;
        if (sample.r > 0.0) point.azimuth.y += wave.by_angle / sample.r;
    }
    azimuth_.apply(point, column.azimuth);
    return point;
}

SurfacePoint RestSurface::at(Part part, double share, double angle) const {
    return at(part, curve(part).at(share), column(angle));
}

SurfacePoint RestSurface::meshed(Part part, const std::vector<OutlineSample>& rings, int columns,
                                 double share, double angle) const {
    const Column here = column(angle);
    SurfacePoint point = at(part, curve(part).at(share), here);
    const auto above =
        std::upper_bound(rings.begin() + 1, rings.end() - 1, share,
                         [](double s, const OutlineSample& ring) { return s < ring.share; });
    const OutlineSample &low = *(above - 1), &high = *above;
    const double width = high.share - low.share;
    const double up = width > 0.0 ? std::clamp((share - low.share) / width, 0.0, 1.0) : 0.0;
    const double turn = angle / (2.0 * pi) * columns, first = std::floor(turn);
    const double round = turn - first;
    const Column left = column(2.0 * pi * first / columns),
                 right = column(2.0 * pi * (first + 1.0) / columns);
    // The diagonal of a quad runs from the right of its lower ring to the left of its upper one.
    const glm::dvec3 b = at(part, low, right).position, c = at(part, high, left).position;
    if (round + up <= 1.0) {
        const glm::dvec3 a = at(part, low, left).position;
        point.position = a + round * (b - a) + up * (c - a);
    } else {
        const glm::dvec3 d = at(part, high, right).position;
        point.position = d + (1.0 - round) * (c - d) + (1.0 - up) * (b - d);
    }
    // The meridian has the slope of the mesh: where an outline bends between two rings, its own
    // tangent changes abruptly while the bend passes.
    const auto last = rings.end() - 1;
    const auto chord = [&](std::vector<OutlineSample>::const_iterator ring) {
        const auto& before = ring == rings.begin() ? *ring : *(ring - 1);
        const auto& after = ring == last ? *ring : *(ring + 1);
        return at(part, after, here).position - at(part, before, here).position;
    };
    const glm::dvec3 steep = (1.0 - up) * chord(above - 1) + up * chord(above);
    point.meridian = unit_or(steep, point.meridian);
    return point;
}

}  // namespace sporeprint
