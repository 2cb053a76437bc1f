#include "core/mesh/measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <glm/geometric.hpp>
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

std::vector<std::string> defects(const Mesh& mesh) {
    std::vector<std::string> found;
    const auto add_defect = [&](std::string text) {
        if (found.size() < 20) found.push_back(std::move(text));
    };
    const std::size_t n = mesh.positions.size();
    if (n == 0 || mesh.indices.empty()) add_defect("the mesh is empty");
    if (mesh.normals.size() != n) add_defect("normals and positions differ in number");
    if (!mesh.tangents.empty() && mesh.tangents.size() != n)
        add_defect("tangents and positions differ in number");
    if (!mesh.texture_coordinates.empty() && mesh.texture_coordinates.size() != n)
        add_defect("texture coordinates and positions differ in number");
    if (mesh.indices.size() % 3 != 0) add_defect("the number of indices is no multiple of three");
    if (!found.empty()) return found;
    for (std::size_t i = 0; i < n; ++i) {
        const glm::vec3 &p = mesh.positions[i], &m = mesh.normals[i];
        const std::string at = " at vertex " + std::to_string(i);
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            add_defect("position is not finite" + at);
        if (!(std::abs(glm::dot(m, m) - 1.0F) < 2e-3F)) add_defect("normal is not unit" + at);
        if (!mesh.tangents.empty()) {
            const glm::vec3 t(mesh.tangents[i]);
            if (!(std::abs(glm::dot(t, t) - 1.0F) < 2e-3F)) add_defect("tangent is not unit" + at);
            if (!(std::abs(glm::dot(t, m)) < 2e-3F))
                add_defect("tangent is not square to the normal" + at);
            if (std::abs(mesh.tangents[i].w) != 1.0F) add_defect("handedness is not 1 or -1" + at);
        }
        if (!mesh.texture_coordinates.empty()) {
            const glm::vec2& u = mesh.texture_coordinates[i];
            if (!(u.x >= 0.0F && u.x <= 1.0F && u.y >= 0.0F && u.y <= 1.0F))
                add_defect("texture coordinate is outside 0..1" + at);
        }
    }
    const auto weld = welded(mesh);
    struct Edge {
        std::uint32_t from, to;
        int times;  // 1 in the direction of its triangle, -1 in that of its neighbour
        // NOLINTNEXTLINE(modernize-use-nullptr): wrong for defaulted comparisons
        auto operator<=>(const Edge&) const = default;
    };
    std::vector<Edge> edges;
    edges.reserve(2 * mesh.indices.size());
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        std::array<std::uint32_t, 3> t{};
        for (std::size_t k = 0; k < 3; ++k) {
            t[k] = mesh.indices[i + k];
            if (t[k] >= n) {
                add_defect("index out of range in triangle " + std::to_string(i / 3));
                return found;
            }
        }
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
            add_defect("repeated index in triangle " + std::to_string(i / 3));
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
            add_defect("open edge " + std::to_string(edge.from) + "-" + std::to_string(edge.to));
    }
    return found;
}

}  // namespace sporeprint
