#include "core/geometry/sphere_cells.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

/// How far points are moved from an even spiral, in mean distances of neighbours, and how many times
/// each is then moved to the middle of its cell. No source or measurement is recorded for them; two
/// rounds leave meshes of four to eight sides.
constexpr double displacement = 0.45;
constexpr int relaxations = 2;

/// Corners of a facet of the convex hull, counter-clockwise seen from outside.
using Facet = std::array<std::size_t, 3>;

/// Returns the facets of the convex hull of points on the sphere: their Delaunay triangles. All
/// triples are tried, which is the simplest way and takes a millisecond for the largest net.
std::vector<Facet> hull(const std::vector<glm::dvec3>& points) {
    std::vector<Facet> facets;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = i + 1; j < points.size(); ++j)
            for (std::size_t k = j + 1; k < points.size(); ++k) {
                const glm::dvec3 normal = glm::cross(points[j] - points[i], points[k] - points[i]);
                bool above = false, below = false;
                for (std::size_t l = 0; l < points.size() && !(above && below); ++l) {
                    if (l == i || l == j || l == k) continue;
                    (glm::dot(normal, points[l] - points[i]) > 0.0 ? above : below) = true;
                }
                if (!above) facets.push_back({i, j, k});
                if (!below) facets.push_back({i, k, j});
            }
    return facets;
}

/// Returns the cells whose neighbours are those of the facets.
SphereCells cells_of(const std::vector<glm::dvec3>& points, const std::vector<Facet>& facets) {
    SphereCells net;
    for (const auto& [i, j, k] : facets)
        net.corners.push_back(unit_or(glm::cross(points[j] - points[i], points[k] - points[i]),
                                      glm::dvec3(0.0, 1.0, 0.0)));
    for (std::size_t point = 0; point < points.size(); ++point) {
        // Round a point, the facet after (point, a, b) is the one that begins with (point, b).
        std::vector<std::array<std::size_t, 3>> around;  // a, b, corner
        for (std::size_t f = 0; f < facets.size(); ++f)
            for (std::size_t turn = 0; turn < 3; ++turn)
                if (facets[f][turn] == point)
                    around.push_back({facets[f][(turn + 1) % 3], facets[f][(turn + 2) % 3], f});
        SphereCells::Cell cell{points[point], {}};
        std::size_t at = 0;
        for (std::size_t n = 0; n < around.size(); ++n) {
            cell.corners.push_back(around[at][2]);
            for (std::size_t next = 0; next < around.size(); ++next)
                if (around[next][0] == around[at][1]) {
                    at = next;
                    break;
                }
        }
        net.cells.push_back(cell);
    }
    return net;
}

/// Turns a net so that the corner that is nearest to the bottom is the lowest point.
SphereCells standing(SphereCells net) {
    const glm::dvec3 down(0.0, -1.0, 0.0);
    const glm::dvec3 foot =
        *std::min_element(net.corners.begin(), net.corners.end(),
                          [](const glm::dvec3& a, const glm::dvec3& b) { return a.y < b.y; });
    for (glm::dvec3& corner : net.corners) corner = carried(corner, foot, down);
    for (SphereCells::Cell& cell : net.cells) cell.centre = carried(cell.centre, foot, down);
    return net;
}

}  // namespace

SphereCells sphere_cells(int count, std::uint32_t seed) {
    assert(count >= least_cells);
    const auto n = static_cast<std::size_t>(count);
    Random random(seed, purposes::net_cells);
    const double turned = random.uniform(0.0, 2.0 * pi);
    const double apart = std::sqrt(4.0 * pi / count);
    const double golden = pi * (3.0 - std::sqrt(5.0));
    for (;;) {
        std::vector<glm::dvec3> points;
        for (std::size_t i = 0; i < n; ++i) {
            const double y = 1.0 - 2.0 * (static_cast<double>(i) + 0.5) / count;
            const double r = std::sqrt(1.0 - y * y);
            const SineCosine turn = sine_cosine(turned + golden * static_cast<double>(i));
            glm::dvec3 by(0.0);
            by.x = random.symmetric();
            by.y = random.symmetric();
            by.z = random.symmetric();
            points.push_back(
                unit_or(glm::dvec3(r * turn.cosine, y, r * turn.sine) + displacement * apart * by,
                        glm::dvec3(0.0, 1.0, 0.0)));
        }
        std::vector<Facet> facets = hull(points);
        for (int round = 0; round < relaxations; ++round) {
            const SphereCells net = cells_of(points, facets);
            for (std::size_t i = 0; i < n; ++i) {
                glm::dvec3 middle(0.0);
                for (const std::size_t corner : net.cells[i].corners) middle += net.corners[corner];
                points[i] = unit_or(middle, points[i]);
            }
            facets = hull(points);
        }
        // Four points on one circle would give a corner more or less: others are drawn.
        if (facets.size() == 2 * n - 4) return standing(cells_of(points, facets));
    }
}

}  // namespace sporeprint
