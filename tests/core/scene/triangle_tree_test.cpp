#include "core/scene/triangle_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "core/math/random.h"

namespace sporeprint::triangle_tree_test {
namespace {

constexpr double far = 1e9;

/// Returns triangles here and there in a cube of 10 m, half of them in planes of its axes.
Scene scattered(std::size_t count, std::uint32_t seed) {
    Random random(seed, 0);
    Scene scene;
    scene.materials = {""};
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 middle(random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0),
                                random.uniform(-5.0, 5.0));
        SceneTriangle triangle;
        for (std::uint32_t& corner : triangle.corners) {
            glm::dvec3 at =
                middle + glm::dvec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                                    random.uniform(-1.0, 1.0));
            if (i % 2 == 0) at[static_cast<int>(i / 2 % 3)] = std::round(middle[0]);
            corner = static_cast<std::uint32_t>(scene.positions.size());
            scene.positions.emplace_back(at);
        }
        scene.triangles.push_back(triangle);
    }
    return scene;
}

/// Returns the signed volume of a tetrahedron, six times.
double volume(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    return glm::dot(b - a, glm::cross(c - a, d - a));
}

/// Returns what a ray meets first, by the volumes that it and the edges of each triangle span.
std::optional<RayHit> met_by(const Scene& scene, const glm::dvec3& origin,
                             const glm::dvec3& direction) {
    std::optional<RayHit> found;
    const glm::dvec3 end = origin + direction;
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        const auto& corners = scene.triangles[i].corners;
        const glm::dvec3 a(scene.positions[corners[0]]), b(scene.positions[corners[1]]),
            c(scene.positions[corners[2]]);
        const double u = volume(origin, end, b, c), v = volume(origin, end, c, a),
                     w = volume(origin, end, a, b);
        if (!((u > 0.0 && v > 0.0 && w > 0.0) || (u < 0.0 && v < 0.0 && w < 0.0))) continue;
        const glm::dvec3 at = (u * a + v * b + w * c) / (u + v + w);
        const double distance = glm::dot(at - origin, direction) / glm::dot(direction, direction);
        if (distance >= 0.0 && (!found || distance < found->distance)) found = RayHit{i, distance};
    }
    return found;
}

TEST(TriangleTree, FindsWhatARayMeetsFirst) {
    for (const std::size_t count : {1U, 3U, 5U, 40U, 700U}) {
        const Scene scene = scattered(count, 5);
        const TriangleTree tree(scene);
        Random random(7, 0);
        int hits = 0;
        for (int i = 0; i < 400; ++i) {
            const glm::dvec3 origin(random.uniform(-8.0, 8.0), random.uniform(-8.0, 8.0),
                                    random.uniform(-8.0, 8.0)),
                to(random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0));
            const glm::dvec3 direction = to - origin;
            const auto wanted = met_by(scene, origin, direction);
            const auto found = tree.first_hit(origin, direction, 0.0, far);
            ASSERT_EQ(found.has_value(), wanted.has_value()) << count << ' ' << i;
            EXPECT_EQ(tree.is_blocked(origin, direction, 0.0, far), wanted.has_value());
            if (!wanted) continue;
            ++hits;
            // Which of two triangles of one plane is met first is a matter of rounding.
            EXPECT_NEAR(found->distance, wanted->distance, 1e-9);
            const auto& corners = scene.triangles[found->triangle].corners;
            const glm::dvec3 a(scene.positions[corners[0]]), b(scene.positions[corners[1]]),
                c(scene.positions[corners[2]]);
            const glm::dvec3 at = origin + wanted->distance * direction;
            EXPECT_NEAR(glm::dot(at - a, glm::normalize(glm::cross(b - a, c - a))), 0.0, 1e-6);
            EXPECT_FALSE(tree.is_blocked(origin, direction, 0.0, wanted->distance - 1e-6));
        }
        if (count >= 40) {
            EXPECT_GT(hits, count > 100 ? 100 : 20);
        }
    }
}

TEST(TriangleTree, IsMetAlongTheAxesAndInThePlanesOfItsBoxes) {
    // A square of two triangles in the plane z = 2.
    Scene scene;
    scene.positions = {{0, 0, 2}, {4, 0, 2}, {4, 4, 2}, {0, 4, 2}};
    scene.triangles = {{{0, 1, 2}, 0}, {{0, 2, 3}, 0}};
    const TriangleTree tree(scene);
    const auto found = tree.first_hit({3.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, 0.0, far);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->triangle, 0U);
    EXPECT_DOUBLE_EQ(found->distance, 2.0);
    // On the edge that both have: it is not lost between them.
    const auto edge = tree.first_hit({2.0, 2.0, 0.0}, {0.0, 0.0, 1.0}, 0.0, far);
    ASSERT_TRUE(edge);
    EXPECT_EQ(edge->triangle, 0U) << "the lower number of two at one distance";
    // From behind, and not beyond where a ray ends.
    EXPECT_TRUE(tree.is_blocked({1.0, 3.0, 5.0}, {0.0, 0.0, -2.0}, 0.0, 1.5));
    EXPECT_FALSE(tree.is_blocked({1.0, 3.0, 5.0}, {0.0, 0.0, -2.0}, 0.0, 1.49));
    EXPECT_FALSE(tree.is_blocked({1.0, 3.0, 2.0}, {0.0, 0.0, 1.0}, 1e-6, far));
    EXPECT_FALSE(tree.is_blocked({5.0, 3.0, 0.0}, {0.0, 0.0, 1.0}, 0.0, far));
}

TEST(TriangleTree, OfNothingStopsNothing) {
    const TriangleTree tree{Scene{}};
    EXPECT_FALSE(tree.is_blocked({0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 0.0, far));
    EXPECT_FALSE(tree.first_hit({0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 0.0, far));
}

TEST(TriangleTree, OfManyTrianglesAtOnePlaceIsNotDeep) {
    Scene scene;
    scene.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    scene.triangles.assign(20'000, {{0, 1, 2}, 0});
    const TriangleTree tree(scene);
    const auto found = tree.first_hit({0.2, 0.2, 1.0}, {0.0, 0.0, -1.0}, 0.0, far);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->triangle, 0U);
}

}  // namespace
}  // namespace sporeprint::triangle_tree_test
