#include "core/collision/convex_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <tuple>

#include "core/math/elementary.h"

namespace sporeprint {

namespace {

/// A point on the grid. Coordinates are within +-32768, so that a determinant of three differences
/// has less than 54 bits.
struct GridPoint {
    std::array<std::int64_t, 3> at{};
    std::uint32_t index = 0;  ///< of the point that it stands for
};

using Corners = std::array<std::uint32_t, 3>;

/// Returns the points on their grid, each place once, in the order of their coordinates.
std::vector<GridPoint> on_grid(std::span<const glm::vec3> points) {
    glm::dvec3 low(points.front()), high = low;
    for (const glm::vec3& point : points) {
        low = glm::min(low, glm::dvec3(point));
        high = glm::max(high, glm::dvec3(point));
    }
    const glm::dvec3 size = high - low, middle = 0.5 * (low + high);
    const double longest = std::max({size.x, size.y, size.z});
    std::vector<GridPoint> grid;
    if (!(longest > 0.0)) return grid;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 scaled = (glm::dvec3(points[i]) - middle) * (65536.0 / longest);
        GridPoint point{.index = static_cast<std::uint32_t>(i)};
        for (int k = 0; k < 3; ++k)
            point.at[static_cast<std::size_t>(k)] =
                static_cast<std::int64_t>(std::floor(scaled[k] + 0.5));
        grid.push_back(point);
    }
    std::sort(grid.begin(), grid.end(), [](const GridPoint& a, const GridPoint& b) {
        return std::tuple(a.at, a.index) < std::tuple(b.at, b.index);
    });
    const auto end =
        std::unique(grid.begin(), grid.end(),
                    [](const GridPoint& a, const GridPoint& b) { return a.at == b.at; });
    grid.erase(end, grid.end());
    return grid;
}

std::array<std::int64_t, 3> difference(const GridPoint& a, const GridPoint& b) {
    return {a.at[0] - b.at[0], a.at[1] - b.at[1], a.at[2] - b.at[2]};
}

std::array<std::int64_t, 3> cross(const std::array<std::int64_t, 3>& a,
                                  const std::array<std::int64_t, 3>& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A triangle of the hull, with the normal that points outwards.
struct Face {
    Corners corners;
    std::array<std::int64_t, 3> normal;
};

class Hull {
  public:
    explicit Hull(const std::vector<GridPoint>& points) : points_(points) {}

    /// Begins with a tetrahedron.
    ///
    /// returns  false if all points are in one plane
    bool begin() {
        const auto count = static_cast<std::uint32_t>(points_.size());
        std::uint32_t c = 0, d = 0;
        const std::uint32_t a = 0, b = count - 1;
        for (std::uint32_t i = 1; i < b && c == 0; ++i) {
            const auto normal = cross(from(a, b), from(a, i));
            if (normal != std::array<std::int64_t, 3>{}) c = i;
        }
        if (c == 0) return false;
        const Face base = face({a, b, c});
        for (std::uint32_t i = 1; i < b && d == 0; ++i)
            if (height(base, i) != 0) d = i;
        if (d == 0) return false;
        const bool above = height(base, d) > 0;
        const std::uint32_t second = above ? c : b, third = above ? b : c;
        faces_ = {face({a, second, third}), face({a, d, second}), face({second, d, third}),
                  face({third, d, a})};
        return true;
    }

    /// Adds a point: the triangles that it sees are replaced by those that join their border to it.
    void add(std::uint32_t point) {
        std::vector<std::array<std::uint32_t, 2>> edges;
        const auto seen = [&](const Face& one) { return height(one, point) > 0; };
        for (const Face& one : faces_) {
            if (!seen(one)) continue;
            for (std::size_t k = 0; k < 3; ++k)
                edges.push_back({one.corners[k], one.corners[(k + 1) % 3]});
        }
        if (edges.empty()) return;
        faces_.erase(std::remove_if(faces_.begin(), faces_.end(), seen), faces_.end());
        std::sort(edges.begin(), edges.end());
        for (const auto& [from, to] : edges)
            if (!std::binary_search(edges.begin(), edges.end(),
                                    std::array<std::uint32_t, 2>{to, from}))
                faces_.push_back(face({from, to, point}));
    }

    [[nodiscard]] const std::vector<Face>& faces() const { return faces_; }

  private:
    const std::vector<GridPoint>& points_;
    std::vector<Face> faces_;

    [[nodiscard]] std::array<std::int64_t, 3> from(std::uint32_t a, std::uint32_t b) const {
        return difference(points_[b], points_[a]);
    }
    [[nodiscard]] Face face(const Corners& corners) const {
        return {corners, cross(from(corners[0], corners[1]), from(corners[0], corners[2]))};
    }
    /// Returns a multiple of the height of a point over the plane of a triangle.
    [[nodiscard]] std::int64_t height(const Face& one, std::uint32_t point) const {
        const auto to = from(one.corners[0], point);
        return one.normal[0] * to[0] + one.normal[1] * to[1] + one.normal[2] * to[2];
    }
};

}  // namespace

Mesh convex_hull(std::span<const glm::vec3> points) {
    Mesh mesh;
    if (points.size() < 4) return mesh;
    const std::vector<GridPoint> grid = on_grid(points);
    if (grid.size() < 4) return mesh;
    Hull hull(grid);
    if (!hull.begin()) return mesh;
    for (std::uint32_t i = 1; i + 1 < grid.size(); ++i) hull.add(i);
    constexpr std::uint32_t none = ~std::uint32_t{0};
    std::vector<std::uint32_t> vertex_of(grid.size(), none);
    std::vector<glm::dvec3> normals;
    for (const Face& face : hull.faces()) {
        const glm::dvec3 normal(face.normal[0], face.normal[1], face.normal[2]);
        for (const std::uint32_t corner : face.corners) {
            std::uint32_t& vertex = vertex_of[corner];
            if (vertex == none) {
                vertex = static_cast<std::uint32_t>(mesh.positions.size());
                mesh.positions.push_back(points[grid[corner].index]);
                normals.emplace_back(0.0);
            }
            mesh.indices.push_back(vertex);
            normals[vertex] += normal;
        }
    }
    for (const glm::dvec3& normal : normals)
        mesh.normals.emplace_back(normal / std::sqrt(glm::dot(normal, normal)));
    return mesh;
}

std::vector<glm::dvec3> directions(int azimuths, int latitudes) {
    std::vector<glm::dvec3> all{{0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}};
    for (int j = 0; j < latitudes; ++j) {
        const SineCosine latitude = sine_cosine(pi * ((j + 1.0) / (latitudes + 1.0) - 0.5));
        for (int i = 0; i < azimuths; ++i) {
            const SineCosine azimuth = sine_cosine(2.0 * pi * i / azimuths);
            all.emplace_back(latitude.cosine * azimuth.cosine, latitude.sine,
                             latitude.cosine * azimuth.sine);
        }
    }
    return all;
}

std::vector<glm::vec3> farthest_points(std::span<const glm::vec3> points,
                                       std::span<const glm::dvec3> directions) {
    if (points.empty()) return {};
    std::vector<std::size_t> chosen;
    for (const glm::dvec3& direction : directions) {
        std::size_t best = 0;
        double farthest = glm::dot(direction, glm::dvec3(points.front()));
        for (std::size_t i = 1; i < points.size(); ++i) {
            const double along = glm::dot(direction, glm::dvec3(points[i]));
            if (along > farthest) {
                farthest = along;
                best = i;
            }
        }
        chosen.push_back(best);
    }
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    std::vector<glm::vec3> farthest;
    farthest.reserve(chosen.size());
    for (const std::size_t i : chosen) farthest.push_back(points[i]);
    return farthest;
}

}  // namespace sporeprint
