#include "tests/support/triangle_grid.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

namespace sporeprint {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

double squared_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const double length = squared(b - a);
    const double t = length > 0.0 ? std::clamp(glm::dot(p - a, b - a) / length, 0.0, 1.0) : 0.0;
    return squared(p - (a + t * (b - a)));
}

double squared_to_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                           const glm::dvec3& c) {
    const glm::dvec3 ab = b - a, ac = c - a, ap = p - a;
    const glm::dvec3 normal = glm::cross(ab, ac);
    const double area = squared(normal);
    if (area > 1e-20 * squared(ab) * squared(ac)) {
        const double v = glm::dot(glm::cross(ap, ac), normal) / area;
        const double w = glm::dot(glm::cross(ab, ap), normal) / area;
        if (v >= 0.0 && w >= 0.0 && v + w <= 1.0) return squared(ap - v * ab - w * ac);
    }
    return std::min(
        {squared_to_segment(p, a, b), squared_to_segment(p, b, c), squared_to_segment(p, c, a)});
}

constexpr double most_cells = 64.0;

}  // namespace

double distance_to_triangle(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b,
                            const glm::dvec3& c) {
    return std::sqrt(squared_to_triangle(point, a, b, c));
}

std::array<glm::dvec3, 3> corners_of(const Mesh& mesh, std::size_t triangle) {
    std::array<glm::dvec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
        corners[k] = glm::dvec3(mesh.positions[mesh.indices[3 * triangle + k]]);
    return corners;
}

TriangleGrid::TriangleGrid(const Mesh& mesh) : mesh_(mesh) {
    glm::dvec3 low(infinite), high(-infinite);
    double edges = 0.0;
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        const auto corners = corners_of(mesh, t);
        for (const glm::dvec3& corner : corners) {
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
        edges += std::sqrt(squared(corners[1] - corners[0]));
    }
    if (mesh.indices.empty()) throw std::invalid_argument("a mesh without triangles");
    const glm::dvec3 size = high - low;
    cell_ = std::max({1.5 * edges / static_cast<double>(mesh.triangles()), size.x / most_cells,
                      size.y / most_cells, size.z / most_cells, 1e-9});
    low_ = low;
    for (int k = 0; k < 3; ++k)
        count_[static_cast<std::size_t>(k)] = static_cast<int>(size[k] / cell_) + 1;
    cells_.resize(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]));
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        const auto corners = corners_of(mesh, t);
        const auto from = cell_of(glm::min(glm::min(corners[0], corners[1]), corners[2]));
        const auto to = cell_of(glm::max(glm::max(corners[0], corners[1]), corners[2]));
        for (int z = from[2]; z <= to[2]; ++z)
            for (int y = from[1]; y <= to[1]; ++y)
                for (int x = from[0]; x <= to[0]; ++x) cell(x, y, z).push_back(t);
    }
}

template <class Visit>
void TriangleGrid::shell(const Cell& home, int reach, const Visit& visit) const {
    const auto range = [&](std::size_t k) {
        return std::array{std::max(home[k] - reach, 0), std::min(home[k] + reach, count_[k] - 1)};
    };
    const auto [x0, x1] = range(0);
    const auto [y0, y1] = range(1);
    const auto [z0, z1] = range(2);
    for (int z = z0; z <= z1; ++z)
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) {
                const int apart =
                    std::max({std::abs(x - home[0]), std::abs(y - home[1]), std::abs(z - home[2])});
                if (apart == reach)
                    visit(cells_[static_cast<std::size_t>((z * count_[1] + y) * count_[0] + x)]);
            }
}

double TriangleGrid::squared_distance(const glm::dvec3& p, double enough, double reach) {
    double best = infinite;
    const auto try_one = [&](std::size_t t) {
        const auto [a, b, c] = corners_of(mesh_, t);
        const double found = squared_to_triangle(p, a, b, c);
        if (found >= best) return;
        best = found;
        last_ = t;
    };
    try_one(last_);
    const auto home = cell_of(p);
    const int shells = std::max({count_[0], count_[1], count_[2]});
    for (int ring = 0; ring <= shells && best > enough; ++ring) {
        // All cells of the inner shells have been searched; the others lie beyond them.
        const double wall = wall_distance(p, home, ring - 1);
        if (best <= wall * wall || wall > reach) break;
        shell(home, ring, [&](const std::vector<std::size_t>& triangles) {
            for (const std::size_t t : triangles) try_one(t);
        });
    }
    return best;
}

TriangleGrid::Cell TriangleGrid::cell_of(const glm::dvec3& p) const {
    Cell found{};
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const double at = std::floor((p[k] - low_[k]) / cell_);
        found[i] = static_cast<int>(std::clamp(at, 0.0, static_cast<double>(count_[i] - 1)));
    }
    return found;
}

std::vector<std::size_t>& TriangleGrid::cell(int x, int y, int z) {
    return cells_[static_cast<std::size_t>((z * count_[1] + y) * count_[0] + x)];
}

double TriangleGrid::wall_distance(const glm::dvec3& p, const Cell& home, int reach) const {
    if (reach < 0) return 0.0;
    double nearest = infinite;
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        if (home[i] - reach > 0)
            nearest = std::min(nearest, p[k] - (low_[k] + (home[i] - reach) * cell_));
        if (home[i] + reach < count_[i] - 1)
            nearest = std::min(nearest, low_[k] + (home[i] + reach + 1) * cell_ - p[k]);
    }
    return std::max(nearest, 0.0);
}

}  // namespace sporeprint
