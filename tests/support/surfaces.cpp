#include "tests/support/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/meshes.h"
#include "tests/support/triangle_grid.h"

namespace sporeprint {

namespace {

/// Returns the diagonal of the box of all vertices used by triangles.
double extent(const Mesh& mesh) {
    glm::dvec3 low(1e300), high(-1e300);
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
