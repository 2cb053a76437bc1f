#include "core/geometry/attachment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/surface/charts.h"

namespace sporeprint {

namespace {

constexpr const Chart& chart = swept_charts[static_cast<std::size_t>(Part::blade)];

/// Returns the thickness of a thin layer under a fan and lobes, relative to that at rest.
double squeeze_across(const AzimuthMap& azimuth, const OutlineSample& sample,
                      const AzimuthMap::Column& column) {
    if (azimuth.identity()) return 1.0;
    const double s = column.from.sine, c = column.from.cosine;
    const auto in_half_plane = [&](double r, double y) { return glm::dvec3(r * c, y, r * s); };
    SurfacePoint layer{in_half_plane(sample.r, sample.y),
                       in_half_plane(sample.tangent_r, sample.tangent_y),
                       in_half_plane(sample.tangent_y, -sample.tangent_r)};
    azimuth.apply(layer, column);
    const double along = std::sqrt(glm::dot(layer.meridian, layer.meridian));
    const glm::dvec3 area = glm::cross(layer.meridian, layer.azimuth);
    return along > 0.0 ? std::sqrt(glm::dot(area, area)) / along : 1.0;
}

/// Returns the depth of solids under a fan and lobes, relative to that at rest: where the face is
/// squeezed or stretched, solids become thinner or thicker with it, but not deeper; where the flesh
/// beside a steep face is squeezed, they become as shallow as that.
///
/// meridian  its image
double depth_under(const AzimuthMap& azimuth, const OutlineSample& sample,
                   const AzimuthMap::Column& column, const glm::dvec3& meridian) {
    const double along = std::sqrt(glm::dot(meridian, meridian));
    return std::min(along, 1.0) * std::min(squeeze_across(azimuth, sample, column), 1.0);
}

}  // namespace

double decurrence(const HymeniumOf<Plain>& hymenium) {
    return std::min(1.0, 12.0 * hymenium.decurrent);
}

double depth_envelope(const HymeniumOf<Plain>& hymenium, double share) {
    const double out = std::clamp((1.0 - share) / 0.32, 0.0, 1.0);
    return smooth_step(0.0, 1.0, share / (0.06 + 0.22 * decurrence(hymenium))) * out * (2.0 - out);
}

double attached_depth(const HymeniumOf<Plain>& hymenium, double share) {
    const double from = std::max(share - hymenium.inner_gap, 0.0);
    const double u = std::min(from / 0.28, 1.0), x = std::min(from / 0.18, 1.0);
    const double notch = 0.85 * hymenium.notch * 16.0 * x * x * (1.0 - x) * (1.0 - x);
    return (hymenium.inner_depth + (1.0 - hymenium.inner_depth) * u * (2.0 - u)) * (1.0 - notch);
}

double cell_depth(const HymeniumOf<Plain>& hymenium, double share) {
    return attached_depth(hymenium, share) *
           smooth_step(0.0, 1.0, 1.0 + (share - hymenium.inner_gap) / 0.03);
}

Attachment::Attachment(Mesh& target, const Individual& source, const LowerFace& lower_face,
                       const OrnamentContext& ornament_context)
    : mesh(target),
      individual(source),
      face(lower_face),
      context(ornament_context),
      flesh_(lower_face.flesh(ornament_context.outline, 0)) {}

OutlineSample Attachment::at(double share, double embedding) const {
    const LowerFace::Place here = face.at(share);
    const double deeper = here.recess + embedding * here.sink;
    OutlineSample root{here.r - deeper * here.normal_r, here.y - deeper * here.normal_y,
                       -here.normal_y, here.normal_r, share};
    if (embedding >= 1.0) return root;
    const auto next =
        std::upper_bound(flesh_.begin() + 1, flesh_.end() - 1, share,
                         [](double a, const OutlineSample& b) { return a < b.share; });
    const OutlineSample &a = *(next - 1), &b = *next;
    const double t =
        b.share > a.share ? std::clamp((share - a.share) / (b.share - a.share), 0.0, 1.0) : 0.0;
    root.r += (1.0 - embedding) * (a.r + t * (b.r - a.r) - root.r);
    root.y += (1.0 - embedding) * (a.y + t * (b.y - a.y) - root.y);
    return root;
}

Attachment::FacePoint Attachment::nearest_vertex(double share, double angle) const {
    double nearest = flesh_[1].share;
    for (std::size_t i = 1; i + 1 < flesh_.size(); ++i)
        if (std::abs(flesh_[i].share - share) < std::abs(nearest - share))
            nearest = flesh_[i].share;
    const double column = 2.0 * pi / detail_of(context.level).columns;
    return {nearest, column * std::floor(angle / column + 0.5)};
}

void Attachment::finish(Part part, const OutlineSample& sample, double angle, double depth,
                        SurfacePoint& point) const {
    if (part == Part::hymenium) point.position += context.curl.moved(false, sample.share, angle);
    const glm::dvec3 outward = glm::cross(point.meridian, point.azimuth);
    point.meridian = depth * unit_or(outward, {0.0, -1.0, 0.0});
}

SurfacePoint Attachment::place(const OutlineSample& sample, double angle,
                               const AxisStation& station) const {
    const RestSurface::Column column = context.rest_surface.column(angle);
    SurfacePoint point = context.rest_surface.at(Part::hymenium, sample, column);
    const double depth =
        depth_under(context.rest_surface.azimuth(), sample, column.azimuth, point.meridian);
    context.deformer.apply({&point, 1}, station);
    finish(Part::hymenium, sample, angle, depth, point);
    return point;
}

BladeRoot Attachment::blade_root(Part part, const OutlineSample& sample, double angle,
                                 const AxisStation& station) const {
    const RestSurface::Column column = context.rest_surface.column(angle);
    const SurfacePoint rest = context.rest_surface.at(part, sample, column);
    const double depth =
        depth_under(context.rest_surface.azimuth(), sample, column.azimuth, rest.meridian);
    const auto [s, c] = column.azimuth.to;
    const glm::dvec3 round(-s, 0.0, c);
    std::array<SurfacePoint, 2> points{rest, rest};  // level, and rising with the face
    points[0].azimuth = glm::dot(rest.azimuth, round) * round;
    points[1].azimuth = points[0].azimuth + glm::dvec3(0.0, rest.azimuth.y, 0.0);
    context.deformer.apply(points, station);
    finish(part, sample, angle, depth, points[0]);
    return {points[0], points[1].azimuth};
}

void Attachment::add_vertex(const glm::dvec3& position, const glm::dvec3& normal,
                            const glm::dvec3& along, double u, double v, float handedness) const {
    mesh.positions.emplace_back(position);
    mesh.normals.emplace_back(normal);
    if (!context.textured) return;
    const TexturePoint uv_point = strip_point(chart, std::clamp(u, 0.0, 1.0), v);
    mesh.texture_coordinates.emplace_back(uv_point.u, uv_point.v);
    const glm::dvec3 flat = along - glm::dot(along, normal) * normal;
    const glm::dvec3 other =
        std::abs(normal.y) < 0.8 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    mesh.tangents.emplace_back(
        glm::vec3(unit_or(flat, unit_or(other - glm::dot(other, normal) * normal, other))),
        handedness);
}

}  // namespace sporeprint
