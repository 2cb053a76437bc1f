#include "core/geometry/axis.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/math/spline.h"

namespace sporeprint {

namespace {

constexpr int stations = AxisCurve::stations;

glm::dvec3 unit(const glm::dvec3& v) { return v / std::sqrt(glm::dot(v, v)); }

double zone_share(const DeformationOf<Plain>& d, double share) {
    return std::clamp((share - d.zone_from) / (d.zone_to - d.zone_from), 0.0, 1.0);
}

}  // namespace

std::vector<glm::dvec3> rotation_minimising_normals(const std::vector<glm::dvec3>& positions,
                                                    const std::vector<glm::dvec3>& tangents,
                                                    const glm::dvec3& first) {
    std::vector<glm::dvec3> normals{first};
    for (std::size_t i = 0; i + 1 < positions.size(); ++i) {
        const glm::dvec3 v1 = positions[i + 1] - positions[i];
        const double c1 = glm::dot(v1, v1);
        if (c1 < 1e-24) {
            normals.push_back(normals.back());
            continue;
        }
        const glm::dvec3 left = normals.back() - (2.0 / c1) * glm::dot(v1, normals.back()) * v1;
        const glm::dvec3 tangent = tangents[i] - (2.0 / c1) * glm::dot(v1, tangents[i]) * v1;
        const glm::dvec3 v2 = tangents[i + 1] - tangent;
        const double c2 = glm::dot(v2, v2);
        glm::dvec3 normal = c2 < 1e-24 ? left : left - (2.0 / c2) * glm::dot(v2, left) * v2;
        // One Gram-Schmidt step removes rounding drift, so that the frame stays orthonormal.
        normal -= glm::dot(normal, tangents[i + 1]) * tangents[i + 1];
        normals.push_back(unit(normal));
    }
    return normals;
}

AxisAngles axis_angles(const Individual& individual) {
    AxisAngles mean;
    for (const SpeciesShare& part : individual.parts) {
        Random random(individual.shape_seed, purposes::axis_angles, stream_of(part.id));
        mean.bend += part.weight * random.uniform(0.0, 2.0 * pi);
        mean.lean += part.weight * random.uniform(0.0, 2.0 * pi);
    }
    return mean;
}

Axis::Axis(const AxisCurve& curve, const DeformationOf<Plain>& deformation,
           const AxisAngles& angles, double base, double top)
    : deformation_(deformation), base_(base), top_(top) {
    const std::vector<glm::dvec3> tangents = curve.tangents();
    const auto across = [](double azimuth) {
        const auto [s, c] = sine_cosine(azimuth);
        return glm::dvec3(s, 0.0, -c);  // a rotation about this tips +Y towards (c, 0, s)
    };
    const glm::dvec3 bend_about = across(angles.bend), lean_about = across(angles.lean);
    const double bend = radians(deformation.bend_deg), lean = radians(deformation.lean_deg);
    const auto tangent_at = [&](double share) {
        const double at = share * stations;
        const double cell = std::min(std::floor(at), stations - 1.0);
        const auto i = static_cast<std::size_t>(cell);
        glm::dvec3 t = tangents[i] + (at - cell) * (tangents[i + 1] - tangents[i]);
        t = turned(unit(t), bend_about, bend * zone_share(deformation, share));
        return turned(t, lean_about, lean);
    };
    const double length = top - base;
    std::vector<glm::dvec3> positions{turned(glm::dvec3(0.0, base, 0.0), lean_about, lean)},
        directions{tangent_at(0.0)};
    for (int i = 1; i <= stations; ++i) {
        const double from = (i - 1.0) / stations, to = static_cast<double>(i) / stations;
        const glm::dvec3 mean =
            (tangent_at(from) + 4.0 * tangent_at(0.5 * (from + to)) + tangent_at(to)) / 6.0;
        positions.push_back(positions.back() + length / stations * mean);
        directions.push_back(tangent_at(to));
        const glm::dvec3 change = directions.back() - directions[directions.size() - 2];
        greatest_curvature_ =
            std::max(greatest_curvature_, std::sqrt(glm::dot(change, change)) * stations / length);
    }
    // The first frame is the upright frame under the shortest rotation.
    const glm::dvec3 up(0.0, 1.0, 0.0);
    const glm::dvec3 axis = glm::cross(up, directions.front());
    const double sine_of_tip = std::sqrt(glm::dot(axis, axis));
    glm::dvec3 first(1.0, 0.0, 0.0);
    if (sine_of_tip > 1e-12)
        first = turned(first, axis / sine_of_tip,
                       arc_tangent(sine_of_tip, glm::dot(up, directions.front())));
    first -= glm::dot(first, directions.front()) * directions.front();
    const auto normals = rotation_minimising_normals(positions, directions, unit(first));
    for (std::size_t i = 0; i < positions.size(); ++i)
        frames_.push_back({positions[i], directions[i], normals[i]});
}

Axis::Local Axis::local(double height) const {
    const double length = top_ - base_;
    const double share = std::clamp((height - base_) / length, 0.0, 1.0);
    const double at = share * stations;
    const double cell = std::min(std::floor(at), stations - 1.0);
    const Frame &a = frames_[static_cast<std::size_t>(cell)],
                &b = frames_[static_cast<std::size_t>(cell) + 1];
    const double t = at - cell;
    const double step = length / stations;
    const SplineSegment<glm::dvec3> curve{a.position, b.position, a.tangent * step,
                                          b.tangent * step};
    const auto sample = curve.at(t);
    const glm::dvec3 y = unit(sample.derivative);
    glm::dvec3 n = a.normal + t * (b.normal - a.normal);
    n = unit(n - glm::dot(n, y) * y);
    const glm::dvec3 m = glm::cross(n, y);  // x cross y is z
    const double zone = zone_share(deformation_, share);
    const double taper = 1.0 + 0.6 * deformation_.taper * (1.0 - zone);
    const auto [s, c] = sine_cosine(radians(deformation_.twist_deg) * zone);
    return {sample.position, taper * (c * n + s * m), y, taper * (c * m - s * n)};
}

AxisStation Axis::frozen_at(double height) const {
    const double inside = std::clamp(height, base_, top_);
    const Local here = local(inside);
    return {here.origin, here.x, here.y, here.z, here.y, glm::dvec3(0.0), glm::dvec3(0.0), inside};
}

AxisStation Axis::at(double height) const {
    AxisStation station = frozen_at(height);
    const double inside = station.height;
    if (height >= base_ && height <= top_) {
        // Central difference of a smooth map in double precision: exact to 1e-9, and the same on
        // every machine.
        const double step = 1e-5 * (top_ - base_);
        const double low = std::max(inside - step, base_), high = std::min(inside + step, top_);
        const Local below = local(low), above = local(high);
        const double span = high - low;
        station.d_origin = (above.origin - below.origin) / span;
        station.d_x = (above.x - below.x) / span;
        station.d_z = (above.z - below.z) / span;
    }
    return station;
}

}  // namespace sporeprint
