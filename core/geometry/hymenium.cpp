#include "core/geometry/hymenium.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "core/geometry/budget.h"
#include "core/math/elementary.h"

namespace sporeprint {

namespace {

constexpr int stations = 64;  // samples of the meridian
constexpr double usable_share =
    0.6;  // share of the distance from the edges to the cap's upper face
/// Places of extra rings of the flesh, which rises steeply at the stem and thins at the margin.
constexpr std::array<double, 10> steep_places = {0.012, 0.026, 0.042, 0.06, 0.085,
                                                 0.12,  0.2,   0.7,   0.8,  0.9};

/// Returns the distance along a ray to a polyline in the half-plane; intersections nearer than
/// `from` are ignored.
double distance_to(const std::vector<OutlineSample>& line, double r, double y, double dr, double dy,
                   double from) {
    double nearest = 1e9;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const double er = line[i + 1].r - line[i].r, ey = line[i + 1].y - line[i].y;
        const double across = dr * ey - dy * er;
        if (std::abs(across) < 1e-18) continue;
        const double qr = line[i].r - r, qy = line[i].y - y;
        const double t = (qr * ey - qy * er) / across, s = (qr * dy - qy * dr) / across;
        if (s >= 0.0 && s <= 1.0 && t > from) nearest = std::min(nearest, t);
    }
    return nearest;
}

/// Returns the distance of a point from a polyline in the half-plane.
double nearest_to(const std::vector<OutlineSample>& line, double r, double y) {
    const glm::dvec2 point(r, y);
    double nearest = 1e18;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const glm::dvec2 from(line[i].r, line[i].y), to(line[i + 1].r, line[i + 1].y);
        const double length = glm::dot(to - from, to - from);
        const double t =
            length > 0.0 ? std::clamp(glm::dot(point - from, to - from) / length, 0.0, 1.0) : 0.0;
        const glm::dvec2 off = point - from - t * (to - from);
        nearest = std::min(nearest, glm::dot(off, off));
    }
    return std::sqrt(nearest);
}

}  // namespace

int flesh_rings(const Individual& individual, DetailLevel level, bool solids) {
    const bool carries =
        std::any_of(individual.parts.begin(), individual.parts.end(), [](const SpeciesShare& part) {
            return part.model.surface.hymenium.pattern != HymeniumPattern::smooth;
        });
    if (!solids || !has_solids(level) || individual.outline.hymenium.empty() || !carries) return 0;
    return static_cast<int>(steep_places.size());
}

LowerFace::LowerFace(const Individual& individual, DetailLevel level, bool solids) {
    const SubCurve& curve = individual.outline.hymenium;
    if (curve.empty()) return;
    length_ = curve.length();
    has_solids_ = flesh_rings(individual, level, solids) > 0;
    std::vector<OutlineSample> line;
    for (int i = 0; i <= stations; ++i) line.push_back(curve.at(static_cast<double>(i) / stations));
    const auto cap = individual.outline.rings(CurveName::cap, 0);
    for (int i = 0; i <= stations; ++i) {
        const double share = static_cast<double>(i) / stations;
        const OutlineSample& at = line[static_cast<std::size_t>(i)];
        // Blades do not turn as sharply as the outline does at the stem, so normals are averaged
        // over a stretch of it.
        double normal_r = 0.0, normal_y = 0.0;
        for (int k = std::max(i - 5, 0); k <= std::min(i + 5, stations); ++k) {
            normal_r += line[static_cast<std::size_t>(k)].tangent_y;
            normal_y -= line[static_cast<std::size_t>(k)].tangent_r;
        }
        const double size = std::sqrt(normal_r * normal_r + normal_y * normal_y);
        Place place{.r = at.r, .y = at.y, .normal_r = at.tangent_y, .normal_y = -at.tangent_r};
        if (size > 1e-9) {
            place.normal_r = normal_r / size;
            place.normal_y = normal_y / size;
        }
        double available = distance_to(cap, at.r, at.y, -place.normal_r, -place.normal_y, 1e-9);
        if (place.normal_r > 1e-9) available = std::min(available, at.r / place.normal_r);
        if (available > 1e8) available = 0.0;
        // At a blunt margin the cap ends before the opposite point of its skin.
        available = std::min(available, nearest_to(cap, at.r, at.y));
        double wanted = 0.0, groove = 0.0;
        for (const SpeciesShare& part : individual.parts) {
            const HymeniumOf<Plain>& hymenium = part.model.hymenium;
            const HymeniumPattern pattern = part.model.surface.hymenium.pattern;
            const double deep =
                part.weight * hymenium.depth * length_ * depth_envelope(hymenium, share);
            if (is_bladed(pattern) || part.cells.rows > 0)
                wanted += deep;
            else if (pattern == HymeniumPattern::pores)
                groove += deep * (1.0 - cell_depth(hymenium, share));
        }
        // Tubes fill the outline itself, except in the groove round the stem.
        if (!solids || !has_solids(level)) wanted = 0.0;
        const double most = usable_share * available;
        place.recess = std::min(wanted + groove, most);
        place.scale = wanted > 0.0 ? std::min(1.0, place.recess / (wanted + groove)) : 0.0;
        place.sink = std::min(0.12 * place.recess + 0.008 * length_, 0.15 * available);
        places_.push_back(place);
    }
    // The recess is smoothed where the room ends abruptly.
    for (int pass = 0; pass < 2; ++pass) {
        const std::vector<Place> before = places_;
        for (std::size_t i = 1; i + 1 < places_.size(); ++i) {
            const double mean =
                0.25 * before[i - 1].recess + 0.5 * before[i].recess + 0.25 * before[i + 1].recess;
            const double recess = std::min(before[i].recess, mean);
            if (before[i].recess > 0.0) places_[i].scale *= recess / before[i].recess;
            places_[i].recess = recess;
        }
    }
}

