// Tests of the distance measures that the continuity tests use.
#include "tests/support/surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

#include "core/math/elementary.h"
#include "core/math/random.h"
#include "tests/support/triangle_grid.h"

namespace sporeprint::mesh_surfaces_test {
namespace {

glm::dvec3 random_point(Random& random) {
    const double x = random.symmetric();
    const double y = random.symmetric();
    const double z = random.symmetric();
    return {x, y, z};
}

/// Returns a ball of `rings` x 2 `rings` faces.
Mesh ball(double radius, int rings, const glm::dvec3& centre = glm::dvec3(0.0)) {
    Mesh mesh;
    const int columns = 2 * rings;
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j <= columns; ++j) {
            const auto polar = sine_cosine(pi * i / rings),
                       round = sine_cosine(2.0 * pi * j / columns);
            mesh.positions.emplace_back(centre + radius * glm::dvec3(polar.sine * round.cosine,
                                                                     polar.cosine,
                                                                     polar.sine * round.sine));
        }
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < columns; ++j) {
            const auto a = static_cast<std::uint32_t>(i * (columns + 1) + j), b = a + 1,
                       c = a + static_cast<std::uint32_t>(columns) + 1, d = c + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, c, b, d, c});
        }
    return mesh;
}

TEST(Surfaces, TheDistanceToATriangleIsTheMinimumOfItsSamples) {
    Random random(1, 0);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 p = random_point(random);
        const glm::dvec3 a = random_point(random);
        const glm::dvec3 b = random_point(random);
        // Every fifth has no area, every tenth no length either.
        const glm::dvec3 c = i % 10 == 0  ? a
                             : i % 5 == 0 ? a + 2.0 * (b - a)
                                          : random_point(random);
        double walked = std::numeric_limits<double>::infinity();
        constexpr int steps = 120;
        for (int i_b = 0; i_b <= steps; ++i_b)
            for (int i_c = 0; i_b + i_c <= steps; ++i_c) {
                const double v = static_cast<double>(i_b) / steps,
                             w = static_cast<double>(i_c) / steps;
                walked = std::min(walked, glm::distance(p, a + v * (b - a) + w * (c - a)));
            }
        const double found = distance_to_triangle(p, a, b, c);
        EXPECT_LE(found, walked + 1e-12);
        EXPECT_GE(found, walked - 0.04);  // minus the step of the samples
    }
}

TEST(Surfaces, TheHausdorffDistanceOfTwoBallsIsTheDifferenceOfTheirRadii) {
    const Mesh small = ball(1.0, 40), large = ball(1.3, 40);
    EXPECT_NEAR(hausdorff(small, large), 0.3, 0.01);
    EXPECT_LT(hausdorff(small, small), 1e-12);
    EXPECT_LT(hausdorff(small, ball(1.0, 23)), 0.02);  // one surface, two meshes
    EXPECT_NEAR(hausdorff(small, ball(1.0, 40, {0.0, 0.5, 0.0})), 0.5, 0.01);
    EXPECT_NEAR(hausdorff(small, ball(1.0, 40, {7.0, 0.0, 0.0})), 7.0, 0.01);
}

TEST(Surfaces, TheHausdorffDistanceIncludesPiecesOfOneSurfaceOnly) {
    const Mesh alone = ball(1.0, 30);
    Mesh with_wart = alone;
    append(with_wart, ball(0.05, 6, {0.0, 1.2, 0.0}));
    EXPECT_NEAR(hausdorff(alone, with_wart), 0.25, 1e-6);
    EXPECT_NEAR(hausdorff(with_wart, alone), 0.25, 1e-6);
}

TEST(Surfaces, TheGridFindsTheNearestOfAllTriangles) {
    Random random(2, 0);
    const auto soup = [&](double reach) {
        Mesh mesh;
        for (std::uint32_t i = 0; i < 120; ++i) {
            const glm::dvec3 at = 3.0 * random_point(random);
            for (std::uint32_t k = 0; k < 3; ++k) {
                mesh.positions.emplace_back(at + reach * random_point(random));
                mesh.indices.push_back(3 * i + k);
            }
        }
        return mesh;
    };
    for (const double reach : {0.05, 0.4, 3.0}) {
        const Mesh a = soup(reach), b = soup(0.3);
        double worst = 0.0;
        for (const auto& [from, to] : {std::pair{&a, &b}, std::pair{&b, &a}})
            for (std::size_t i = 0; i < from->indices.size(); i += 3) {
                const glm::dvec3 p[] = {glm::dvec3(from->positions[i]),
                                        glm::dvec3(from->positions[i + 1]),
                                        glm::dvec3(from->positions[i + 2])};
                for (const glm::dvec3& look : {p[0], p[1], p[2], (p[0] + p[1] + p[2]) / 3.0,
                                               0.5 * (p[0] + p[1]), 0.5 * (p[1] + p[2])}) {
                    double nearest = std::numeric_limits<double>::infinity();
                    for (std::size_t j = 0; j < to->indices.size(); j += 3)
                        nearest = std::min(nearest,
                                           distance_to_triangle(look, glm::dvec3(to->positions[j]),
                                                                glm::dvec3(to->positions[j + 1]),
                                                                glm::dvec3(to->positions[j + 2])));
                    worst = std::max(worst, nearest);
                }
            }
        EXPECT_NEAR(hausdorff(a, b), worst, 1e-12);
    }
}

TEST(Surfaces, AJumpIsTheLargestMoveOrTheSizeOfANewPiece) {
    Mesh before = ball(1.0, 10);
    Mesh after = before;
    after.positions[25].y += 0.125f;
    EXPECT_NEAR(jump(before, after), 0.125, 1e-6);
    // A vertex without triangles may lie anywhere.
    before.positions.emplace_back(9.0f);
    after.positions.emplace_back(-9.0f);
    EXPECT_NEAR(jump(before, after), 0.125, 1e-6);
    // A new piece 0.4 long and 0.1 wide contributes half of that on average.
    for (Mesh* mesh : {&before, &after})
        for (const glm::vec3 corner : {glm::vec3(2.0f, 0.0f, 0.0f), glm::vec3(2.4f, 0.0f, 0.0f),
                                       glm::vec3(2.0f, 0.1f, 0.0f)})
            mesh->positions.push_back(corner);
    after.positions[25] = before.positions[25];
    const auto n = static_cast<std::uint32_t>(before.positions.size());
    after.indices.insert(after.indices.end(), {n - 3, n - 2, n - 1});
    EXPECT_NEAR(jump(before, after), 0.02 / std::sqrt(0.17), 1e-6);
    EXPECT_NEAR(jump(after, before), 0.02 / std::sqrt(0.17), 1e-6);
    EXPECT_EQ(only_in(after, before).triangles(), 1u);
    EXPECT_EQ(only_in(before, after).triangles(), 0u);
    EXPECT_THROW((void)only_in(before, ball(1.0, 3)), std::invalid_argument);
}

}  // namespace
}  // namespace sporeprint::mesh_surfaces_test
