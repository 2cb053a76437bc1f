#include "core/mesh/measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numeric>
#include <tuple>

namespace sporeprint {

namespace {

glm::dvec3 corner(const Mesh& mesh, std::size_t index) {
    return glm::dvec3(mesh.positions[mesh.indices[index]]);
}

/// Returns for every vertex the first one at the same position.
std::vector<std::uint32_t> welded(const Mesh& mesh) {
    std::vector<std::uint32_t> order(mesh.positions.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto place = [&](std::uint32_t i) {
        const glm::vec3& p = mesh.positions[i];
        return std::tuple(p.x + 0.0F, p.y + 0.0F, p.z + 0.0F);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::tuple(place(a), a) < std::tuple(place(b), b);
    });
    std::vector<std::uint32_t> first(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        first[order[i]] =
            i > 0 && place(order[i]) == place(order[i - 1]) ? first[order[i - 1]] : order[i];
    return first;
}

}  // namespace

double volume(const Mesh& mesh) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        sum += glm::dot(corner(mesh, i), glm::cross(corner(mesh, i + 1), corner(mesh, i + 2)));
    return sum / 6.0;
}

double area(const Mesh& mesh) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = corner(mesh, i),
                         n = glm::cross(corner(mesh, i + 1) - a, corner(mesh, i + 2) - a);
        sum += std::sqrt(glm::dot(n, n));
    }
    return 0.5 * sum;
}

SurfaceMoments surface_moments(const Mesh& mesh) {
    SurfaceMoments sum;
    glm::dmat3 squares(0.0);  // of positions, from the origin
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = corner(mesh, i), b = corner(mesh, i + 1), c = corner(mesh, i + 2),
                         all = a + b + c;
        const double own = 0.5 * glm::length(glm::cross(b - a, c - a));
        sum.area += own;
        sum.middle += own / 3.0 * all;
        // The mean of x y over a triangle is a twelfth of the products of its corners and their sum.
        squares += own / 12.0 *
                   (glm::outerProduct(a, a) + glm::outerProduct(b, b) + glm::outerProduct(c, c) +
                    glm::outerProduct(all, all));
    }
    if (!(sum.area > 0.0)) return {};
    sum.middle /= sum.area;
    sum.covariance = squares / sum.area - glm::outerProduct(sum.middle, sum.middle);
    return sum;
}

namespace {

constexpr std::size_t most_defects = 20;  // reported of one mesh

// Largest deviation of the square of a unit vector's length from 1, and of the cosine of a right
// angle from 0.
constexpr float unit_tolerance = 2e-3F;

/// Collects the defects of one mesh.
class Inspection {
  public:
    explicit Inspection(const Mesh& mesh) : mesh_(mesh) {}

    std::vector<std::string> defects() && {
        check_sizes();
        if (!found_.empty()) return std::move(found_);
        for (std::size_t i = 0; i < mesh_.positions.size(); ++i) check_vertex(i);
        check_surface();
        return std::move(found_);
    }

  private:
    void add(std::string text) {
        if (found_.size() < most_defects) found_.push_back(std::move(text));
    }

    void check_sizes() {
        const std::size_t n = mesh_.positions.size();
        if (n == 0 || mesh_.indices.empty()) add("the mesh is empty");
        if (mesh_.normals.size() != n) add("normals and positions differ in number");
        if (!mesh_.tangents.empty() && mesh_.tangents.size() != n)
            add("tangents and positions differ in number");
        if (!mesh_.texture_coordinates.empty() && mesh_.texture_coordinates.size() != n)
            add("texture coordinates and positions differ in number");
        if (!mesh_.tints.empty() && mesh_.tints.size() != n)
            add("tints and positions differ in number");
        if (mesh_.indices.size() % 3 != 0) add("the number of indices is no multiple of three");
    }

    void check_vertex(std::size_t i) {
        const glm::vec3 &p = mesh_.positions[i], &m = mesh_.normals[i];
        const std::string at = " at vertex " + std::to_string(i);
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            add("position is not finite" + at);
        if (!(std::abs(glm::dot(m, m) - 1.0F) < unit_tolerance)) add("normal is not unit" + at);
        if (!mesh_.tangents.empty()) {
            const glm::vec3 t(mesh_.tangents[i]);
            if (!(std::abs(glm::dot(t, t) - 1.0F) < unit_tolerance))
                add("tangent is not unit" + at);
            if (!(std::abs(glm::dot(t, m)) < unit_tolerance))
                add("tangent is not square to the normal" + at);
            if (std::abs(mesh_.tangents[i].w) != 1.0F) add("handedness is not 1 or -1" + at);
        }
        if (!mesh_.tints.empty()) {
            const glm::vec3& tint = mesh_.tints[i];
            for (const float x : {tint.x, tint.y, tint.z})
                if (!(x >= 0.0F && x <= 1.0F)) add("tint is outside 0..1" + at);
        }
        if (!mesh_.texture_coordinates.empty()) {
            const glm::vec2& u = mesh_.texture_coordinates[i];
            if (!(u.x >= 0.0F && u.x <= 1.0F && u.y >= 0.0F && u.y <= 1.0F))
                add("texture coordinate is outside 0..1" + at);
        }
    }

    struct Edge {
        std::uint32_t from, to;
        int times;  // 1 in the direction of its triangle, -1 in that of its neighbour
        // NOLINTNEXTLINE(modernize-use-nullptr): wrong for defaulted comparisons
        auto operator<=>(const Edge&) const = default;
    };

    // Reports triangles with wrong indices, and edges that are not closed by a neighbour.
    void check_surface() {
        const auto weld = welded(mesh_);
        std::vector<Edge> edges;
        edges.reserve(2 * mesh_.indices.size());
        for (std::size_t i = 0; i < mesh_.indices.size(); i += 3) {
            std::array<std::uint32_t, 3> t{};
            for (std::size_t k = 0; k < 3; ++k) {
                t[k] = mesh_.indices[i + k];
                if (t[k] >= mesh_.positions.size())
                    return add("index out of range in triangle " + std::to_string(i / 3));
            }
            if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
                add("repeated index in triangle " + std::to_string(i / 3));
            for (std::size_t k = 0; k < 3; ++k) {
                const auto a = weld[t[k]], b = weld[t[(k + 1) % 3]];
                if (a == b) continue;
                edges.push_back({a, b, 1});
                edges.push_back({b, a, -1});
            }
        }
        std::sort(edges.begin(), edges.end());
        for (std::size_t i = 0; i < edges.size();) {
            const Edge edge = edges[i];
            int count = 0;
            for (; i < edges.size() && edges[i].from == edge.from && edges[i].to == edge.to; ++i)
                count += edges[i].times;
            if (count > 0)
                add("open edge " + std::to_string(edge.from) + "-" + std::to_string(edge.to));
        }
    }

    const Mesh& mesh_;
    std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> defects(const Mesh& mesh) { return Inspection(mesh).defects(); }

}  // namespace sporeprint
