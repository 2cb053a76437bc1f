#include "tests/support/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/meshes.h"

namespace sporeprint {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

double squared(const glm::dvec3& v) { return glm::dot(v, v); }

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

std::array<glm::dvec3, 3> corners_of(const Mesh& mesh, std::size_t triangle) {
    std::array<glm::dvec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
        corners[k] = glm::dvec3(mesh.positions[mesh.indices[3 * triangle + k]]);
    return corners;
}

/// The triangles of a mesh, indexed by the cells of a grid that their boxes touch.
class TriangleGrid {
  public:
    explicit TriangleGrid(const Mesh& mesh) : mesh_(mesh) {
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

    /// Returns the squared distance from a point to the nearest triangle, or to any triangle within
    /// `enough`. Consecutive points are neighbours, so the last result is tried first.
    [[nodiscard]] double squared_distance(const glm::dvec3& p, double enough) {
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
        const int farthest = std::max({count_[0], count_[1], count_[2]});
        for (int reach = 0; reach <= farthest && best > enough; ++reach) {
            // All cells of the inner shells have been searched; the others lie beyond them.
            const double wall = wall_distance(p, home, reach - 1);
            if (best <= wall * wall) break;
            shell(home, reach, [&](const std::vector<std::size_t>& triangles) {
                for (const std::size_t t : triangles) try_one(t);
            });
        }
        return best;
    }

  private:
    using Cell = std::array<int, 3>;
    static constexpr double most_cells = 64.0;

    [[nodiscard]] Cell cell_of(const glm::dvec3& p) const {
        Cell found{};
        for (int k = 0; k < 3; ++k) {
            const auto i = static_cast<std::size_t>(k);
            const double at = std::floor((p[k] - low_[k]) / cell_);
            found[i] = static_cast<int>(std::clamp(at, 0.0, static_cast<double>(count_[i] - 1)));
        }
        return found;
    }

    [[nodiscard]] std::vector<std::size_t>& cell(int x, int y, int z) {
        return cells_[static_cast<std::size_t>((z * count_[1] + y) * count_[0] + x)];
    }

    /// Returns the distance of p from the nearest cell outside the block of `reach` cells round
    /// `home`; 0 or less if p may be in one.
    [[nodiscard]] double wall_distance(const glm::dvec3& p, const Cell& home, int reach) const {
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

    template <class Visit>
    void shell(const Cell& home, int reach, const Visit& visit) const {
        const auto range = [&](std::size_t k) {
            return std::array{std::max(home[k] - reach, 0),
                              std::min(home[k] + reach, count_[k] - 1)};
        };
        const auto [x0, x1] = range(0);
        const auto [y0, y1] = range(1);
        const auto [z0, z1] = range(2);
        for (int z = z0; z <= z1; ++z)
            for (int y = y0; y <= y1; ++y)
                for (int x = x0; x <= x1; ++x) {
                    const int apart = std::max(
                        {std::abs(x - home[0]), std::abs(y - home[1]), std::abs(z - home[2])});
                    if (apart == reach)
                        visit(
                            cells_[static_cast<std::size_t>((z * count_[1] + y) * count_[0] + x)]);
                }
    }

    const Mesh& mesh_;
    glm::dvec3 low_{0.0};
    double cell_ = 0.0;
    Cell count_{};
    std::vector<std::vector<std::size_t>> cells_;
    std::size_t last_ = 0;
};

/// Returns the diagonal of the box of all vertices used by triangles.
double extent(const Mesh& mesh) {
    glm::dvec3 low(infinite), high(-infinite);
    for (const std::uint32_t i : mesh.indices) {
        low = glm::min(low, glm::dvec3(mesh.positions[i]));
        high = glm::max(high, glm::dvec3(mesh.positions[i]));
    }
    return mesh.indices.empty() ? 0.0 : std::sqrt(squared(high - low));
}

double one_way(const Mesh& from, const Mesh& to) {
    TriangleGrid grid(to);
    double worst = 0.0;
    const auto look = [&](const glm::dvec3& p) {
        worst = std::max(worst,
                         grid.squared_distance(p, worst));  // nearer ones do not change the maximum
    };
    std::vector<bool> seen(from.positions.size());
    // A part that has almost vanished is a point beside the surface and not visible.
    const double whole = extent(from), speck = 1e-10 * whole * whole;
    for (std::size_t t = 0; t < from.triangles(); ++t) {
        const auto [a, b, c] = corners_of(from, t);
        if (squared(b - a) < speck && squared(c - b) < speck) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = from.indices[3 * t + k];
            if (!seen[vertex]) look(glm::dvec3(from.positions[vertex]));
            seen[vertex] = true;
        }
        look((a + b + c) / 3.0);
        // Each inner edge belongs to two triangles and is sampled once.
        if (from.indices[3 * t] < from.indices[3 * t + 1]) look(0.5 * (a + b));
        if (from.indices[3 * t + 1] < from.indices[3 * t + 2]) look(0.5 * (b + c));
        if (from.indices[3 * t + 2] < from.indices[3 * t]) look(0.5 * (c + a));
    }
    return std::sqrt(worst);
}

}  // namespace

double distance_to_triangle(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b,
                            const glm::dvec3& c) {
    return std::sqrt(squared_to_triangle(point, a, b, c));
}

double hausdorff(const Mesh& a, const Mesh& b) { return std::max(one_way(a, b), one_way(b, a)); }

double jump(const Mesh& a, const Mesh& b) {
    if (a.positions.size() != b.positions.size()) return hausdorff(a, b);
    const auto shown = [](const Mesh& mesh) {
        std::vector<bool> used(mesh.positions.size());
        for (const std::uint32_t i : mesh.indices) used[i] = true;
        return used;
    };
    const auto in_a = shown(a), in_b = shown(b);
    double worst = 0.0;
    for (std::size_t i = 0; i < in_a.size(); ++i)
        if (in_a[i] && in_b[i])
            worst =
                std::max(worst, squared(glm::dvec3(a.positions[i]) - glm::dvec3(b.positions[i])));
    worst = std::sqrt(worst);
    if (a.indices != b.indices)
        for (const Mesh& alone : {only_in(a, b), only_in(b, a)})
            for (const Mesh& piece : pieces(alone)) {
                const double length = extent(piece);
                if (length > 0.0) worst = std::max(worst, area(piece) / length);
            }
    return worst;
}

Mesh only_in(const Mesh& mesh, const Mesh& other) {
    if (mesh.positions.size() != other.positions.size())
        throw std::invalid_argument(std::to_string(mesh.positions.size()) + " vertices against " +
                                    std::to_string(other.positions.size()));
    using Triangle = std::array<std::uint32_t, 3>;
    const auto triangle = [](const Mesh& of, std::size_t i) {
        return Triangle{of.indices[i], of.indices[i + 1], of.indices[i + 2]};
    };
    std::vector<Triangle> known;
    for (std::size_t i = 0; i + 2 < other.indices.size(); i += 3)
        known.push_back(triangle(other, i));
    std::sort(known.begin(), known.end());
    Mesh found;
    found.positions = mesh.positions;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const Triangle one = triangle(mesh, i);
        if (!std::binary_search(known.begin(), known.end(), one))
            found.indices.insert(found.indices.end(), one.begin(), one.end());
    }
    return found;
}

}  // namespace sporeprint
