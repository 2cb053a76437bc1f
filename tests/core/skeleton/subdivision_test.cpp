#include "core/skeleton/subdivision.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

#include "core/math/random.h"
#include "core/problems.h"

namespace sporeprint::skeleton_subdivision_test {
namespace {

const QuadMesh cube = {
    {{-1, -1, -1},
     {1, -1, -1},
     {-1, 1, -1},
     {1, 1, -1},
     {-1, -1, 1},
     {1, -1, 1},
     {-1, 1, 1},
     {1, 1, 1}},
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

// Returns quads in rows and columns that close to a torus, with arbitrary points.
QuadMesh torus(std::uint32_t rows, std::uint32_t columns) {
    Random random(11, 9100);
    QuadMesh mesh;
    for (std::uint32_t i = 0; i < rows * columns; ++i) {
        const double x = random.symmetric(), y = random.symmetric(), z = random.symmetric();
        mesh.points.emplace_back(x, y, z);
    }
    for (std::uint32_t i = 0; i < rows; ++i)
        for (std::uint32_t j = 0; j < columns; ++j) {
            const std::uint32_t next = (i + 1) % rows, right = (j + 1) % columns;
            mesh.quads.push_back(
                {i * columns + j, i * columns + right, next * columns + right, next * columns + j});
        }
    return mesh;
}

std::vector<std::array<std::uint32_t, 4>> quads_of(const Subdivided& fine) {
    std::vector<std::array<std::uint32_t, 4>> quads;
    for (std::size_t parent = 0; parent < fine.parents.size(); ++parent) {
        const std::array<std::uint32_t, 9> p = fine.patch(parent);
        quads.push_back({p[0], p[1], p[2], p[3]});
        quads.push_back({p[1], p[4], p[5], p[2]});
        quads.push_back({p[2], p[5], p[6], p[7]});
        quads.push_back({p[3], p[2], p[7], p[8]});
    }
    return quads;
}

TEST(Subdivision, OfACubeHasTheKnownMasks) {
    const Subdivided fine = subdivided(cube, 1);
    ASSERT_EQ(fine.points.size(), 8U + 6U + 12U);
    const auto near = [](const glm::dvec3& a, const glm::dvec3& b) {
        return glm::distance(a, b) < 1e-15;
    };
    // The mask is (n - 2) / n of a corner, and 1 / n^2 of its three neighbours and three face
    // points.
    for (std::size_t i = 0; i < 8; ++i)
        EXPECT_TRUE(near(fine.points[i], 5.0 / 9.0 * cube.points[i])) << i;
    EXPECT_EQ(fine.points[fine.first_face_point], glm::dvec3(-1, 0, 0));
    // This is the edge from corner 0 to corner 4.
    EXPECT_EQ(fine.points[fine.patch(0)[1]], glm::dvec3(-0.75, -0.75, 0));
}

TEST(Subdivision, OfARegularMeshIsABicubicSpline) {
    // These are the points of a uniform cubic B-spline with knots inserted half-way: 1 6 1 over 8,
    // and 4 4 over 8.
    constexpr std::uint32_t rows = 5, columns = 7;
    const QuadMesh coarse = torus(rows, columns);
    const Subdivided fine = subdivided(coarse, 1);
    const auto at = [&](std::uint32_t i, std::uint32_t j) {
        return coarse.points[(i + rows) % rows * columns + (j + columns) % columns];
    };
    const auto row = [&](std::uint32_t i, std::uint32_t j) {
        return (at(i - 1 + rows, j) + 6.0 * at(i, j) + at(i + 1, j)) / 8.0;
    };
    const auto between_rows = [&](std::uint32_t i, std::uint32_t j) {
        return 0.5 * (at(i, j) + at(i + 1, j));
    };
    for (std::uint32_t i = 0; i < rows; ++i)
        for (std::uint32_t j = 0; j < columns; ++j) {
            const std::array<std::uint32_t, 9> patch = fine.patch(i * columns + j);
            const std::uint32_t left = j + columns - 1;
            const glm::dvec3 corner = (row(i, left) + 6.0 * row(i, j) + row(i, j + 1)) / 8.0;
            EXPECT_LT(glm::distance(fine.points[patch[0]], corner), 1e-14);
            const glm::dvec3 along = 0.5 * (row(i, j) + row(i, j + 1));
            EXPECT_LT(glm::distance(fine.points[patch[1]], along), 1e-14);
            const glm::dvec3 middle = 0.5 * (between_rows(i, j) + between_rows(i, j + 1));
            EXPECT_LT(glm::distance(fine.points[patch[2]], middle), 1e-14);
            const glm::dvec3 up =
                (between_rows(i, left) + 6.0 * between_rows(i, j) + between_rows(i, j + 1)) / 8.0;
            EXPECT_LT(glm::distance(fine.points[patch[3]], up), 1e-14);
        }
}

TEST(Subdivision, KeepsClosedMeshesClosed) {
    for (const QuadMesh& coarse : {cube, torus(4, 3)})
        for (int levels = 1; levels <= 3; ++levels) {
            const Subdivided fine = subdivided(coarse, levels);
            const std::vector<std::array<std::uint32_t, 4>> quads = quads_of(fine);
            EXPECT_EQ(quads.size(), coarse.quads.size() << (2 * levels));
            std::set<std::pair<std::uint32_t, std::uint32_t>> half_edges;
            for (const auto& quad : quads)
                for (std::size_t k = 0; k < 4; ++k)
                    EXPECT_TRUE(half_edges.emplace(quad[k], quad[(k + 1) % 4]).second);
            for (const auto& [from, to] : half_edges)
                EXPECT_EQ(half_edges.count({to, from}), 1U) << from << " to " << to;
            const long characteristic = static_cast<long>(fine.points.size()) -
                                        static_cast<long>(half_edges.size() / 2) +
                                        static_cast<long>(quads.size());
            EXPECT_EQ(characteristic, coarse.quads.size() == 6 ? 2 : 0);
        }
}

TEST(Subdivision, ChildrenOfAQuadStayNearIt) {
    // A child of a quad lies near it: for a cube, on its side.
    const Subdivided fine = subdivided(cube, 3);
    for (std::size_t parent = 0; parent < fine.parents.size(); ++parent) {
        const std::array<std::uint32_t, 4>& quad = cube.quads[parent / 16];
        const glm::dvec3 side = 0.25 * (cube.points[quad[0]] + cube.points[quad[1]] +
                                        cube.points[quad[2]] + cube.points[quad[3]]);
        EXPECT_GT(glm::dot(fine.points[fine.patch(parent)[2]], side), 0.4);
    }
}

TEST(Subdivision, RefusesOpenMeshes) {
    QuadMesh open = cube;
    open.quads.pop_back();
    EXPECT_THROW((void)subdivided(open, 1), GenerationError);
    QuadMesh turned = cube;
    std::swap(turned.quads[0][1], turned.quads[0][3]);
    EXPECT_THROW((void)subdivided(turned, 2), GenerationError);
    QuadMesh lonely = cube;
    lonely.points.emplace_back(0.0);
    EXPECT_THROW((void)subdivided(lonely, 1), GenerationError);
}

}  // namespace
}  // namespace sporeprint::skeleton_subdivision_test
