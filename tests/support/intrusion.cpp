#include "tests/support/intrusion.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "tests/support/triangle_grid.h"

namespace sporeprint {

namespace {

constexpr int cells = 24;

int cell_of(double at, double from, double size) {
    return std::clamp(static_cast<int>(std::floor((at - from) / size)), 0, cells - 1);
}

}  // namespace

Solid::Solid(const Mesh& mesh) : mesh_(mesh), box_(bounds(mesh)), columns_(cells * cells) {
    cell_x_ = std::max(static_cast<double>(box_.max.x - box_.min.x) / cells, 1e-9);
    cell_z_ = std::max(static_cast<double>(box_.max.z - box_.min.z) / cells, 1e-9);
    for (std::uint32_t t = 0; t < mesh.triangles(); ++t) {
        glm::dvec3 low(1e9), high(-1e9);
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 corner(mesh.positions[mesh.indices[3 * t + k]]);
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
        for (int j = cell_of(low.z, box_.min.z, cell_z_); j <= cell_of(high.z, box_.min.z, cell_z_);
             ++j)
            for (int i = cell_of(low.x, box_.min.x, cell_x_);
                 i <= cell_of(high.x, box_.min.x, cell_x_); ++i)
                columns_[static_cast<std::size_t>(j * cells + i)].push_back(t);
    }
}

bool Solid::contains(const glm::dvec3& point) const {
    const glm::dvec3 low(box_.min), high(box_.max);
    if (point.x < low.x || point.y < low.y || point.z < low.z || point.x > high.x ||
        point.y > high.y || point.z > high.z)
        return false;
    const auto column = static_cast<std::size_t>(cell_of(point.z, low.z, cell_z_) * cells +
                                                 cell_of(point.x, low.x, cell_x_));
    // Counts crossings of an upward ray, signed by the side of the triangle.
    int winding = 0;
    for (const std::uint32_t t : columns_[column]) {
        auto [a, b, c] = corners_of(mesh_, t);
        for (glm::dvec3* corner : {&a, &b, &c}) *corner -= point;
        const double u = b.x * c.z - b.z * c.x, v = c.x * a.z - c.z * a.x,
                     w = a.x * b.z - a.z * b.x;
        const double area = u + v + w;
        if (area == 0.0) continue;
        if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) continue;
        if ((u * a.y + v * b.y + w * c.y) / area > 0.0) winding += area < 0.0 ? 1 : -1;
    }
    return winding > 0;
}

double Solid::depth(const glm::dvec3& point) const {
    if (!contains(point)) return 0.0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::uint32_t t = 0; t < mesh_.triangles(); ++t) {
        const auto [a, b, c] = corners_of(mesh_, t);
        nearest = std::min(nearest, distance_to_triangle(point, a, b, c));
    }
    return nearest;
}

std::vector<glm::dvec3> samples_of(const Mesh& mesh) {
    std::vector<glm::dvec3> samples;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[i]]), b(mesh.positions[mesh.indices[i + 1]]),
            c(mesh.positions[mesh.indices[i + 2]]);
        samples.push_back((a + b + c) / 3.0);
        if (mesh.indices[i] < mesh.indices[i + 1]) samples.push_back(0.5 * (a + b));
    }
    for (const glm::vec3& p : mesh.positions) samples.emplace_back(p);
    return samples;
}

}  // namespace sporeprint