LowerFace::Place LowerFace::at(double share) const {
    if (places_.empty()) return {};
    const double at = std::clamp(share, 0.0, 1.0) * stations;
    const double cell = std::min(std::floor(at), stations - 1.0);
    const double t = at - cell;
    const Place &a = places_[static_cast<std::size_t>(cell)],
                &b = places_[static_cast<std::size_t>(cell) + 1];
    const auto mix = [t](double x, double y) { return x + t * (y - x); };
    Place place{mix(a.r, b.r),
                mix(a.y, b.y),
                mix(a.normal_r, b.normal_r),
                mix(a.normal_y, b.normal_y),
                mix(a.recess, b.recess),
                mix(a.sink, b.sink),
                mix(a.scale, b.scale)};
    const double size =
        std::sqrt(place.normal_r * place.normal_r + place.normal_y * place.normal_y);
    if (size > 1e-9) {
        place.normal_r /= size;
        place.normal_y /= size;
    }
    return place;
}

std::vector<OutlineSample> LowerFace::flesh(const Outline& outline, DetailLevel level) const {
    std::vector<OutlineSample> rings = outline.rings(CurveName::hymenium, level);
    if (!has_solids_) return rings;
    for (const double place : steep_places) rings.push_back(outline.hymenium.at(place));
    std::sort(rings.begin() + 1, rings.end(),
              [](const OutlineSample& a, const OutlineSample& b) { return a.share < b.share; });
    const auto moved = [&](double share) {
        const Place place = at(share);
        return glm::dvec2(-place.recess * place.normal_r, -place.recess * place.normal_y);
    };
    for (std::size_t i = 0; i < rings.size(); ++i) {
        OutlineSample& ring = rings[i];
        const double step = 0.25 / stations;
        const double low = std::max(ring.share - step, 0.0),
                     high = std::min(ring.share + step, 1.0);
        const glm::dvec2 by = moved(ring.share), slope = (moved(high) - moved(low)) / (high - low);
        const double tr = ring.tangent_r + slope.x / length_,
                     ty = ring.tangent_y + slope.y / length_;
        const double size = std::sqrt(tr * tr + ty * ty);
        if (i > 0 && i + 1 < rings.size()) {  // the end rings are shared with stem and cap
            ring.r += by.x;
            ring.y += by.y;
        }
        if (size > 1e-9) {
            ring.tangent_r = tr / size;
            ring.tangent_y = ty / size;
        }
    }
    return rings;
}

void add_hymenium(Mesh& mesh, const Individual& individual, const LowerFace& face,
                  const OrnamentContext& context, const Budget& budget) {
    if (face.empty()) return;
    const Attachment attachment(mesh, individual, face, context);
    add_blades(attachment, budget.blades);
    add_cells(attachment, budget.cells);
}

}  // namespace sporeprint
