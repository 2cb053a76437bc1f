#include "core/geometry/attachment.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/surface/charts.h"

namespace sporeprint {

namespace {

constexpr const Chart& chart = swept_charts[static_cast<std::size_t>(Part::blade)];

}  // namespace

double running_down(const HymeniumOf<Plain>& h) { return std::min(1.0, 12.0 * h.decurrent); }

double envelope(const HymeniumOf<Plain>& h, double share) {
    const double out = std::clamp((1.0 - share) / 0.32, 0.0, 1.0);
    return smooth_step(0.0, 1.0, share / (0.06 + 0.22 * running_down(h))) * out * (2.0 - out);
}

double attachment(const HymeniumOf<Plain>& h, double share) {
    const double from = std::max(share - h.inner_gap, 0.0);
    const double u = std::min(from / 0.28, 1.0), x = std::min(from / 0.18, 1.0);
    const double notch = 0.85 * h.notch * 16.0 * x * x * (1.0 - x) * (1.0 - x);
    return (h.inner_depth + (1.0 - h.inner_depth) * u * (2.0 - u)) * (1.0 - notch);
}

double carried(const HymeniumOf<Plain>& h, double share) {
    return attachment(h, share) * smooth_step(0.0, 1.0, 1.0 + (share - h.inner_gap) / 0.03);
}

Roots::Roots(Mesh& to, const Individual& of, const LowerFace& on, const Ground& around)
    : mesh(to), individual(of), face(on), ground(around), flesh_(on.flesh(around.outline, 0)) {}

OutlineSample Roots::at(double share, double rooted) const {
    const LowerFace::Place here = face.at(share);
    const double deeper = here.recess + rooted * here.sink;
    OutlineSample root{here.r - deeper * here.normal_r, here.y - deeper * here.normal_y,
                       -here.normal_y, here.normal_r, share};
    if (rooted >= 1.0) return root;
    const auto next =
        std::upper_bound(flesh_.begin() + 1, flesh_.end() - 1, share,
                         [](double a, const OutlineSample& b) { return a < b.share; });
    const OutlineSample &a = *(next - 1), &b = *next;
    const double t =
        b.share > a.share ? std::clamp((share - a.share) / (b.share - a.share), 0.0, 1.0) : 0.0;
    root.r += (1.0 - rooted) * (a.r + t * (b.r - a.r) - root.r);
    root.y += (1.0 - rooted) * (a.y + t * (b.y - a.y) - root.y);
    return root;
}

Roots::Spot Roots::vertex_near(double share, double angle) const {
    double nearest = flesh_[1].share;
    for (std::size_t i = 1; i + 1 < flesh_.size(); ++i)
        if (std::abs(flesh_[i].share - share) < std::abs(nearest - share))
            nearest = flesh_[i].share;
    const double column = 2.0 * pi / detail_of(ground.lod).columns;
    return {nearest, column * std::floor(angle / column + 0.5)};
}

SurfacePoint Roots::place(Part part, const OutlineSample& sample, double angle,
                          const AxisStation& station, bool hangs) const {
    const Skin::Column column = ground.skin.column(angle);
    SurfacePoint point = ground.skin.at(part, sample, column);
    if (hangs) {
        // However the face waves or turns to its wall: else gills would lean over one another there.
        const auto [s, c] = column.azimuth.to;
        const glm::dvec3 round(-s, 0.0, c);
        point.azimuth = glm::dot(point.azimuth, round) * round;
    }
    // Where a fan squeezes or stretches the face, what stands on it is as much thinner or thicker, and no deeper.
    const double along = std::sqrt(glm::dot(point.meridian, point.meridian));
    ground.deformer.apply({&point, 1}, station);
    if (part == Part::hymenium) point.position += ground.curl.moved(false, sample.share, angle);
    const glm::dvec3 outward = glm::cross(point.meridian, point.azimuth);
    point.meridian = std::min(along, 1.0) * unit_or(outward, {0.0, -1.0, 0.0});
    return point;
}

void Roots::vertex(const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& along,
                   double u, double v, float hand) const {
    mesh.positions.emplace_back(position);
    mesh.normals.emplace_back(normal);
    if (!ground.textured) return;
    const TexturePoint at = strip_point(chart, std::clamp(u, 0.0, 1.0), v);
    mesh.texture_coordinates.emplace_back(at.u, at.v);
    const glm::dvec3 flat = along - glm::dot(along, normal) * normal;
    const glm::dvec3 other =
        std::abs(normal.y) < 0.8 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    mesh.tangents.emplace_back(
        glm::vec3(unit_or(flat, unit_or(other - glm::dot(other, normal) * normal, other))), hand);
}

}  // namespace sporeprint
