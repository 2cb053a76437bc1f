#include "core/mesh/thickness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "core/math/direction.h"
#include "core/math/elementary.h"

namespace sporeprint {

namespace {

/// Cells of the grid on its longest side at most.
constexpr int most_cells = 96;

/// How far from a vertex a ray begins to be stopped, as a share of the greatest thickness: the
/// triangles round the vertex lie at its very start.
constexpr double start_share = 2e-3;

/// The triangles of a mesh, sorted into the cells of a grid that they may touch.
class TriangleGrid {
  public:
    explicit TriangleGrid(const Mesh& mesh) : mesh_(mesh) {
        const Bounds box = bounds(mesh);
        const glm::dvec3 extent = glm::dvec3(box.max) - glm::dvec3(box.min);
        const double longest = std::max({extent.x, extent.y, extent.z, 1e-6});
        // About as many cells along the surface as there are triangles.
        const double wanted = std::sqrt(static_cast<double>(mesh.triangles()));
        cell_ = longest / std::clamp(wanted, 1.0, static_cast<double>(most_cells));
        // The margin keeps vertices on the border inside.
        from_ = glm::dvec3(box.min) - glm::dvec3(0.5 * cell_);
        for (int axis = 0; axis < 3; ++axis)
            sides_[axis] = static_cast<int>(extent[axis] / cell_) + 2;
        sort_triangles();
    }

    /// Returns the distance at which a ray that starts just inside leaves the solid, at most `most`.
    ///
    /// direction  unit vector
    /// start      nearer surfaces are not met
    [[nodiscard]] double exit(const glm::dvec3& origin, const glm::dvec3& direction, double start,
                              double most) const {
        glm::ivec3 cell, step;
        glm::dvec3 next, between;
        for (int axis = 0; axis < 3; ++axis) {
            cell[axis] = cell_of(origin[axis], axis);
            const double along = direction[axis];
            step[axis] = along < 0.0 ? -1 : 1;
            if (std::abs(along) < 1e-12) {
                next[axis] = between[axis] = 1e30;
                continue;
            }
            const double wall = from_[axis] + cell_ * (cell[axis] + (along < 0.0 ? 0 : 1));
            next[axis] = (wall - origin[axis]) / along;
            between[axis] = cell_ / std::abs(along);
        }
        int inside = 1;  // of how many overlapping parts the ray is
        double reached = start;
        std::vector<std::pair<double, int>> met;
        while (reached < most) {
            const int axis =
                next.x <= next.y ? (next.x <= next.z ? 0 : 2) : (next.y <= next.z ? 1 : 2);
            const double to = std::min(next[axis], most);
            met.clear();
            meet(cell, origin, direction, reached, to, met);
            std::sort(met.begin(), met.end());
            for (const auto& [distance, change] : met)
                if ((inside += change) <= 0) return distance;
            reached = std::max(reached, to);
            cell[axis] += step[axis];
            if (cell[axis] < 0 || cell[axis] >= sides_[axis]) break;
            next[axis] += between[axis];
        }
        return most;
    }

  private:
    const Mesh& mesh_;
    double cell_ = 1.0;
    glm::dvec3 from_{0.0};
    glm::ivec3 sides_{1};
    std::vector<std::uint32_t> first_;   ///< of each cell in `sorted_`, and the end
    std::vector<std::uint32_t> sorted_;  ///< triangles

    [[nodiscard]] int cell_of(double place, int axis) const {
        return std::clamp(static_cast<int>((place - from_[axis]) / cell_), 0, sides_[axis] - 1);
    }

    [[nodiscard]] std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(sides_.y) +
                static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(sides_.x) +
               static_cast<std::size_t>(x);
    }

    [[nodiscard]] std::array<glm::dvec3, 3> corners(std::size_t triangle) const {
        const std::uint32_t* const at = &mesh_.indices[3 * triangle];
        return {glm::dvec3(mesh_.positions[at[0]]), glm::dvec3(mesh_.positions[at[1]]),
                glm::dvec3(mesh_.positions[at[2]])};
    }

    /// Calls `visit(cell)` for each cell that the box of a triangle touches.
    template <class Visit>
    void each_cell(std::size_t triangle, Visit visit) const {
        const auto [a, b, c] = corners(triangle);
        const glm::dvec3 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
        glm::ivec3 first, last;
        for (int axis = 0; axis < 3; ++axis) {
            first[axis] = cell_of(low[axis], axis);
            last[axis] = cell_of(high[axis], axis);
        }
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x) visit(index(x, y, z));
    }

    void sort_triangles() {
        first_.assign(index(0, 0, sides_.z) + 1, 0);
        for (std::size_t i = 0; i < mesh_.triangles(); ++i)
            each_cell(i, [&](std::size_t cell) { ++first_[cell + 1]; });
        for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
        sorted_.resize(first_.back());
        std::vector<std::uint32_t> place(first_.begin(), first_.end() - 1);
        for (std::size_t i = 0; i < mesh_.triangles(); ++i)
            each_cell(i, [&](std::size_t cell) {
                sorted_[place[cell]++] = static_cast<std::uint32_t>(i);
            });
    }

    /// Adds where a ray meets triangles of a cell between two distances, and whether it enters (1)
    /// or leaves (-1) a part there.
    void meet(const glm::ivec3& cell, const glm::dvec3& origin, const glm::dvec3& direction,
              double from, double to, std::vector<std::pair<double, int>>& met) const {
        const std::size_t which = index(cell.x, cell.y, cell.z);
        for (std::uint32_t i = first_[which]; i < first_[which + 1]; ++i) {
            const auto [a, b, c] = corners(sorted_[i]);
            const glm::dvec3 ab = b - a, ac = c - a, across = glm::cross(direction, ac);
            const double facing = glm::dot(ab, across);  // > 0: the ray meets the outer face
            if (facing == 0.0) continue;
            const glm::dvec3 to_origin = origin - a;
            const double u = glm::dot(to_origin, across) / facing;
            if (u < 0.0 || u > 1.0) continue;
            const glm::dvec3 other = glm::cross(to_origin, ab);
            const double v = glm::dot(direction, other) / facing;
            if (v < 0.0 || u + v > 1.0) continue;
            const double distance = glm::dot(ac, other) / facing;
            if (distance >= from && distance < to)
                met.emplace_back(distance, facing > 0.0 ? 1 : -1);
        }
    }
};

/// A direction in a cone round an axis: its parts along the axis and along two directions square
/// to it.
using ConeRay = glm::dvec3;

/// Returns the rays of a vertex: the axis itself, 4 at 30 and 6 at 58 degrees. Flatter ones would leave
/// between the triangles of a round surface.
std::array<ConeRay, 11> cone_rays() {
    std::array<ConeRay, 11> rays;
    std::size_t count = 0;
    rays[count++] = {1.0, 0.0, 0.0};
    const auto add_ring = [&](int sides, double degrees) {
        const auto [level, along] = sine_cosine(degrees * pi / 180.0);
        for (int i = 0; i < sides; ++i) {
            const auto [sine, cosine] = sine_cosine(2.0 * pi * i / sides);
            rays[count++] = {along, level * cosine, level * sine};
        }
    };
    add_ring(4, 30.0);
    add_ring(6, 58.0);
    return rays;
}

}  // namespace

std::vector<float> thickness(const Mesh& mesh, double most, const Parallel& parallel) {
    constexpr std::size_t chunk = 1024;  // vertices of a task
    const TriangleGrid grid(mesh);
    const std::array<ConeRay, 11> rays = cone_rays();
    std::vector<float> found(mesh.positions.size());
    const auto at = [&](std::size_t vertex) {
        const glm::dvec3 origin(mesh.positions[vertex]);
        const glm::dvec3 inward = -unit_or(glm::dvec3(mesh.normals[vertex]), {0.0, 1.0, 0.0});
        const glm::dvec3 side = square_to(inward, {0.3, 1.0, 0.1});
        const glm::dvec3 other = glm::cross(inward, side);
        double least = most;
        for (const ConeRay& ray : rays) {
            // A ball through the vertex and the point at a distance along the ray, whose centre is
            // on the normal, has the diameter distance / ray.x.
            const double reach = least * ray.x;
            const glm::dvec3 direction = inward * ray.x + side * ray.y + other * ray.z;
            least =
                std::min(least, grid.exit(origin, direction, start_share * most, reach) / ray.x);
        }
        return static_cast<float>(least);
    };
    std::vector<std::function<void()>> tasks;
    for (std::size_t from = 0; from < found.size(); from += chunk)
        tasks.emplace_back([&, from] {
            for (std::size_t i = from; i < std::min(from + chunk, found.size()); ++i)
                found[i] = at(i);
        });
    parallel(tasks);
    return found;
}

}  // namespace sporeprint
